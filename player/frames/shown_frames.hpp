#pragma once

#include "player/view/surface.hpp"
#include "tool/source_opener.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg::player {

/// A frame to be drawn, with all that belongs to it.
struct ShownFrame {
  std::uint64_t number = 0;                                ///< in its sequence, counted from 0
  std::uint64_t gop = 0;                                   ///< equal for frames that are coded together
  std::shared_ptr<const Mesh> mesh;                        ///< the same object as long as the mesh stays
  std::shared_ptr<const Surface> surface = {};             ///< how that mesh looks; null where nobody says
  FramePositions positions;                                ///< [vertex][xyz]
  std::vector<float> colours = {};                         ///< of Surface::frame_colours; empty without
  std::shared_ptr<const std::vector<std::uint8_t>> flags;  ///< [vertex]: 1 important; null without a GOP's
  std::vector<float> joints;                               ///< [joint][xyz]; empty without a skeleton
  std::vector<float> values;  ///< [vertex], what an overlay makes of them; empty without one
};

/// Frames one after the other, from a stream or from files. Broken input is a ToolError.
class ShownFrames {
 public:
  virtual ~ShownFrames() = default;

  /// Fills `frame`, whose memory is used again; false at the end.
  virtual bool next(ShownFrame& frame) = 0;
  /// Goes back to the first frame; false, and nothing happens, where the input can be read only once.
  virtual bool rewind() = 0;
  /// The number of frames, or of those up to the range's last, where it is known before the end.
  virtual std::optional<std::uint64_t> total() const = 0;
  /// Whether vertices come in the order of the sequence that was encoded.
  virtual bool keeps_vertex_order() const { return true; }
  /// The joints that move the mesh; empty where nobody knows of any. Valid as long as the frames.
  virtual const Skeleton& skeleton() const = 0;
  /// What is to be told of the frames given out so far; empty where that is nothing.
  virtual std::string note() const { return {}; }
  /// Valid as soon as the frames are open.
  virtual Metadata metadata() const = 0;
  /// When frames are, in seconds, where they are not evenly spaced; else empty. Valid as the metadata are.
  virtual std::vector<double> times() const { return {}; }
};

struct ShownFramesSpec {
  std::vector<std::string> inputs;     ///< a .tvg, "-" for one on standard input, or as SourceSpec has them
  std::optional<FrameRange> frames;    ///< all where absent
  bool flags = false;                  ///< frames come with their importance flags; only a .tvg has them
  bool whole_gops = false;             ///< give out all frames of the GOPs that the range touches
  bool conceal = false;                ///< hold the last good frame where frames are lost, and say so
  cli::SourceOpener open_source = {};  ///< opens inputs that are no .tvg
  std::uint32_t lod = 0;               ///< of a .tvg, as Decoder::use_lod() has it
  std::shared_ptr<const JointTracks> joints = {};  ///< of a .tvg, frames by number; null for none
  bool surfaces = false;                           ///< frames come with their surfaces
};

/// The folder of the files that inputs name, where what they refer to lies; empty for standard input.
std::string folder_of(const std::vector<std::string>& inputs);

/// Where the joints are in a frame of a stream: [joint][xyz]. Throws ToolError (kInvalidInput) that names the
/// stream where the tracks end before.
const std::vector<float>& joints_at(const JointTracks& tracks, std::uint64_t frame,
                                    const std::string& stream);

/// Whether these inputs are a .tvg.
bool is_stream(const std::vector<std::string>& inputs);

/// Opens what a user names. Throws ToolError: kUsage for inputs that do not fit together, for a range outside
/// the sequence and for flags of what is no .tvg; kIo; kInvalidInput.
std::unique_ptr<ShownFrames> open_frames(const ShownFramesSpec& spec);

// The two kinds of input behind it.
std::unique_ptr<ShownFrames> open_stream_frames(const ShownFramesSpec& spec);
std::unique_ptr<ShownFrames> open_source_frames(const ShownFramesSpec& spec);

}  // namespace tvg::player
