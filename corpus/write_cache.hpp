#pragma once
#include "corpus/corpus.hpp"

#include <string>

// Files of the generator. Each appears under its name when it is whole; failures throw tvg::cli::ToolError
// (kIo).
namespace tvg::corpus {

/// Connectivity and the first frame as Wavefront OBJ.
void write_obj(const std::string& path, const Sequence& sequence);

/// Every frame as a PC2 vertex cache, version 1.
void write_pc2(const std::string& path, const Sequence& sequence);

/// {"joints": [{"name", "parent"}], "frames": [frame][joint][x, y, z], "heaviest_joint": [vertex]}; a root's
/// parent is null, and where no skin is known there is no "heaviest_joint".
void write_skeleton(const std::string& path, const JointTracks& tracks);

}  // namespace tvg::corpus
