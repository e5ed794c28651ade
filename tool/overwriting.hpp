#pragma once

#include <string>

namespace tvg::cli {

/// From now on existing files are replaced without a question (`--force`).
void overwrite_without_asking();

/// Asks a user who sits at a terminal whether the file `path`, which exists, may be replaced; one "y" goes
/// for all files of the run. Where nobody sits there (errors go elsewhere) files are replaced. Throws
/// ToolError (kIo) where it is to stay, and where nobody can answer because input comes from elsewhere.
void confirm_overwriting(const std::string& path);

/// What a command writes that is given no name: `name` less its extension, with `ending` instead; of a folder
/// its name, of a pattern (walk_%04d.obj) what stands before the number. Throws ToolError (kUsage) where
/// `name` gives none
/// ("-").
std::string default_output(const std::string& name, const std::string& ending);

}  // namespace tvg::cli
