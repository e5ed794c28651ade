#include "server/start_page.hpp"

#include "tool/option_values.hpp"
#include "tool/player_page.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace tvg::server {

namespace {

using cli::html_escaped;
using nlohmann::json;

constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0}</title>
<link rel="icon" href="data:,">
<style>
:root {{ color-scheme: light dark; }}
body {{ max-width: 60em; margin: 2em auto; padding: 0 1em; font: 16px/1.5 system-ui, sans-serif; }}
h1, h2 {{ font-weight: 600; overflow-wrap: anywhere; }}
table {{ border-collapse: collapse; width: 100%; }}
th, td {{ text-align: right; padding: .3em .6em; border-bottom: 1px solid #8884; }}
th:first-child, td:first-child {{ text-align: left; overflow-wrap: anywhere; }}
.note {{ padding: .6em 1em; border-left: 4px solid #b34a00; }}
</style>
<main>
<h1>{0}</h1>
)";

/// A URL of this server, as the player takes it in its own address.
std::string player_link(std::string_view parameter, const std::string& value) {
  std::string link = fmt::format("/?{}=", parameter);
  for (const char c : value) link += c == '%' ? "%25" : std::string(1, c);
  return link;
}

std::string text_of(const json& entry, const char* key) {
  const auto value = entry.find(key);
  if (value == entry.end()) return "";
  return value->is_string() ? value->get<std::string>() : value->dump();
}

bool is_stream(const json& entry) {
  const std::string name = text_of(entry, "name");
  return entry["type"] == "file" && (name.ends_with(".tvg") || name == "ladder.json");
}

/// One link in a line of its own.
std::string item(const std::string& url, const std::string& name) {
  return fmt::format("<li><a href=\"{}\">{}</a></li>\n", html_escaped(url), html_escaped(name));
}

std::string stream_row(const json& entry, bool has_player) {
  const std::string name = text_of(entry, "name"), url = text_of(entry, "url");
  const std::string link = has_player ? player_link("stream", url.substr(1)) : url;
  const auto rate = cli::parse_frame_rate(text_of(entry, "fps"));
  const std::string length = entry.contains("frames")
                                 ? fmt::format("{:.1f} s", entry["frames"].get<double>() / rate.value_or(30))
                                 : "";
  return fmt::format(
      "<tr><td><a href=\"{}\">{}</a></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td><a href=\"{}\" "
      "download>file</a></td></tr>\n",
      html_escaped(link), html_escaped(name), length, text_of(entry, "frames"), text_of(entry, "vertices"),
      cli::readable_bytes(entry["size"].get<std::uint64_t>()), html_escaped(url));
}

std::string streams_section(const json& entries, bool has_player) {
  std::string rows;
  for (const json& entry : entries) {
    if (is_stream(entry)) rows += stream_row(entry, has_player);
  }
  if (rows.empty()) return "<h2>Streams</h2>\n<p>There are none here.</p>\n";
  return fmt::format(
      "<h2>Streams</h2>\n<table>\n<tr><th scope=\"col\">Name</th><th scope=\"col\">Length</th><th "
      "scope=\"col\">Frames</th><th scope=\"col\">Vertices</th><th scope=\"col\">Size</th><th "
      "scope=\"col\">Download</th></tr>\n{}</table>\n",
      rows);
}

std::string live_section(const json& live, bool has_player) {
  std::string rows;
  for (const json& stream : live["streams"]) {
    const std::string name = text_of(stream, "name"), url = text_of(stream, "url");
    rows += fmt::format("<li><a href=\"{}\">{}</a>, {} watching</li>\n",
                        html_escaped(has_player ? player_link("live", name) : url), html_escaped(name),
                        text_of(stream, "viewers"));
  }
  if (rows.empty()) return "<h2>Live</h2>\n<p>Nothing is live.</p>\n";
  return fmt::format("<h2>Live</h2>\n<ul>\n{}</ul>\n", rows);
}

/// Folders, and files that are no streams.
std::string rest_section(const json& listing) {
  std::string folders, files;
  if (listing["folder"] != "/") folders += item("../", "the folder above");
  for (const json& entry : listing["entries"]) {
    if (is_stream(entry)) continue;
    const std::string name = text_of(entry, "name"), url = text_of(entry, "url");
    (entry["type"] == "folder" ? folders : files) += item(url, name);
  }
  if (!folders.empty()) folders = fmt::format("<h2>Folders</h2>\n<ul>\n{}</ul>\n", folders);
  if (!files.empty()) files = fmt::format("<h2>Other files</h2>\n<ul>\n{}</ul>\n", files);
  return folders + files;
}

}  // namespace

std::string start_page(const std::string& listing, const std::optional<std::string>& live, bool has_player) {
  const json content = json::parse(listing);
  const std::string folder = text_of(content, "folder");
  const std::string title = folder == "/" ? "Streams of this server" : folder;
  std::string page = fmt::format(fmt::runtime(kHead), html_escaped(title));
  if (!has_player) {
    page +=
        "<p class=\"note\">The player is not installed with this server, so streams are links to their "
        "files. "
        "Its files are built with <code>npm ci</code> in <code>web/</code> and the preset <code>wasm</code>; "
        "<code>tvg serve --player</code> names the folder they lie in. <code>tvg play URL</code> plays them "
        "in a window.</p>\n";
  }
  if (live) page += live_section(json::parse(*live), has_player);
  page += streams_section(content["entries"], has_player);
  page += rest_section(content);
  if (content["complete"] == false)
    page += "<p class=\"note\">There is more in this folder than is shown.</p>\n";
  return page + "</main>\n</html>\n";
}

}  // namespace tvg::server
