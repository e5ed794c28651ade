#pragma once
#include "player/frames/shown_frames.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tvg::player {

/// The frames of the sequence that another is compared with, by number.
class ReferenceFrames {
 public:
  /// `shown`: the name of the other sequence, for messages. Throws as open_frames() does.
  ReferenceFrames(ShownFramesSpec spec, std::string shown);

  /// The frame of this number, valid until the next call. Numbers that ascend are read front to back. Throws
  /// ToolError (kInvalidInput) where there is none, and as reading does.
  const ShownFrame& at(std::uint64_t number);
  /// Throws ToolError unless vertices of `frame` can be found in the frame of the same number: kUsage where
  /// one of the two gave up the order of its vertices, kInvalidInput for another number of them.
  const ShownFrame& same_mesh_at(std::uint64_t number, std::size_t vertices, bool keeps_vertex_order);
  /// Whether frames can be read again from the first on.
  bool rewind();

 private:
  /// False at the end.
  bool read_on_to(std::uint64_t number);

  const ShownFramesSpec spec_;
  const std::string shown_;
  std::unique_ptr<ShownFrames> frames_;
  ShownFrame frame_;  // without a mesh: none has been read
  std::optional<std::uint64_t> end_;
};

}  // namespace tvg::player
