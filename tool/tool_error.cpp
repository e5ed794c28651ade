#include "tool/tool_error.hpp"

namespace tvg::cli {

namespace {

ExitStatus exit_status(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return ExitStatus::kUsage;
    case ErrorCode::kIo:
      return ExitStatus::kIo;
    case ErrorCode::kOutOfMemory:
      return ExitStatus::kOther;
    default:
      return ExitStatus::kInvalidInput;
  }
}

}  // namespace

ToolError tool_error(const std::string& file, const Error& error) {
  if (error.names_file) return tool_error(error);
  return {exit_status(error.code), file + ": " + error.describe()};
}

ToolError tool_error(const Error& error) {
  // Importers say the place in words; code, offset and section tell about streams only.
  const bool has_place = error.byte_offset || error.frame || error.section[0] != '\0';
  return {exit_status(error.code), has_place ? error.describe() : error.message};
}

}  // namespace tvg::cli
