#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// A motion capture that goes with a source.
struct SkeletonSpec {
  std::string file;               ///< BVH
  std::string fps;                ///< of the source, as a user gave it; its metadata's where empty
  std::uint64_t first_frame = 0;  ///< number of the source's first frame within the whole sequence
  std::uint64_t frame_count = 0;  ///< of the whole sequence
};

/// Gives `source` the joints of a BVH file, end sites included, scaled and placed as they are there. Where
/// the file has as many frames as the whole sequence they are taken one to one. Otherwise frame i stands at i
/// / fps seconds, joints are interpolated, and beyond the file's end they hold the last pose; a note says so.
/// Throws ToolError: kUsage (no BVH file; no rate is known), kIo, kInvalidInput.
std::unique_ptr<FrameSource> attach_skeleton(std::unique_ptr<FrameSource> source, const SkeletonSpec& spec,
                                             std::vector<std::string>& notes);

}  // namespace tvg::cli
