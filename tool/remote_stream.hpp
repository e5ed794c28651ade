#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace tvg::cli {

/// A stream that lies behind an http or https URL. Failures are ToolErrors (kIo) that name it.
class RemoteStream {
 public:
  virtual ~RemoteStream() = default;

  /// The URL without user and password.
  virtual const std::string& name() const = 0;
  /// Bytes of the whole; nothing of a live stream, which can be read once, front to back.
  virtual std::optional<std::uint64_t> size() const = 0;
  /// Reads bytes from `offset` on: as many as come at once, 0 only at the end.
  virtual std::size_t read(std::uint64_t offset, std::span<std::uint8_t> target) = 0;
};

/// Opens a URL; the server has answered, or a ToolError (kIo) says what was the matter.
using RemoteOpener = std::unique_ptr<RemoteStream> (*)(const std::string& url);

/// Whether a name is an http or https URL.
bool is_address(const std::string& name);
/// Gives every command that reads streams the network, which not every build of the tool has. Before the
/// first is opened.
void use_remote_opener(RemoteOpener opener);
/// Opens a URL. Throws ToolError (kUsage) where this tool has no network, and as RemoteOpener.
std::unique_ptr<RemoteStream> open_remote_stream(const std::string& url);

}  // namespace tvg::cli
