#include "cli/page_streams.hpp"

#include "cli/encode_job.hpp"
#include "tool/remote_stream.hpp"
#include "tool/stream_reader.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kClip = "clip.tvg";

bool is_one_stream(const PageArguments& arguments) {
  return arguments.inputs.size() == 1 && is_stream_file(arguments.inputs.front());
}

/// ladder.json of an input that is one, or its folder; empty for others.
fs::path ladder_file(const PageArguments& arguments) {
  if (arguments.inputs.size() != 1) return {};
  const fs::path input = arguments.inputs.front();
  std::error_code error;
  if (input.filename() == kLadderFile) return input;
  if (fs::is_regular_file(input / kLadderFile, error)) return input / kLadderFile;
  return {};
}

/// What is there already is not encoded again.
void check_takes_no_encoding(const PageArguments& arguments) {
  if (arguments.encoding.empty()) return;
  throw ToolError(ExitStatus::kUsage, fmt::format("{}: not for {}, which is taken as it is",
                                                  arguments.encoding.front(), arguments.inputs.front()));
}

/// Refuses what the page could only complain of.
void check_is_stream(const std::string& path) {
  StreamReader reader(path);
  for (;;) {
    switch (reader.next()) {
      case Decoder::Event::kHead:
        return;
      case Decoder::Event::kError:
        throw tool_error(reader.name(), reader.decoder().error());
      case Decoder::Event::kEnd:
        throw ToolError(ExitStatus::kInvalidInput, fmt::format("{}: the stream has no head", path));
      default:
        break;
    }
  }
}

void fetch(const std::string& url, AtomicFile& file) {
  const std::unique_ptr<RemoteStream> remote = open_remote_stream(url);
  std::vector<std::uint8_t> piece(std::size_t{1} << 18);
  std::uint64_t at = 0;
  while (const std::size_t count = remote->read(at, piece)) {
    file.write(piece.data(), count);
    at += count;
  }
  file.flush();
}

/// Copies a file into the folder, unless it is there already.
void copy_into(AtomicFolder& folder, const std::string& name, const fs::path& from) {
  std::error_code error;
  if (fs::equivalent(from, fs::path(folder.path()) / name, error)) return;
  AtomicFile& file = folder.add(name);
  std::ifstream input(from, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 18);
  while (input.read(piece.data(), static_cast<std::streamsize>(piece.size())), input.gcount() > 0)
    file.write(piece.data(), static_cast<std::size_t>(input.gcount()));
  if (!input.eof()) throw ToolError(ExitStatus::kIo, fmt::format("{}: cannot be read", from.string()));
}

/// A name that leads nowhere but into the folder.
bool is_plain_name(const std::string& name) {
  return !name.empty() && !name.starts_with('.') && name.find('/') == std::string::npos;
}

/// The files of a ladder's streams, the best first.
std::vector<std::string> files_of_ladder(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const nlohmann::json ladder = nlohmann::json::parse(file, nullptr, false);
  std::vector<std::string> files;
  if (ladder.is_object() && ladder.value("tvg_ladder", nlohmann::json()) == 1 && ladder.contains("streams")) {
    for (const nlohmann::json& stream : ladder["streams"]) {
      const auto name = stream.is_object() ? stream.value("file", nlohmann::json()) : nlohmann::json();
      if (!name.is_string() || !is_plain_name(name.get<std::string>())) {
        files.clear();
        break;
      }
      files.push_back(name);
    }
  }
  if (files.empty()) {
    throw ToolError(
        ExitStatus::kInvalidInput,
        fmt::format("{}: this is no ladder of version 1 with its streams beside it", path.string()));
  }
  return files;
}

PageStream copy_ladder(const fs::path& ladder, AtomicFolder& folder) {
  const std::vector<std::string> files = files_of_ladder(ladder);
  for (const std::string& name : files) {
    const fs::path from = ladder.parent_path() / name;
    check_is_stream(from.string());
    copy_into(folder, name, from);
  }
  copy_into(folder, kLadderFile, ladder);
  return {kLadderFile, (ladder.parent_path() / files.front()).string()};
}

void encode_into(const PageArguments& arguments, AtomicFile& file, const std::string& name) {
  EncodeOptions options = encode_options(arguments);
  const OpenedInput opened = open_for_encoding(arguments, options);
  const auto sink = [&file](std::span<const std::uint8_t> bytes) {
    file.write(bytes.data(), bytes.size());
    return Status();
  };
  const EncodeReport report = encode_frames(*opened.source, options, sink, arguments);
  file.flush();
  if (arguments.quiet) return;
  print_later_notes(opened);
  print_encode_report(name, report);
}

}  // namespace

bool is_ladder(const PageArguments& arguments) {
  return !ladder_file(arguments).empty();
}

PageStream put_streams(const PageArguments& arguments, AtomicFolder& folder) {
  if (arguments.ladder) return {kLadderFile, write_ladder(arguments, folder)};
  if (const fs::path ladder = ladder_file(arguments); !ladder.empty()) {
    check_takes_no_encoding(arguments);
    return copy_ladder(ladder, folder);
  }
  if (is_one_stream(arguments)) {
    const std::string& input = arguments.inputs.front();
    check_takes_no_encoding(arguments);
    check_is_stream(input);
    if (is_address(input)) {
      AtomicFile& file = folder.add(kClip);
      fetch(input, file);
      return {kClip, file.temporary_path()};
    }
    copy_into(folder, kClip, input);
    return {kClip, input};
  }
  AtomicFile& file = folder.add(kClip);
  encode_into(arguments, file, file.path());
  return {kClip, file.temporary_path()};
}

std::string stream_of(const PageArguments& arguments, AtomicFile& scratch) {
  if (!is_one_stream(arguments)) {
    encode_into(arguments, scratch, "the stream");
    return scratch.temporary_path();
  }
  check_takes_no_encoding(arguments);
  const std::string& input = arguments.inputs.front();
  check_is_stream(input);
  if (!is_address(input)) return input;
  fetch(input, scratch);
  return scratch.temporary_path();
}

}  // namespace tvg::cli
