#pragma once
#include <memory>
#include <string>
#include <string_view>

#include <tvg/skeleton.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// Reads the places of joints over time from JSON:
///   {"joints": [{"name": "palm", "parent": null}, {"name": "thumb_1", "parent": 0}],
///    "frames": [[[x, y, z], [x, y, z]], ...],      [frame][joint], in the mesh's units
///    "heaviest_joint": [0, 0, 1, ...]}             [vertex]; may be left out
/// Parents come before their children; a root has none (null). Throws ImportError: kIo, kInvalidInput.
JointTracks read_skeleton_file(const std::string& path);

/// The same of the text of such a file; `file` is its name for messages.
JointTracks parse_skeleton(const std::string& file, std::string_view text);

/// A source that brings the joints of `tracks` along with the frames of another. The first frame that is read
/// has those of frame `first_frame` of the tracks. Throws ImportError (kInvalidInput) unless `tracks`, which
/// `file` names in messages, are long enough for the source and their skin, if any, has its vertices.
std::unique_ptr<FrameSource> with_joints(std::unique_ptr<FrameSource> source, JointTracks tracks,
                                         const std::string& file, std::uint64_t first_frame);

}  // namespace tvg::cli
