#pragma once
#include <string>
#include <utility>

#include <tvg/types.hpp>

// Errors that are a code and a sentence.
namespace tvg {

inline Error invalid_argument(std::string message) {
  return {ErrorCode::kInvalidArgument, std::move(message)};
}

inline Error invalid_input(std::string message) {
  return {ErrorCode::kInvalidInput, std::move(message)};
}

inline Error out_of_memory(std::string message) {
  return {ErrorCode::kOutOfMemory, std::move(message)};
}

/// An error at a frame, counted from 0.
inline Error at_frame(std::uint64_t frame, Error error) {
  error.frame = frame;
  return error;
}

}  // namespace tvg
