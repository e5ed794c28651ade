#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include <tvg/measure.hpp>
#include <tvg/source.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// How the frames of a GOP are coded.
enum class Mode {
  kElp,  ///< positions, predicted in space and time
};

struct EncodeOptions {
  Mode mode = Mode::kElp;
  int fine_bits = 11;    ///< B2, 1 to 24: bits of important vertices
  int coarse_bits = 11;  ///< B1, 1 to B2: bits of the others
  /// Instead of B2: edge of a fine cell in the mesh's units. B2 is then what the bounding box needs, and B1
  /// lies below it by fine_bits - coarse_bits.
  std::optional<double> step;
  Importance importance;  ///< of no effect when both lattices are the same
  Predictor predictor = Predictor::kElp;
  std::uint32_t gop_frames = 50;  ///< frames per GOP, at least 1
  bool keep_vertex_order = true;
  std::uint64_t first_frame = 0;  ///< number of the source's first frame in a longer sequence it was cut from
  unsigned threads = 1;           ///< GOPs encoded at the same time; the bytes do not depend on it
  Metadata metadata;              ///< added to what the source says
};

/// What encoding made, in bytes.
struct EncodeReport {
  std::uint64_t frames = 0;
  std::uint32_t vertices = 0;
  std::uint64_t gops = 0;
  std::uint64_t bytes = 0;       ///< of the whole stream
  bool box_of_each_gop = false;  ///< the source could be read only once, so each GOP has a lattice of its own
};

/// Encodes a sequence to a stream in one pass of writing. A source that can be rewound is read twice, first
/// for the bounding box of the whole sequence. Memory is in proportion to `threads` GOPs. Errors:
/// kInvalidArgument for options out of range, kInvalidInput for geometry that cannot be encoded, and what
/// source and sink return.
Result<EncodeReport> encode(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                            const EncodeProgress& progress = {});

}  // namespace tvg
