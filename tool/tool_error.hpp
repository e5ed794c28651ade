#pragma once
#include <stdexcept>
#include <string>

#include <tvg/types.hpp>

namespace tvg::cli {

/// Exit status of the tool, with the numbers KTX's tool uses.
enum class ExitStatus : int { kSuccess = 0, kUsage = 1, kIo = 2, kInvalidInput = 3, kOther = 4 };

/// Ends a command: main() prints the message and exits with the status.
/// The message names the file, what is wrong, where, and what would be right.
class ToolError : public std::runtime_error {
 public:
  ToolError(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}

  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// A library error that concerns a file, as the tool reports it; `file` is added where the message does not
/// name one already.
ToolError tool_error(const std::string& file, const Error& error);

/// A library error whose message names the file already.
ToolError tool_error(const Error& error);

}  // namespace tvg::cli
