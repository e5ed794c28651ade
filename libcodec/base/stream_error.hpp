#pragma once
#include <initializer_list>
#include <string_view>

#include <tvg/types.hpp>

namespace tvg {

/// No memory was to be had. The message is short enough for std::string to hold it without an allocation,
/// which would fail too.
Error out_of_memory();

/// What is wrong with a stream's bytes: a section of the specification and a sentence, given in pieces. The
/// place is the caller's to add. kOutOfMemory where there is no memory for the sentence.
Error stream_error(ErrorCode code, const char* section, std::initializer_list<std::string_view> sentence);

/// A field has a value that the specification forbids.
Error malformed(const char* section, std::string_view sentence);

}  // namespace tvg
