#include "encoder/importers/import_error.hpp"

namespace tvg::cli {

namespace {

ExitStatus status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return ExitStatus::kUsage;
    case ErrorCode::kIo:
      return ExitStatus::kIo;
    default:
      return ExitStatus::kInvalidInput;
  }
}

}  // namespace

ImportError::ImportError(ErrorCode code, const std::string& message)
    : ToolError(status_of(code), message), code_(code) {}

}  // namespace tvg::cli
