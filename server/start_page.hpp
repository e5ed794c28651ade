#pragma once
#include <optional>
#include <string>

namespace tvg::server {

/// What browsers get of a folder: its streams, each with a link to the player, what is live, the folders in
/// it and its other files. `listing`: as folder_listing() has it. `live`: as live_listing() has it; nothing
/// where the page is not to tell. Without a player, streams lead to their files, and the page says why.
std::string start_page(const std::string& listing, const std::optional<std::string>& live, bool has_player);

}  // namespace tvg::server
