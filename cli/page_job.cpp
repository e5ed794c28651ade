#include "cli/page_job.hpp"

#include "cli/page_streams.hpp"
#include "cli/player_folder.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/player_page.hpp"
#include "tool/stream_source.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#ifdef TVG_HAS_PLAYER
#include "player/render/poster.hpp"
#endif

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPoster = "poster.png";
/// Of a stream within a page: a third more as text, of which browsers hold half a gigabyte.
constexpr std::uint64_t kMostEmbeddedBytes = std::uint64_t{256} << 20;

bool is_single_file(const PageArguments& arguments) {
  return has_suffix(arguments.output, ".html") || has_suffix(arguments.output, ".htm");
}

std::string read_file(const fs::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file || file.bad()) {
    throw ToolError(ExitStatus::kIo, fmt::format("{}: cannot be read: {}", path.string(),
                                                 std::generic_category().message(errno != 0 ? errno : EIO)));
  }
  return bytes;
}

/// What the page is called: as asked for, or after the input.
std::string title_of(const PageArguments& arguments) {
  if (!arguments.title.empty()) return arguments.title;
  if (!arguments.name.empty()) return arguments.name;
  fs::path input = fs::absolute(arguments.inputs.front()).lexically_normal();
  if (arguments.inputs.front() == "-") return "Animation";
  if (!input.has_filename() || input.filename() == kLadderFile) input = input.parent_path();
  std::error_code error;
  // "walk_%04d.obj" is a walk.
  std::string name = fs::is_directory(input, error) ? input.filename().string() : input.stem().string();
  name.erase(std::min(name.size(), name.find_first_of("%#")));
  while (!name.empty() && std::string_view("_-. ").find(name.back()) != std::string_view::npos)
    name.pop_back();
  return name.empty() ? input.parent_path().filename().string() : name;
}

/// The poster's bytes; empty where there is to be none, or this machine cannot draw.
std::string poster_of(const PageArguments& arguments, const std::string& stream) {
#ifdef TVG_HAS_PLAYER
  constexpr int kWidth = 1280, kHeight = 720;
  if (arguments.no_poster) return {};
  try {
    return player::png_with_alpha(player::draw_poster(stream, kWidth, kHeight));
  } catch (const ToolError& error) {
    if (error.status() != ExitStatus::kOther) throw;
    if (!arguments.quiet) fmt::print(stderr, "note: the page has no poster: {}\n", error.what());
  }
#else
  if (!arguments.no_poster && !arguments.quiet)
    fmt::print(stderr, "note: the page has no poster: this tvg was built without what draws\n");
  static_cast<void>(stream);
#endif
  return {};
}

void check_options(const PageArguments& arguments) {
  const bool many = arguments.ladder || is_ladder(arguments);
  if (is_single_file(arguments) && many) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{}: a page in one file has one stream, and a ladder has several: name a "
                                "folder",
                                arguments.output));
  }
  if (arguments.ladder) {
    if (is_ladder(arguments)) {
      throw ToolError(ExitStatus::kUsage,
                      fmt::format("--ladder: {} is a ladder already", arguments.inputs.front()));
    }
    check_ladder_options(arguments);
  } else if (!arguments.encoding.empty()) {
    static_cast<void>(encode_options(arguments));
  }
}

/// Nothing that is read is overwritten; streams that lie where the page has them are not written at all.
void check_outputs(const PageArguments& arguments) {
  const InputFiles inputs = files_of(arguments, arguments.measure.weights());
  if (is_single_file(arguments)) return inputs.check_output(arguments.output);
  std::vector<std::string> names(kPlayerFiles.begin(), kPlayerFiles.end());
  names.emplace_back(kPoster);
  if (arguments.ladder) names.insert(names.end(), {"high.tvg", "medium.tvg", "low.tvg", kLadderFile});
  for (const std::string& name : names) inputs.check_output((fs::path(arguments.output) / name).string());
}

void write_folder(const PageArguments& arguments, const fs::path& player) {
  PlayerPage page(read_file(player / "index.html"), (player / "index.html").string());
  AtomicFolder folder(arguments.output);
  const PageStream stream = put_streams(arguments, folder);
  const std::string poster = poster_of(arguments, stream.path);
  page.set({title_of(arguments), stream.url, poster.empty() ? "" : kPoster});
  if (!poster.empty()) folder.add(kPoster, poster);
  for (const char* const name : kPlayerFiles) {
    const bool is_page = std::string_view(name) == "index.html";
    folder.add(name, is_page ? page.html() : read_file(player / name));
  }
  folder.finish();
  if (arguments.quiet) return;
  fmt::print(stderr, "{}: a page; offer the folder over HTTP, for example with tvg serve {}\n",
             (fs::path(arguments.output) / "index.html").string(), arguments.output);
}

void write_single_file(const PageArguments& arguments, const fs::path& player) {
  PlayerPage page(read_file(player / "index.html"), (player / "index.html").string());
  AtomicFile output(arguments.output);
  AtomicFile scratch(arguments.output + ".tvg");  // is never finished
  const std::string path = stream_of(arguments, scratch);
  std::error_code error;
  if (const std::uint64_t size = fs::file_size(path, error); !error && size > kMostEmbeddedBytes) {
    throw ToolError(ExitStatus::kUsage,
                    fmt::format("{}: the stream has {} MB, and browsers open no page in one file with more "
                                "than {}: name a folder",
                                arguments.output, size >> 20, kMostEmbeddedBytes >> 20));
  }
  const std::string poster = poster_of(arguments, path);
  page.set(
      {title_of(arguments), "clip.tvg", poster.empty() ? "" : "data:image/png;base64," + base64(poster)});
  page.insert_before_script(PlayerPage::embedded_file("tvg.wasm", read_file(player / "tvg.wasm")) +
                            PlayerPage::embedded_file("clip.tvg", read_file(path)));
  page.embed(read_file(player / "player.css"), read_file(player / "player.js"));
  output.write(page.html());
  output.finish();
  if (arguments.quiet) return;
  fmt::print(stderr, "{}: a page with all it needs, {}; browsers play it without a server too\n",
             arguments.output, readable_bytes(page.html().size()));
}

}  // namespace

void run_page(const PageArguments& arguments) {
  check_options(arguments);
  const fs::path player = player_folder(arguments.player);
  check_outputs(arguments);
  if (is_single_file(arguments)) {
    write_single_file(arguments, player);
  } else {
    write_folder(arguments, player);
  }
}

}  // namespace tvg::cli
