#include "base/stream_error.hpp"

#include <tvg/types.hpp>

namespace tvg {

// format-spec §8.4
const char* error_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return "invalid-argument";
    case ErrorCode::kInvalidInput:
      return "invalid-input";
    case ErrorCode::kWrongState:
      return "wrong-state";
    case ErrorCode::kNotTvg:
      return "not-tvg";
    case ErrorCode::kUnsupportedVersion:
      return "unsupported-version";
    case ErrorCode::kTruncated:
      return "truncated";
    case ErrorCode::kChecksumMismatch:
      return "checksum-mismatch";
    case ErrorCode::kMalformed:
      return "malformed";
    case ErrorCode::kDigestMismatch:
      return "digest-mismatch";
    case ErrorCode::kUnsupported:
      return "unsupported";
    case ErrorCode::kLimitExceeded:
      return "limit-exceeded";
    case ErrorCode::kOutOfMemory:
      return "out-of-memory";
    case ErrorCode::kIo:
      return "io";
  }
  return "unknown";
}

std::string Error::describe() const {
  std::string text = message;
  text += " [";
  text += error_name(code);
  if (byte_offset) text += ", byte " + decimal(*byte_offset);
  if (frame) text += ", frame " + decimal(*frame);
  if (section[0] != '\0') text += std::string(", spec ") + section;
  return text + "]";
}

}  // namespace tvg
