#pragma once
#include <filesystem>
#include <string>

namespace tvg::cli {

/// The folder of the player's files, which web/ builds: as named, beside the installed tool, or where the
/// build puts them. Empty where none of them has the player.
std::filesystem::path find_player_folder(const std::string& named);

/// The same. Throws ToolError (kIo) that says how to get the files where there are none.
std::filesystem::path player_folder(const std::string& named);

}  // namespace tvg::cli
