#pragma once
#include "player/view/surface.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/types.hpp>

namespace tvg::player {

/// What the frames of a GOP share.
struct PlayerGop {
  GopInfo info;
  std::vector<std::uint8_t> flags;  ///< [vertex]: 1 for an important one
  bool keeps_vertex_order = true;   ///< vertices come in the order of the sequence that was encoded
};

/// A frame ready to be drawn. Frames are recycled: one is never changed while somebody holds it.
struct PlayerFrame {
  std::uint64_t number = 0;  ///< position in the stream
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Surface> surface;  ///< how that mesh looks; null where the stream does not say
  std::shared_ptr<const PlayerGop> gop;
  std::vector<float> positions;  ///< [vertex][xyz]
  std::vector<float> normals;    ///< [vertex][xyz], unit length
  std::vector<float> colours;    ///< of Surface::frame_colours; empty without
  std::vector<float> values;     ///< [vertex], what a FrameDecorator made; empty without one
  std::uint64_t packet_bytes = 0;
  std::array<double, 3> bits{};  ///< of the residuals of x, y, z; zeros unless LoaderOptions asks for them
  double decode_ms = 0;          ///< from the packet to positions
  double prepare_ms = 0;         ///< normals and decorator
  bool is_keyframe = false;      ///< the first of its GOP
};

/// Adds something to frames before they are shown, such as a value per vertex for an overlay. Called by the
/// decoding thread only, so that what it costs delays no picture that is ready.
class FrameDecorator {
 public:
  virtual ~FrameDecorator() = default;

  /// A GOP begins; frames of it follow.
  virtual void on_gop(const Mesh& mesh, const PlayerGop& gop) = 0;
  /// Fills frame.values, [vertex], or leaves it empty.
  virtual void on_frame(PlayerFrame& frame) = 0;
};

}  // namespace tvg::player
