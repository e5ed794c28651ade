#include "base/stream_error.hpp"

#include "base/allocation.hpp"

namespace tvg {

std::string decimal(std::uint64_t number) {
  return std::to_string(number);
}

Error out_of_memory() {
  Error error;
  error.code = ErrorCode::kOutOfMemory;
  error.message = "out of memory";
  return error;
}

Error stream_error(ErrorCode code, const char* section, std::initializer_list<std::string_view> sentence) {
  if (!can_allocate(kSmallThings)) return out_of_memory();
  Error error;
  error.code = code;
  for (const std::string_view piece : sentence) error.message += piece;
  error.section = section;
  return error;
}

Error error_of(const Fault& fault) {
  return stream_error(fault.code, fault.section, {fault.sentence});
}

Error malformed(const char* section, std::string_view sentence) {
  return stream_error(ErrorCode::kMalformed, section, {sentence});
}

}  // namespace tvg
