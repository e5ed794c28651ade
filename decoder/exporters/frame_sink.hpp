#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// The values of animated attributes in one frame: [attribute], as in the mesh's properties,
/// [value][component]; empty for those that are not animated. Shorter, or empty, where those that follow have
/// none.
using AnimatedValues = std::span<const std::span<const float>>;

/// Where decoded frames go. Calls come in the order begin_mesh, write_frame ..., finish; another begin_mesh
/// opens a stretch of another mesh. Data of the stream come before the first mesh, or ("times") before
/// finish. Every failure is a ToolError that names the file: kIo where the disk or the folder says no, kUsage
/// where the format cannot hold what comes. No file appears under its name before it is complete; what is
/// incomplete is removed when the sink is destroyed without finish().
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// Free-form data of the stream (NamedData); what the format has no use for is passed over.
  virtual void add_data(const NamedData& /*data*/) {}
  /// `frame_count` is the number of frames of the whole output, where it is known.
  virtual void begin_mesh(const Mesh& mesh, const MeshProperties& properties, const Metadata& metadata,
                          std::optional<std::uint64_t> frame_count) = 0;
  /// `positions` is [vertex][xyz] of the mesh begun last.
  virtual void write_frame(std::span<const float> positions, AnimatedValues animated = {}) = 0;
  /// Completes the output. kInvalidInput where no frame was written.
  virtual void finish() = 0;
  /// The files written so far, in order.
  virtual const std::vector<std::string>& files() const = 0;
  /// Materials and images that were written beside them.
  virtual std::vector<std::string> files_beside() const { return {}; }
  /// What a user may want to know about what the format cannot hold.
  virtual std::vector<std::string> notes() const { return {}; }
};

struct SinkOptions {
  /// Write the mesh with the first frame as OBJ beside a cache ("back.obj" beside "back.pc2").
  bool mesh_beside_cache = true;
  /// The number in the name of the first file of a sequence.
  std::uint64_t first_number = 0;
  /// Positions of glTF on a lattice of 16 bits (KHR_mesh_quantization) in place of float32.
  bool gltf_quantized = false;
  /// Frames of glTF are held until the next, in place of passing over into it.
  bool gltf_steps = false;
};

/// The sink for the name that a user gives:
/// - "back.pc2", "back.mdd" or "back.npy" ([frame][vertex][xyz], float32): a cache, with its mesh beside it.
///   The times of an MDD cache are in seconds where the stream has them or `fps`, else they count frames. An
///   OBJ or MTL that another program wrote is not overwritten beside an output: that is an error (kUsage).
/// - "-": a PC2 cache on standard output, without a mesh; the number of frames must be known when the mesh
///   begins. The same holds for caches written to pipes and devices.
/// - "back.glb" or "back.gltf" (with back.bin): glTF 2.0, one file of all frames.
/// - "back_%04d.obj" or "back_####.obj", or .ply (binary), .off, .stl (binary): one file per frame.
/// - "back.obj" etc.: one file where one frame comes, else back_0000.obj, back_0001.obj, ...
/// Throws ToolError (kUsage) where the suffix is not known or the name is a folder.
std::unique_ptr<FrameSink> open_sink(const std::string& path, const SinkOptions& options);

/// The names of the files that this sink may write, patterns among them; but for images.
std::vector<std::string> sink_outputs(const std::string& path, const SinkOptions& options);

/// What a finished sink has written, for people: "back_0000.obj to back_0049.obj, with back.mtl".
std::string written_files(const FrameSink& sink, const std::string& path);

}  // namespace tvg::cli
