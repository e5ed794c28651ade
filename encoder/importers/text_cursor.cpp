#include "encoder/importers/text_cursor.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

#include <tvg/source.hpp>

namespace tvg::cli {

void TextCursor::skip_blanks_and_continuations() {
  for (;;) {
    skip_blanks();
    if (next_ == end_ || *next_ != '\\') return;
    const char* after = next_ + 1;
    while (after != end_ && is_blank(*after)) ++after;
    if (after == end_ || *after != '\n') return;
    next_ = after + 1;
    ++line_;
    if (next_ == end_) fail_at_end("a line that a backslash continues");
  }
}

void TextCursor::next_line() {
  next_ = std::find(next_, end_, '\n');
  if (next_ == end_) return;
  ++next_;
  ++line_;
}

bool TextCursor::next_content_line(char comment) {
  while (next_ != end_) {
    if (!at_line_end() && *next_ != comment) return true;
    next_line();
  }
  return false;
}

std::string_view TextCursor::rest_of_line() {
  skip_blanks();
  const char* begin = next_;
  next_ = std::find(next_, end_, '\n');
  const char* last = next_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

float TextCursor::number() {
  skip_blanks();
  const char* begin = next_;
  if (next_ != end_ && *next_ == '+') ++next_;
  float value = 0;
  const auto [after, error] = std::from_chars(next_, end_, value);
  if (error == std::errc::result_out_of_range) return number_slowly(begin);
  if (error != std::errc{} || (after != end_ && !is_delimiter(*after))) fail_number("a number", begin);
  next_ = after;
  return value;
}

float TextCursor::number_slowly(const char* begin) {
  next_ = begin;
  const std::string text(word());
  char* after = nullptr;
  const float value = std::strtof(text.c_str(), &after);
  if (*after != '\0') fail_number("a number", begin);
  if (!std::isfinite(value)) fail_number("a number that float32 can hold", begin);
  return value;
}

std::int64_t TextCursor::integer_prefix() {
  skip_blanks();
  const char* begin = next_;
  if (next_ != end_ && *next_ == '+') ++next_;
  std::int64_t value = 0;
  const auto [after, error] = std::from_chars(next_, end_, value);
  if (error != std::errc{}) fail_number("a whole number", begin);
  next_ = after;
  return value;
}

std::int64_t TextCursor::integer() {
  skip_blanks();
  const char* begin = next_;
  const std::int64_t value = integer_prefix();
  if (next_ != end_ && !is_delimiter(*next_)) fail_number("a whole number", begin);
  return value;
}

void TextCursor::fail_number(const char* expected, const char* begin) const {
  constexpr std::ptrdiff_t kShown = 30;
  const char* limit = begin + std::min(kShown, end_ - begin);
  const std::string found(begin, std::find_if(begin, limit, is_delimiter));
  if (found.empty()) fail(fmt::format("{} is missing", expected));
  fail(fmt::format("'{}' stands where {} should be", is_plain_text(found) ? found : "(binary)", expected));
}

void TextCursor::fail(const std::string& what, ErrorCode code) const {
  throw ImportError(code, fmt::format("{}, line {}: {}", file_, line_, what));
}

void TextCursor::fail_at_end(const std::string& inside) const {
  throw ImportError(ErrorCode::kTruncated, fmt::format("{} ends at line {} inside {}", file_, line_, inside));
}

void require_whole_text(const std::string& file, std::string_view text) {
  const std::size_t zero = text.find('\0');
  if (zero != text.npos) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{}: byte {} is zero, so this is not text", file, zero));
  }
  if (!text.ends_with('\n')) {
    throw ImportError(
        ErrorCode::kTruncated,
        fmt::format(
            "{} ends at byte {} inside line {}, which has no line end: the file is cut (if it is whole, add "
            "a line end)",
            file, text.size(), std::count(text.begin(), text.end(), '\n') + 1));
  }
}

bool is_plain_text(std::string_view text) {
  const auto is_control = [](char c) { return (static_cast<unsigned char>(c) < 0x20) || c == 0x7f; };
  return is_metadata_text(text) && std::none_of(text.begin(), text.end(), is_control);
}

}  // namespace tvg::cli
