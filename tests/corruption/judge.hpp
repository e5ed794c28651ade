#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/types.hpp>

// Decodes damaged streams and compares what comes out with what went in.
namespace tvg::corruption {

/// The digest of every frame of an undamaged stream: lattice, positions and the faces of its mesh.
struct Original {
  std::vector<std::uint8_t> stream;
  std::vector<std::uint64_t> frames;  ///< [frame]
  std::uint64_t declared_memory = 0;  ///< bytes, as its head says
  std::uint32_t lod = 0;              ///< as which it is drawn
};

/// Of a stream by its name, or of one of its lods, "lods@1".
Original make_original(std::string_view conformance_stream);

/// What a decoder says about a damaged stream.
struct Verdict {
  std::vector<std::uint64_t> exact;                              ///< frames given out that are the original's
  std::vector<std::uint64_t> wrong;                              ///< frames given out that are not
  std::vector<std::pair<std::uint64_t, std::uint64_t>> reports;  ///< kDamage: first frame, number of frames
  std::optional<ErrorCode> error;                                ///< kError
  std::size_t memory = 0;                                        ///< bytes, the most at once

  bool reported(std::uint64_t frame) const;
  /// Nothing was reported: right only where nothing is wrong with the stream, whatever frames came out.
  bool called_valid() const;
};

/// Decodes `stream`, pushed in pieces of `piece` bytes. Allocations above `memory_cap` bytes fail.
Verdict judge(const Original& original, std::span<const std::uint8_t> stream, std::size_t piece = 1u << 20,
              std::size_t memory_cap = static_cast<std::size_t>(-1));

/// How many streams of a series ended in which way.
struct Tally {
  std::size_t cases = 0, refused = 0, partly_lost = 0, unharmed = 0, called_valid = 0;
  std::size_t wrong_frames = 0;  ///< given out, and reported
  std::size_t most_memory = 0;

  void add(const Original& original, const Verdict& verdict);
  std::string text() const;
};

}  // namespace tvg::corruption
