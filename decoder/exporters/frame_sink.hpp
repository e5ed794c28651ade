#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// Where decoded frames go. Calls come in the order begin_mesh, write_frame ..., finish; another begin_mesh
/// opens a stretch of other connectivity. Every failure is a ToolError that names the file: kIo where the
/// disk or the folder says no, kUsage where the format cannot hold what comes. No file appears under its name
/// before it is complete; what is incomplete is removed when the sink is destroyed without finish().
class FrameSink {
 public:
  virtual ~FrameSink() = default;

  /// `frame_count` is the number of frames of the whole output, where it is known.
  virtual void begin_mesh(const Mesh& mesh, const Metadata& metadata,
                          std::optional<std::uint64_t> frame_count) = 0;
  /// `positions` is [vertex][xyz] of the mesh begun last.
  virtual void write_frame(std::span<const float> positions) = 0;
  /// Completes the output. kInvalidInput where no frame was written.
  virtual void finish() = 0;
  /// The files written so far, in order.
  virtual const std::vector<std::string>& files() const = 0;
  /// What a user may want to know about what the format cannot hold.
  virtual std::vector<std::string> notes() const { return {}; }
};

struct SinkOptions {
  /// Write the mesh with the first frame as OBJ beside a cache ("back.obj" beside "back.pc2").
  bool mesh_beside_cache = true;
  /// The number in the name of the first file of a sequence.
  std::uint64_t first_number = 0;
};

/// The sink for the name that a user gives:
/// - "back.pc2" or "back.mdd": a cache, with its mesh beside it. The times of an MDD cache are in seconds
/// where the
///   metadata has `fps`, else they count frames. An OBJ that another program wrote is not overwritten as the
///   mesh beside a cache: that is an error (kUsage).
/// - "-": a PC2 cache on standard output, without a mesh; the number of frames must be known when the mesh
/// begins.
///   The same holds for caches written to pipes and devices.
/// - "back_%04d.obj" or "back_####.obj", or .ply (binary), .off, .stl (binary): one file per frame.
/// - "back.obj" etc.: one file where one frame comes, else back_0000.obj, back_0001.obj, ...
/// Throws ToolError (kUsage) where the suffix is not known or the name is a folder.
std::unique_ptr<FrameSink> open_sink(const std::string& path, const SinkOptions& options);

/// The names of the files that this sink may write, patterns among them.
std::vector<std::string> sink_outputs(const std::string& path, const SinkOptions& options);

}  // namespace tvg::cli
