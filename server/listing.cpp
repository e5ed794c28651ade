#include "server/listing.hpp"

#include "server/file_response.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sys/stat.h>

#include <tvg/decoder.hpp>

namespace tvg::server {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = std::size_t{1} << 12;
constexpr std::uint64_t kMostIndexBytes = std::uint64_t{1} << 20;
constexpr std::size_t kMostExamined = 1000;  // streams whose heads are read for one listing

std::string iso_date(std::time_t time) {
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

std::vector<std::uint8_t> read_at(std::ifstream& file, std::uint64_t offset, std::uint64_t size) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  file.clear();
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

std::optional<std::uint64_t> count_frames(std::ifstream& file, std::uint64_t size) {
  if (size < kTailBytes) return std::nullopt;
  const Result<ByteRange> range = locate_index(read_at(file, size - kTailBytes, kTailBytes), size);
  if (!range || range->size > kMostIndexBytes) return std::nullopt;
  const Result<std::vector<IndexEntry>> index = parse_index(read_at(file, range->offset, range->size));
  if (!index) return std::nullopt;
  return tvg::count_frames(*index);
}

/// Head and metadata are at the very beginning; the decoder is not asked for more.
void describe_stream(const fs::path& path, std::uint64_t size, nlohmann::json& entry) {
  std::ifstream file(path, std::ios::binary);
  Decoder decoder;
  decoder.push(read_at(file, 0, std::min<std::uint64_t>(size, kHeadBytes)));
  for (bool more = true; more;) {
    switch (decoder.poll()) {
      case Decoder::Event::kHead:
        entry["vertices"] = decoder.head().limits.vertices;
        break;
      case Decoder::Event::kMetadata:
        if (const auto fps = decoder.metadata().find("fps"); fps != decoder.metadata().end())
          entry["fps"] = fps->second;
        break;
      case Decoder::Event::kChunk:
        more = decoder.chunk().type == "HEAD" || decoder.chunk().type == "META";
        break;
      default:
        more = false;
        break;
    }
  }
  if (!entry.contains("vertices")) return;
  if (const auto frames = count_frames(file, size)) entry["frames"] = *frames;
}

/// Text for JSON: what is no UTF-8 shows as replacement characters.
std::string dump(const nlohmann::json& json) {
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string url_of(const std::string& path) {
  std::string url;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

std::string folder_listing(const fs::path& root, const fs::path& folder) {
  // From the root, with slashes at both ends.
  std::string place = "/";
  if (folder != root) place.append(folder.lexically_relative(root).string()).append("/");
  std::vector<std::string> names;
  std::error_code error;
  bool complete = true;
  for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
    if (names.size() == kMostListed) {
      complete = false;
      break;
    }
    names.push_back(file->path().filename().string());
  }
  std::sort(names.begin(), names.end());

  nlohmann::json entries = nlohmann::json::array();
  std::size_t examined = 0;
  for (const std::string& name : names) {
    std::string path = place;
    path += name;
    const std::optional<fs::path> target = resolve_in_folder(root, path);
    struct stat status {};
    if (!target || ::stat(target->c_str(), &status) != 0) continue;
    const bool is_folder = S_ISDIR(status.st_mode);
    if (!is_folder && !S_ISREG(status.st_mode)) continue;
    nlohmann::json entry = {{"name", name},
                            {"type", is_folder ? "folder" : "file"},
                            {"modified", iso_date(status.st_mtim.tv_sec)},
                            {"url", url_of(path) + (is_folder ? "/" : "")}};
    if (!is_folder) {
      const auto size = static_cast<std::uint64_t>(status.st_size);
      entry["size"] = size;
      if (target->extension() == ".tvg" && ++examined <= kMostExamined) describe_stream(*target, size, entry);
    }
    entries.push_back(std::move(entry));
  }
  return dump({{"folder", place}, {"complete", complete}, {"entries", std::move(entries)}});
}

std::string live_listing(const std::vector<LiveStatus>& streams) {
  nlohmann::json list = nlohmann::json::array();
  for (const LiveStatus& stream : streams) {
    const double rate = stream.seconds > 0 ? static_cast<double>(stream.bytes) / stream.seconds : 0;
    list.push_back({{"name", stream.name},
                    {"url", "/live/" + stream.name},
                    {"viewers", stream.viewers},
                    {"frames", stream.frames},
                    {"gops", stream.gops},
                    {"bytes_per_second", static_cast<std::uint64_t>(rate)},
                    {"since", iso_date(static_cast<std::time_t>(stream.since))}});
  }
  return dump({{"streams", std::move(list)}});
}

}  // namespace tvg::server
