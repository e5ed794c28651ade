#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <tvg/types.hpp>

namespace tvg::cli {

/// Walks the lines and the words of a text in memory. Errors are ImportError and name the file and the line.
/// A line ends with LF, CR LF or CR, whatever the lines before it end with.
class TextCursor {
 public:
  /// `file` is the name for messages. Text and name must outlive the cursor.
  TextCursor(const std::string& file, std::string_view text, std::size_t first_line = 1)
      : file_(&file),
        begin_(text.data()),
        next_(text.data()),
        end_(text.data() + text.size()),
        line_(first_line) {}

  /// From here on what is wrong with a last line that has no line end is told as a file that is cut there.
  void expect_whole_lines() { whole_lines_ = true; }

  std::size_t line() const { return line_; }
  bool at_end() const { return next_ == end_; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - next_); }
  /// Whether nothing but blanks is left before the end of the line or of the text; skips these blanks.
  bool at_line_end() {
    skip_blanks();
    return next_ == end_ || is_line_end(*next_);
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

  /// The next number of this line, NaN and infinity among them. Numbers too small for float32 become 0 or
  /// denormal; too large ones are refused.
  float number() { return real<float>(); }
  /// The same in double.
  double wide_number() { return real<double>(); }
  /// The next word of this line as a number; NaN where it is none, is missing or is too large for float32.
  float number_or_nan();
  /// The same for double.
  double wide_number_or_nan();
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

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  static bool is_delimiter(char c) { return is_blank(c) || is_line_end(c); }

 private:
  template <class Real>
  Real real();
  template <class Real>
  Real real_slowly(const char* begin);
  bool in_cut_line() const;
  [[noreturn]] void fail_number(const char* expected, const char* begin) const;

  const std::string* file_;
  const char* begin_;
  const char* next_;
  const char* end_;
  std::size_t line_;
  bool whole_lines_ = false;
};

/// The bytes of a text without the byte order mark of UTF-8. Throws ImportError where they are UTF-16.
std::string_view without_byte_order_mark(const std::string& file, std::string_view bytes);

/// Throws ImportError where a text holds zero bytes.
void require_text(const std::string& file, std::string_view text);

/// What a note says of a text whose last line has no line end: its last number may have lost digits. Empty
/// where it has one.
std::string unended_line_note(std::string_view text);

/// Whether `text` can be shown in a line and kept as metadata: UTF-8 without control characters.
bool is_plain_text(std::string_view text);

}  // namespace tvg::cli
