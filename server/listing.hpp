#pragma once
#include "server/live_hub.hpp"

#include <filesystem>
#include <string>
#include <vector>

// What the server says about its content, as JSON.
namespace tvg::server {

/// A path as a URL has it: everything but unreserved characters and slashes as %XX.
std::string url_of(const std::string& path);

/// The files and folders of `folder`, which is `root` or below it: for each name, type ("file", "folder"),
/// size in bytes, modified (ISO 8601, UTC), url; and of a stream frames, vertices (what its head declares)
/// and fps, as far as its head and index say so. Names that begin with a dot and links that lead out of the
/// root are left out. At most kMostListed entries; "complete" tells whether that is all.
std::string folder_listing(const std::filesystem::path& root, const std::filesystem::path& folder);

inline constexpr std::size_t kMostListed = 10000;

/// The live streams: for each name, url, viewers, frames, gops, bytes_per_second (mean since it began) and
/// since (ISO 8601, UTC).
std::string live_listing(const std::vector<LiveStatus>& streams);

}  // namespace tvg::server
