#pragma once
#include "tool/tool_error.hpp"

#include <string>

#include <tvg/types.hpp>

namespace tvg::cli {

/// A user's file that cannot be read. The message names the file and the place. Thrown inside the importers
/// and by open_source(); read_frame() returns it as a value with the same code.
class ImportError : public ToolError {
 public:
  ImportError(ErrorCode code, const std::string& message);

  ErrorCode code() const { return code_; }
  /// The same as a value.
  Error as_value() const { return {.code = code_, .message = what(), .names_file = true}; }

 private:
  ErrorCode code_;
};

/// An input that has nothing to show: no bytes, or a mesh without faces.
class EmptyInputError : public ImportError {
 public:
  explicit EmptyInputError(const std::string& message) : ImportError(ErrorCode::kInvalidInput, message) {}
};

}  // namespace tvg::cli
