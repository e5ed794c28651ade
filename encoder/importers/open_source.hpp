#pragma once
#include "encoder/importers/mesh_sequence.hpp"
#include "encoder/importers/scene_options.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// What a user names as input.
struct SourceSpec {
  /// In any order: a mesh file (OBJ, PLY, OFF, STL) and a cache (PC2, PC16, MDD, NPY, NPZ, or "-" for a
  /// cache on standard input), which is found by itself where it lies beside the mesh under its name; or a
  /// sequence of mesh files, as a folder, a pattern ("walk_%04d.obj", "walk_####.obj") or all its files; one
  /// mesh file; or a scene (scene_source.hpp).
  std::vector<std::string> inputs;
  /// The frames wanted, counted from 0 whatever the numbers in the files' names; all where absent.
  std::optional<FrameRange> frames = {};
  /// For a scene: which clip and meshes, and how finely it is sampled.
  SceneOptions scene = {};
  /// A BVH file whose joints go with the frames of a cache or a sequence; none where empty. As many frames as
  /// the BVH has are taken one to one; otherwise frame i stands at i / fps seconds, where fps is that of
  /// `scene` or else of the input.
  std::string skeleton = {};
  /// A PC2 cache that comes through a pipe goes on until the pipe ends, whatever number of frames its header
  /// says. Its frame_count() is then unknown, and read_frame() is kTruncated where the pipe ends inside a
  /// frame.
  bool open_ended = false;
  /// Of a sequence, and how corners of STL are welded.
  SequenceOptions sequence = {};
  /// The axis that is up in a cache, where the mesh has another: "y" or "z"; its positions are turned. None
  /// where empty.
  std::string cache_up = {};
  /// Of a .npz, the array that is the positions; empty for the one that fits the mesh.
  std::string array = {};
};

struct OpenedSource {
  std::unique_ptr<FrameSource> source;
  std::vector<std::string>
      notes;  ///< for the user, e.g. "chicken.obj: 120 polygons triangulated to 240 triangles"
  std::shared_ptr<ReadNotes> later = {};  ///< what reading brings to light; may be none
};

/// Opens what a user names. One frame is in memory at a time. The mesh of a sequence is that of its first
/// wanted frame; the positions in a mesh file beside a cache are not used. Throws ToolError: kUsage (inputs
/// that do not fit together, a frame range outside the sequence), kIo (cannot be opened or read),
/// kInvalidInput (content). Later frames are checked as they are read: read_frame() returns kTruncated,
/// kInvalidInput or kIo, and its message names the file and the place.
OpenedSource open_source(const SourceSpec& spec);

}  // namespace tvg::cli
