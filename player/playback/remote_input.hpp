#pragma once
#include "tool/remote_stream.hpp"

namespace tvg::player {

/// Opens a URL for commands that read a stream from front to back, with ranges where they leave something
/// out: a RemoteOpener.
std::unique_ptr<cli::RemoteStream> open_remote_input(const std::string& url);

}  // namespace tvg::player
