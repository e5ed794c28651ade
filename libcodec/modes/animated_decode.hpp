#pragma once
#include "attributes/animated_coder.hpp"
#include "base/checksum.hpp"
#include "modes/channels.hpp"
#include "modes/gop_mesh.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tvg {

/// Decodes the animated attributes of a GOP in any mode, packet by packet (format-spec §5.7.7).
class AnimatedDecoder {
 public:
  /// Begins a GOP of this mesh with these channels. kMalformed where one of them is missing; kOutOfMemory.
  Status begin(const Channels& channels, std::shared_ptr<const GopMesh> mesh);
  /// Takes a packet whose pieces fit, and the positions of which were decoded. kMalformed, kOutOfMemory.
  Status take(Bytes packet);
  /// Compares the digests in a digest packet that has those of all channels.
  Status check_digest(Bytes packet) const;

  /// The values of an attribute, by its number in the mesh, in the frame taken last, [value][component];
  /// empty where it is not animated.
  std::span<const float> values(std::size_t attribute) const;
  /// The bytes that they take of the packet.
  std::uint64_t bytes(std::size_t attribute) const;

 private:
  struct Channel {
    std::size_t place = 0;                 ///< among the GOP's channels
    std::unique_ptr<AnimatedCoder> coder;  ///< from the first frame on
    std::vector<float> values;             ///< in the order in which they are given
    Hasher digest;
    std::uint64_t bytes = 0;
  };

  const Channel* find(std::size_t attribute) const;
  Status take_piece(const AnimatedAttribute& attribute, Bytes piece, Channel& channel);
  Status begin_coder(const AnimatedAttribute& attribute, const AttributeGrid& grid, Channel& channel);
  void give(const AnimatedAttribute& attribute, Channel& channel) const;

  std::shared_ptr<const GopMesh> mesh_;
  std::optional<PropertyMesh> seen_;
  std::vector<std::uint32_t> partner_;  ///< [half-edge]
  Channels channels_;
  std::vector<Channel> list_;  ///< of the mesh's animated attributes, in their order
};

}  // namespace tvg
