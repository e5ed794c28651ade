#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <tvg/types.hpp>

namespace tvg::cli {

/// Walks the lines and the words of a text in memory. Errors are ImportError and name the file and the line.
/// A carriage return counts as a blank, so that CR LF ends a line as LF does.
class TextCursor {
 public:
  /// `file` is the name for messages. Text and name must outlive the cursor.
  TextCursor(const std::string& file, std::string_view text, std::size_t first_line = 1)
      : file_(file), next_(text.data()), end_(text.data() + text.size()), line_(first_line) {}

  std::size_t line() const { return line_; }
  bool at_end() const { return next_ == end_; }
  /// Whether nothing but blanks is left before the end of the line or of the text; skips these blanks.
  bool at_line_end() {
    skip_blanks();
    return next_ == end_ || *next_ == '\n';
  }
  /// Skips blanks of this line.
  void skip_blanks() {
    while (next_ != end_ && is_blank(*next_)) ++next_;
  }
  /// Skips blanks, and line ends after a backslash (OBJ continues a line this way).
  void skip_blanks_and_continuations();
  /// Goes to the start of the next line, or to the end.
  void next_line();
  /// Skips blank lines and lines that begin with `comment`; false at the end of the text.
  bool next_content_line(char comment);

  /// The next word of this line; empty at its end.
  std::string_view word() {
    skip_blanks();
    const char* begin = next_;
    while (next_ != end_ && !is_delimiter(*next_)) ++next_;
    return {begin, static_cast<std::size_t>(next_ - begin)};
  }
  /// The rest of the line without blanks around it.
  std::string_view rest_of_line();

  /// The next number of this line. Numbers too small for float32 become 0 or denormal; too large ones are
  /// refused.
  float number();
  /// The next whole number of this line, which ends at a blank.
  std::int64_t integer();
  /// As integer(), but what follows the digits is left for the caller.
  std::int64_t integer_prefix();
  /// The character at the cursor; a line end at the end of the text.
  char peek() const { return next_ == end_ ? '\n' : *next_; }
  void advance() { ++next_; }

  /// Throws "FILE, line N: what".
  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::kInvalidInput) const;
  /// Throws "FILE ends at line N inside what" (kTruncated).
  [[noreturn]] void fail_at_end(const std::string& inside) const;

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }
  static bool is_delimiter(char c) { return is_blank(c) || c == '\n'; }

 private:
  float number_slowly(const char* begin);
  [[noreturn]] void fail_number(const char* expected, const char* begin) const;

  const std::string& file_;
  const char* next_;
  const char* end_;
  std::size_t line_;
};

/// Refuses (ImportError) a text that holds zero bytes, and one whose last line has no line end: it is cut,
/// and the last number may have lost digits.
void require_whole_text(const std::string& file, std::string_view text);

/// Whether `text` can be shown in a line and kept as metadata: UTF-8 without control characters.
bool is_plain_text(std::string_view text);

}  // namespace tvg::cli
