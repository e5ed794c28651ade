#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace tvg {

/// What went wrong. The numbers are frozen: grouped in tens, never renumbered, never reused.
enum class ErrorCode : int {
  // 1x: the caller
  kInvalidArgument = 10,  ///< an option or argument is outside its documented range
  kInvalidInput = 11,     ///< geometry that cannot be encoded: NaN, infinity, index out of range, no faces
  kWrongState = 12,       ///< what is asked for is not there yet, or not any more
  // 2x: the bytes
  kNotTvg = 20,              ///< the signature is missing
  kUnsupportedVersion = 21,  ///< a version or a critical chunk this decoder does not know
  kTruncated = 22,           ///< the bytes end before the structure does
  kChecksumMismatch = 23,    ///< a checksum does not fit its bytes
  kMalformed = 24,           ///< a field has a value the specification forbids
  kDigestMismatch = 25,      ///< decoded integers differ from those that were encoded
  // 3x: resources
  kLimitExceeded = 30,  ///< a declared or actual size is above the caller's or the stream's limit
  kOutOfMemory = 31,    ///< an allocation failed
  // 4x: the outside world
  kIo = 40,  ///< reading or writing failed
};

/// The code's name in kebab case ("checksum-mismatch"), as `--json` prints it.
const char* error_name(ErrorCode code);

/// An error as a value: nothing in the library throws across its public interface.
struct Error {
  ErrorCode code = ErrorCode::kMalformed;
  std::string message;  ///< one sentence: what is wrong and, where known, what would be right
  std::optional<std::uint64_t> byte_offset;  ///< where in the stream, counted from its first byte
  std::optional<std::uint64_t> frame;        ///< the first frame concerned, counted from 0
  const char* section = "";                  ///< section of format-spec/tvg.md that the bytes break, or ""

  /// The message with code, offset, frame and section appended, on one line.
  std::string describe() const;
};

/// Either a value or an error; test with `if (result)` before `*result` or `result.error()`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() { return *std::get_if<0>(&state_); }
  const T& operator*() const { return *std::get_if<0>(&state_); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  Error& error() { return *std::get_if<1>(&state_); }
  const Error& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or an error: test with `if (status.ok())`.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}

  bool ok() const { return !error_.has_value(); }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace tvg
