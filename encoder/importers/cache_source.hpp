#pragma once
#include <memory>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

struct CacheOptions {
  bool open_ended = false;  ///< as in SourceSpec
  double frame_rate = 0;    ///< that a user gave, which goes before the cache's times; 0 for none
  std::string array = {};   ///< of a .npz, the array to take; empty for the one that fits
};

/// Opens a vertex cache, PC2, PC16 (PC2 with float16 positions, by its suffix) or MDD
/// (told apart by the signature that PC2 has), whose frames are read from
/// disk one at a time. "-" is standard input, which cannot be rewound. `mesh` gives the connectivity and
/// `metadata` what else is known; `mesh_file` names the mesh in messages. An MDD cache with evenly spaced
/// times adds its `fps`, one with others the data "times", and both `start` where that is not 0; a PC2 cache
/// has no rate, because programs disagree on what its sample rate means, and so a `start` with a given rate
/// only. `notes` gets what a user may want to know: a header whose number of frames was never filled in,
/// bytes behind the last frame, uneven times. Throws ImportError: kIo, kInvalidInput (the vertex counts
/// differ, no frames, a pipe with more bytes than promised), kTruncated (fewer bytes than promised).
std::unique_ptr<FrameSource> open_cache(const std::string& path, Mesh mesh, Metadata metadata,
                                        const std::string& mesh_file, std::vector<std::string>& notes,
                                        const CacheOptions& options = {});

}  // namespace tvg::cli
