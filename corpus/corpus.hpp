#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tvg/source.hpp>

// The project's own animated meshes: made by arithmetic alone, the same bits on every machine
// (exact_math.hpp).
namespace tvg::corpus {

/// How large a sequence to make.
struct SequenceSize {
  std::uint32_t vertices =
      2000;  ///< wanted vertices, 100 to 1,000,000; a generator comes as near as its shape lets it
  std::uint32_t frames = 60;  ///< frames at 30 per second, from 1; more frames go on with the motion
};

struct SkinnedSequence {
  Sequence sequence;
  JointTracks joints;  ///< in the units of the mesh, with the heaviest joint of each vertex
};

/// A hand that waves and curls its fingers one after the other: one closed component of genus 0, smooth
/// skinning by 21 joints. Vertices come in steps of about four: 394, 1570, 6274, 25090, 100354, ...
SkinnedSequence make_hand(const SequenceSize& size);

/// A mask with slits for mouth and eyes, which speaks, blinks and lifts its brows; most vertices never move.
/// One component with 4 boundary loops.
Sequence make_face(const SequenceSize& size);

/// A flag in gusty wind, simulated: one open component with wrinkles.
Sequence make_cloth(const SequenceSize& size);

/// Components of `make_toy`.
constexpr std::uint32_t kToyPartCount = 36;

/// A machine of `kToyPartCount` closed components that move rigidly, each on its own: gears, wheels, blocks,
/// balls.
Sequence make_toy(const SequenceSize& size);

/// What `make_soup` promises to contain, whatever its size.
struct SoupDefects {
  std::uint32_t isolated_vertices = 0;
  std::uint32_t duplicate_faces = 0;        ///< faces with the corners of an earlier face, in any order
  std::uint32_t repeated_corner_faces = 0;  ///< faces that name a vertex more than once
  std::uint32_t zero_area_faces = 0;        ///< three vertices, all on a line in every frame
  std::uint32_t non_manifold_edges = 0;     ///< edges of more than two different faces
  std::uint32_t non_manifold_vertices = 0;  ///< vertices off such edges whose faces form more than one fan
};

struct SoupSequence {
  Sequence sequence;
  SoupDefects defects;
};

/// Everything a mesh may do wrong: the defects listed, boundaries, a strip without orientation; vertices and
/// faces in random order.
SoupSequence make_soup(const SequenceSize& size);

/// A sequence by name, with its joints where it has some.
struct CorpusSequence {
  Sequence sequence;
  std::optional<JointTracks> joints;
};

struct CorpusEntry {
  std::string_view name;
  std::string_view description;  ///< one line
  CorpusSequence (*make)(const SequenceSize& size);
};

/// Every sequence there is.
std::span<const CorpusEntry> corpus_entries();

/// The entry of that name, or null.
const CorpusEntry* find_corpus_entry(std::string_view name);

/// A named size: "small" (tests and conformance streams), "demo" or "large" (100,000 vertices).
std::optional<SequenceSize> named_size(std::string_view name);

/// XXH64 (seed 0) of every coordinate of every frame as little-endian float32, in order.
std::uint64_t frames_digest(const Sequence& sequence);

/// XXH64 (seed 0) of every face's corners as little-endian uint32, in order.
std::uint64_t faces_digest(const Mesh& mesh);

}  // namespace tvg::corpus
