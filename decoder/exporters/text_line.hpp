#pragma once
#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace tvg::cli {

/// One line of text made of a word and numbers, each the shortest that reads back as the same.
class TextLine {
 public:
  /// Begins anew.
  TextLine& begin(std::string_view word) {
    text_.clear();
    text_.append(word);
    return *this;
  }
  template <class T>
  TextLine& add(T number) {
    if (!text_.empty()) text_.push_back(' ');
    return add_to_last(number);
  }
  /// Without a space before it.
  template <class T>
  TextLine& add_to_last(T number) {
    std::array<char, 32> digits;  // enough for any number
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    static_cast<void>(error);
    text_.append(digits.data(), end);
    return *this;
  }
  TextLine& add_text(std::string_view text) {
    text_.append(text);
    return *this;
  }
  /// The line with its end; valid until the next begin().
  std::string_view finish() {
    text_.push_back('\n');
    return text_;
  }

 private:
  std::string text_;
};

}  // namespace tvg::cli
