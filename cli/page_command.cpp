#include "cli/commands.hpp"
#include "tool/atomic_file.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPageFiles[] = {"index.html", "player.css", "player.js", "tvg.wasm"};

struct PageArguments {
  std::string input;
  std::string output;
  std::string player;
  bool quiet = false;
};

/// The folder of the player's files: as named, beside the installed tool, or where the build puts them.
fs::path player_folder(const std::string& named) {
  std::vector<fs::path> places;
  if (!named.empty()) {
    places.emplace_back(named);
  } else {
    std::error_code error;
    const fs::path tool = fs::read_symlink("/proc/self/exe", error);
    if (!error) places.push_back(tool.parent_path().parent_path() / "share" / "tvg" / "web");
    places.emplace_back(TVG_PAGE_FOLDER);
  }
  for (const fs::path& place : places) {
    if (fs::exists(place / "player.js")) return place;
  }
  throw ToolError(
      ExitStatus::kIo,
      fmt::format("{}: there is no player.js; the player's files are built with npm ci in web/ and "
                  "the preset wasm (docs/web.md), and --player names the folder they lie in",
                  places.back().string()));
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) throw ToolError(ExitStatus::kIo, fmt::format("{}: cannot be read", path.string()));
  return bytes;
}

/// Refuses what the page could only complain of.
void check_is_stream(const std::string& path, const std::string& bytes) {
  Decoder decoder;
  decoder.push({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  decoder.finish();
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kHead:
        return;
      case Decoder::Event::kError:
        throw tool_error(path, decoder.error());
      case Decoder::Event::kNeedBytes:
      case Decoder::Event::kEnd:
        throw ToolError(ExitStatus::kInvalidInput, fmt::format("{}: the stream has no head", path));
      default:
        break;
    }
  }
}

void write_file(const fs::path& path, const std::string& bytes) {
  AtomicFile file(path.string());
  file.write(bytes);
  file.finish();
}

void run_page(const PageArguments& arguments) {
  const fs::path player = player_folder(arguments.player);
  const std::string stream = read_file(arguments.input);
  check_is_stream(arguments.input, stream);
  std::error_code error;
  fs::create_directories(arguments.output, error);
  if (error) {
    throw ToolError(ExitStatus::kIo,
                    fmt::format("{}: cannot be made: {}", arguments.output, error.message()));
  }
  const fs::path folder = arguments.output;
  write_file(folder / "clip.tvg", stream);
  for (const char* const name : kPageFiles) write_file(folder / name, read_file(player / name));
  if (!arguments.quiet)
    fmt::print(stderr, "{}: a page; offer the folder over HTTP\n", (folder / "index.html").string());
}

}  // namespace

void add_page_command(CLI::App& tool) {
  auto arguments = std::make_shared<PageArguments>();
  CLI::App& command = *tool.add_subcommand("page", "Make a web page that plays a stream");
  command.add_option("stream", arguments->input, "the .tvg file to play")
      ->required()
      ->check(CLI::ExistingFile);
  command.add_option("-o,--output", arguments->output, "folder of the page, made where it is missing")
      ->required();
  command.add_option("--player", arguments->player,
                     "folder of the player's files, where they are not installed with the tool");
  command.add_flag("-q,--quiet", arguments->quiet, "print errors only");
  command.callback([arguments] { run_page(*arguments); });
}

}  // namespace tvg::cli
