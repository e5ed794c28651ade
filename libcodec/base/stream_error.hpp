#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include <tvg/types.hpp>

namespace tvg {

/// The number in decimal digits: std::to_string, but not inlined wherever a message has a number.
std::string decimal(std::uint64_t number);

/// No memory was to be had. The message is short enough for std::string to hold it without an allocation,
/// which would fail too.
Error out_of_memory();

/// What is wrong with a stream's bytes: a section of the specification and a sentence, given in pieces. The
/// place is the caller's to add. kOutOfMemory where there is no memory for the sentence.
Error stream_error(ErrorCode code, const char* section, std::initializer_list<std::string_view> sentence);

/// What is wrong with a structure as it is read, if anything: smaller to pass on than an Error, of which one
/// is made at the end.
struct Fault {
  const char* section = "";
  const char* sentence = nullptr;  ///< null: nothing is wrong
  ErrorCode code = ErrorCode::kMalformed;

  explicit operator bool() const { return sentence != nullptr; }
};
Error error_of(const Fault& fault);

/// A field has a value that the specification forbids.
Error malformed(const char* section, std::string_view sentence);

}  // namespace tvg
