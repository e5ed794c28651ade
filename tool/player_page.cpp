#include "tool/player_page.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

constexpr std::string_view kStyle = "href=\"player.css\"";
constexpr std::string_view kScript = "src=\"player.js\"";

/// A script as it may stand between tags: what would end it, or hide its end, is written in another way that
/// means the same to strings, templates and patterns.
std::string inline_script(std::string_view script) {
  std::string text;
  for (std::size_t at = 0; at < script.size(); ++at) {
    text += script[at];
    const std::string_view rest = script.substr(at + 1);
    if (script[at] == '<' && (rest.starts_with("/script") || rest.starts_with("!--"))) text += '\\';
  }
  return text;
}

/// Removes an attribute of the name from a start tag.
void remove_attribute(std::string& tag, std::string_view name) {
  const std::size_t begin = tag.find(fmt::format(" {}=\"", name));
  if (begin == std::string::npos) return;
  const std::size_t end = tag.find('"', tag.find('"', begin) + 1);
  tag.erase(begin, end - begin + 1);
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::string_view three = bytes.substr(at, 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (i < three.size() ? static_cast<std::uint8_t>(three[i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i) text += i <= three.size() ? kDigits[bits >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

PlayerPage::Tag PlayerPage::tag_with(std::string_view mark) const {
  const std::size_t at = html_.find(mark);
  const std::size_t begin = at == std::string::npos ? at : html_.rfind('<', at);
  const std::size_t end = at == std::string::npos ? at : html_.find('>', at);
  if (begin == std::string::npos || end == std::string::npos) {
    throw ToolError(ExitStatus::kInvalidInput,
                    fmt::format("{}: this is no page of the player: it has no {}", file_, mark));
  }
  return {begin, end + 1};
}

void PlayerPage::replace(std::string_view what, std::string_view with) {
  static_cast<void>(tag_with(what));
  html_.replace(html_.find(what), what.size(), with);
}

void PlayerPage::set(const PageContent& content) {
  const Tag place = tag_with("id=\"player\"");
  std::string tag = html_.substr(place.begin, place.end - place.begin - 1);
  for (const auto& [name, value] :
       {std::pair("data-stream", &content.stream), std::pair("data-poster", &content.poster),
        std::pair("data-title", &content.title)}) {
    remove_attribute(tag, name);
    if (!value->empty()) tag += fmt::format(" {}=\"{}\"", name, html_escaped(*value));
  }
  html_.replace(place.begin, place.end - place.begin, tag + ">");
  const std::size_t begin = html_.find("<title>"), end = html_.find("</title>");
  if (content.title.empty() || begin == std::string::npos || end == std::string::npos || end < begin) return;
  html_.replace(begin, end - begin, "<title>" + html_escaped(content.title));
}

void PlayerPage::set_base(const std::string& folder) {
  replace(kStyle, fmt::format("href=\"{}player.css\"", folder));
  replace(kScript, fmt::format("src=\"{}player.js\"", folder));
}

void PlayerPage::embed(std::string_view style, std::string_view script) {
  const Tag link = tag_with(kStyle);
  html_.replace(link.begin, link.end - link.begin, fmt::format("<style>\n{}</style>", style));
  const Tag element = tag_with(kScript);
  std::string tag = html_.substr(element.begin, element.end - element.begin);
  remove_attribute(tag, "src");
  html_.replace(element.begin, element.end - element.begin, tag + inline_script(script));
}

std::string PlayerPage::embedded_file(std::string_view name, std::string_view bytes) {
  return fmt::format("<script type=\"application/octet-stream;base64\" data-file=\"{}\">{}</script>\n",
                     html_escaped(name), base64(bytes));
}

void PlayerPage::insert_before_script(std::string_view html) {
  html_.insert(tag_with(kScript).begin, html);
}

}  // namespace tvg::cli
