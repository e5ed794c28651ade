#pragma once
#include "encoder/importers/mesh_sequence.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvg::cli {

/// The files of a sequence in the order of their frames.
struct SequenceFiles {
  std::vector<std::string> files;  ///< a file twice in a row: the second is a frame that is held
  std::vector<std::string> notes;  ///< what was chosen and what was left out
};

/// Finds the files of a numbered sequence ("walk_%04d.obj", "%04d/mesh.obj"), sorted by number. Throws
/// ImportError where there is none, or a number is missing and `gaps` says so. Returns nothing where `path`
/// is no such pattern, or is the name of a file that exists.
std::optional<SequenceFiles> find_pattern_files(const std::string& path, Gaps gaps);

/// The mesh files of a folder that are one sequence, by their number; or, where the folder has folders by
/// number instead, the mesh file in each. Throws ImportError where there is none, where the names are not of
/// one sequence, and as find_pattern_files() does.
SequenceFiles find_folder_files(const std::string& folder, Gaps gaps);

/// A list of mesh files as a sequence: in the order of their numbers or, where their names differ in more, in
/// natural order (frame2 before frame10). Throws ImportError as find_folder_files() does.
SequenceFiles order_listed_files(std::vector<std::string> files, Gaps gaps);

/// What might be meant by the name of a mesh file that does not exist, or that looks like one of a sequence:
/// "mesh_%d.obj (2 files)"; empty where there is no such thing in its folder.
std::string sequence_around(const std::string& path);

}  // namespace tvg::cli
