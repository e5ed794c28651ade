#pragma once
#include "tool/animated_values.hpp"

#include <cstdint>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/stream_map.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// A GOP that was decoded ahead of the others.
struct DecodedGop {
  std::uint64_t first_frame = 0;  ///< position in the stream
  std::uint64_t mesh_offset = 0;  ///< where its mesh's chunk begins: tells whether the mesh is another
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const MeshProperties> properties;  ///< of the mesh
  std::vector<FramePositions> frames;                ///< [frame][vertex][xyz]
  std::vector<KeptValues> values;                    ///< [frame], of animated attributes
  /// Whether all is well up to the next GOP. Otherwise the frames are not to be used: who reads the stream
  /// from `first_frame` on learns what is missing.
  bool whole = false;
};

/// Decodes the GOPs of a file several at a time, each with a decoder of its own, and gives them out in order.
/// At most as many GOPs as there are threads are held beside the one given out last.
class DecodeAhead {
 public:
  /// The GOPs that hold `frames`, which the index in `map` has. Reads `path` in `threads` places at once, and
  /// uses so many components (Decoder::use_components()).
  DecodeAhead(std::string path, StreamMap map, const FrameRange& frames, unsigned threads,
              std::uint32_t components = kMaxComponents);
  ~DecodeAhead();

  /// The next GOP; nothing behind the last. Throws ToolError where the file cannot be read.
  std::optional<DecodedGop> next();

 private:
  class Worker;
  void start_next();

  std::string path_;
  StreamMap map_;
  std::uint64_t last_frame_;
  std::size_t next_place_ = 0;  ///< of map_, to be decoded next
  std::vector<std::unique_ptr<Worker>> idle_;
  struct Pending {
    std::unique_ptr<Worker> worker;
    std::future<DecodedGop> gop;
  };
  std::deque<Pending> pending_;  ///< in the order of the stream
};

}  // namespace tvg::cli
