#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

// The page of the player that web/ builds, and what is put into it for a stream.
namespace tvg::cli {

/// Its files; the page leads to the others.
inline constexpr std::array<const char*, 4> kPlayerFiles = {"player.css", "player.js", "tvg.wasm",
                                                            "index.html"};

/// `text` so that HTML shows it as it is, in attributes as well.
std::string html_escaped(std::string_view text);
/// `bytes` in base64, with padding.
std::string base64(std::string_view bytes);

/// What the page is of.
struct PageContent {
  std::string title;
  std::string stream;  ///< URL; empty where the page gets it from its own address
  std::string poster;  ///< URL of a picture; empty for none
};

/// index.html of the player, as text to be completed. Throws ToolError (kInvalidInput) that names `file`
/// where what is to be replaced is not there.
class PlayerPage {
 public:
  PlayerPage(std::string html, std::string file) : html_(std::move(html)), file_(std::move(file)) {}

  /// Puts title, stream and poster into the element that the script reads them from.
  void set(const PageContent& content);
  /// Lets the page find style and script in another folder: a URL that ends with a slash.
  void set_base(const std::string& folder);
  /// Puts style and script into the page itself.
  void embed(std::string_view style, std::string_view script);
  /// Data that the script finds in the page under a file's name.
  static std::string embedded_file(std::string_view name, std::string_view bytes);
  /// Puts HTML right before the script.
  void insert_before_script(std::string_view html);

  const std::string& html() const { return html_; }

 private:
  /// The element of the tag that has `mark` in it: where it begins, and where its start tag ends.
  struct Tag {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  Tag tag_with(std::string_view mark) const;
  void replace(std::string_view what, std::string_view with);

  std::string html_;
  std::string file_;
};

}  // namespace tvg::cli
