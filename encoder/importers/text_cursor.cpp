#include "encoder/importers/text_cursor.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>
#include <type_traits>

#include <tvg/source.hpp>

namespace tvg::cli {

void TextCursor::skip_blanks_and_continuations() {
  for (;;) {
    skip_blanks();
    if (next_ == end_ || *next_ != '\\') return;
    const char* after = next_ + 1;
    while (after != end_ && is_blank(*after)) ++after;
    if (after == end_ || !is_line_end(*after)) return;
    next_line();
    if (next_ == end_) fail_at_end("a line that a backslash continues");
  }
}

void TextCursor::next_line() {
  next_ = std::find_if(next_, end_, is_line_end);
  if (next_ == end_) return;
  if (*next_ == '\r' && next_ + 1 != end_ && next_[1] == '\n') ++next_;
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
  next_ = std::find_if(next_, end_, is_line_end);
  const char* last = next_;
  while (last != begin && is_blank(last[-1])) --last;
  return {begin, static_cast<std::size_t>(last - begin)};
}

template <class Real>
Real TextCursor::real() {
  skip_blanks();
  const char* begin = next_;
  if (next_ != end_ && *next_ == '+') ++next_;
  Real value = 0;
  const auto [after, error] = std::from_chars(next_, end_, value);
  if (error == std::errc{} && (after == end_ || is_delimiter(*after))) {
    next_ = after;
    return value;
  }
  return real_slowly<Real>(begin);
}

/// Numbers out of range, and NaN and infinity as some C libraries print them: 1.#QNAN, -1.#IND, 1.#INF.
template <class Real>
Real TextCursor::real_slowly(const char* begin) {
  next_ = begin;
  const std::string text(word());
  const std::size_t odd = text.find(".#");
  if (odd != text.npos && odd > 0 && text[odd - 1] == '1') return std::numeric_limits<Real>::quiet_NaN();
  char* after = nullptr;
  const Real value = std::is_same_v<Real, float> ? std::strtof(text.c_str(), &after)
                                                 : static_cast<Real>(std::strtod(text.c_str(), &after));
  const bool starts_as_number = !text.empty() && text.find_first_of("xX") == text.npos;
  if (!starts_as_number || *after != '\0') fail_number("a number", begin);
  if (!std::isfinite(value)) {
    fail_number(
        std::is_same_v<Real, float> ? "a number that float32 can hold" : "a number that double can hold",
        begin);
  }
  return value;
}

template float TextCursor::real<float>();
template double TextCursor::real<double>();

float TextCursor::number_or_nan() {
  TextCursor ahead = *this;
  std::string_view text = ahead.word();
  if (text.starts_with('+')) text.remove_prefix(1);
  float value = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && after == text.data() + text.size()) {
    *this = ahead;
    return value;
  }
  // What is too small for float32 is an error to from_chars().
  const double wide = wide_number_or_nan();
  return std::abs(wide) < 1 ? static_cast<float>(wide) : std::numeric_limits<float>::quiet_NaN();
}

double TextCursor::wide_number_or_nan() {
  std::string_view text = word();
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && after == text.data() + text.size()
             ? value
             : std::numeric_limits<double>::quiet_NaN();
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
  const std::size_t comma = found.find(',');
  const auto digit_at = [&](std::size_t at) {
    return at < found.size() && found[at] >= '0' && found[at] <= '9';
  };
  const bool decimal_comma = comma != found.npos && (digit_at(comma + 1) || digit_at(comma - 1));
  fail(fmt::format("'{}' stands where {} should be{}", is_plain_text(found) ? found : "(binary)", expected,
                   decimal_comma ? ": numbers have a decimal point, this file has commas" : ""));
}

bool TextCursor::in_cut_line() const {
  return whole_lines_ && begin_ != end_ && !is_line_end(end_[-1]) && std::none_of(next_, end_, is_line_end);
}

void TextCursor::fail(const std::string& what, ErrorCode code) const {
  if (in_cut_line()) {
    throw ImportError(ErrorCode::kTruncated,
                      fmt::format("{} ends inside line {}, which has no line end: the file is cut ({})",
                                  *file_, line_, what));
  }
  throw ImportError(code, fmt::format("{}, line {}: {}", *file_, line_, what));
}

void TextCursor::fail_at_end(const std::string& inside) const {
  throw ImportError(ErrorCode::kTruncated,
                    fmt::format("{} ends at line {} inside {}", *file_, line_, inside));
}

std::string_view without_byte_order_mark(const std::string& file, std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (bytes.starts_with(kMark)) return bytes.substr(kMark.size());
  const auto zero_at = [&](std::size_t at) { return at < bytes.size() && bytes[at] == '\0'; };
  const bool little = bytes.starts_with("\xff\xfe") || (zero_at(1) && zero_at(3) && zero_at(5));
  const bool big = bytes.starts_with("\xfe\xff") || (zero_at(0) && zero_at(2) && zero_at(4));
  if (little != big) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{} is text in UTF-16: save it as UTF-8 or ASCII", file));
  }
  return bytes;
}

void require_text(const std::string& file, std::string_view text) {
  const std::size_t zero = text.find('\0');
  if (zero == text.npos) return;
  throw ImportError(ErrorCode::kInvalidInput,
                    fmt::format("{}: byte {} is zero, so this is not text", file, zero));
}

std::string unended_line_note(std::string_view text) {
  if (text.empty() || TextCursor::is_line_end(text.back())) return "";
  return "its last line has no line end and is taken as whole";
}

bool is_plain_text(std::string_view text) {
  const auto is_control = [](char c) { return (static_cast<unsigned char>(c) < 0x20) || c == 0x7f; };
  return is_metadata_text(text) && std::none_of(text.begin(), text.end(), is_control);
}

}  // namespace tvg::cli
