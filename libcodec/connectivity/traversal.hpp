#pragma once
#include "connectivity/border.hpp"
#include "connectivity/connectivity.hpp"
#include "entropy/code_bits.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

// The traversal of a mesh's triangles (format-spec §5.1), written once for encoder and decoder. `Coder` is
// RangeEncoder or RangeDecoder; `Guide` knows the mesh when encoding and is empty when decoding.
namespace tvg {

/// What lies behind a border edge (from, to): a triangle (to, from, v), or nothing.
enum class Operation : std::uint32_t {
  kNew,        ///< v is a vertex not seen before
  kPrevious,   ///< v is where the previous edge starts, and the triangle is glued to that edge too
  kNext,       ///< v is where the next edge ends, and the triangle is glued to that edge too
  kClose,      ///< both at once
  kReference,  ///< v is any vertex seen before
  kBoundary,   ///< no triangle
};
inline constexpr int kOperationCount = 6;

/// Codes the end of the stream: a bit that says whether zero bits follow, and these, one for 16 vertices and
/// faces. They keep a very regular mesh above the size that kMaxElementsPerByte asks for. False when a bit is
/// not zero.
template <class Coder>
bool code_padding(Coder& coder, std::uint64_t vertex_count, std::uint64_t face_count, bool padded) {
  if (coder.code_raw(padded, 1) == 0) return true;
  constexpr std::uint64_t kAtOnce = 30;  // whole pieces, so that the bytes are those of one long number
  for (std::uint64_t left = (vertex_count + face_count + 15) / 16; left > 0;) {
    const std::uint64_t bits = std::min(left, kAtOnce);
    if (code_bits(coder, 0, static_cast<int>(bits)) != 0) return false;
    left -= bits;
  }
  return true;
}

/// What a Guide tells about the triangle behind an edge, or about a corner of a root triangle.
struct Step {
  Operation operation = Operation::kNew;
  std::uint32_t vertex = 0;  ///< traversal index, for kReference
};

/// The models that code operations: each is coded with the mean of a model that learns fast, from coarse
/// contexts, and one that tells more of them apart.
class OperationModels {
 public:
  template <class Coder>
  std::uint32_t code(Coder& coder, const Border& border, std::uint32_t edge, Operation operation) {
    const BorderEdge& e = border.edge(edge);
    const std::uint32_t from = border.degree(e.from), to = border.degree(e.to);
    const std::size_t situation = situation_of(border, e, edge);
    const std::size_t coarse = (situation * 5 + clamp(from)) * 5 + clamp(to);
    const std::size_t fine = (situation * 8 + from - 1) * 8 + to - 1;
    return coder.code(coarse_[coarse], fine_[fine], static_cast<std::uint32_t>(operation));
  }

 private:
  static constexpr std::size_t kSituations = 5;

  /// 0 to 3: which of the neighbours the triangle could be glued to; 4: to both at one vertex.
  static std::size_t situation_of(const Border& border, const BorderEdge& e, std::uint32_t edge) {
    const bool previous = border.meets_previous(edge), next = border.meets_next(edge);
    if (previous && next && border.edge(e.previous).from == border.edge(e.next).to) return 4;
    return (previous ? 1u : 0u) + (next ? 2u : 0u);
  }
  /// Degrees 3 to 7 as 0 to 4.
  static std::uint32_t clamp(std::uint32_t degree) { return std::clamp(degree, 3u, 7u) - 3; }

  std::vector<AdaptiveSymbol> coarse_{kSituations * 25, AdaptiveSymbol(kOperationCount)};
  std::vector<AdaptiveSymbol> fine_{kSituations * 64, AdaptiveSymbol(kOperationCount)};
};

/// Codes references to vertices seen before: by their place along the border nearby, else by number.
class ReferenceModel {
 public:
  /// A vertex that is likely to lie near a border edge; `seen` or more where the stream is malformed.
  template <class Coder>
  std::uint32_t code_near(Coder& coder, const Border& border, std::uint32_t edge, std::uint32_t seen,
                          std::uint32_t vertex) {
    std::array<std::uint32_t, kCandidates> candidates{};
    std::uint32_t next = edge, previous = edge;
    for (std::size_t i = 0; i < kCandidates; i += 2) {
      next = border.edge(next).next;
      previous = border.edge(previous).previous;
      candidates[i] = border.edge(next).to;
      candidates[i + 1] = border.edge(previous).from;
    }
    std::uint32_t choice = 0;
    if constexpr (!Coder::kDecoding) {
      while (choice < kCandidates && candidates[choice] != vertex) ++choice;
    }
    choice = coder.code(choice_, choice);
    if (choice < kCandidates) return candidates[choice];
    return choice == kCandidates ? code_any(coder, seen, vertex) : seen;
  }

  /// Any of the `seen` vertices (at least one); `seen` or more where the stream is malformed.
  template <class Coder>
  static std::uint32_t code_any(Coder& coder, std::uint32_t seen, std::uint32_t vertex) {
    return code_bits(coder, vertex, std::bit_width(seen - 1));
  }

 private:
  static constexpr std::size_t kCandidates = 14;

  AdaptiveSymbol choice_{std::array<std::uint16_t, AdaptiveSymbol::kMaxSymbols>{
      2000, 2000, 15000, 15000, 5000, 5000, 2500, 2500, 1500, 1500, 1000, 1000, 500, 500, 10535, 0}};
};

/// Codes all triangles of a mesh, and finds the numbering and the gates of its vertices on the way.
template <class Coder, class Guide>
class Traversal {
 public:
  Traversal(Coder& coder, Guide& guide, std::uint32_t vertex_count, std::uint32_t face_count,
            Connectivity& result)
      : coder_(coder),
        guide_(guide),
        vertex_count_(vertex_count),
        face_count_(face_count),
        border_(vertex_count),
        result_(result) {
    guide_.attach(border_);
  }

  /// Codes everything; false when the stream is malformed (decoding only).
  bool run() {
    while (result_.faces.size() < face_count_) {
      const std::uint32_t edge = border_.last_open();
      if (!(edge == kNoEdge ? code_root() : code_edge(edge))) return false;
      if constexpr (Coder::kDecoding) {
        if (coder_.overrun()) return false;
      }
    }
    result_.gates.resize(vertex_count_);  // the rest belong to no face
    return true;
  }

 private:
  std::uint32_t seen() const { return static_cast<std::uint32_t>(result_.gates.size()); }

  /// A triangle that no border edge leads to: each corner is a new vertex or refers to one seen before.
  bool code_root() {
    Face face{};
    Gate gate;
    for (std::size_t i = 0; i < 3; ++i) {
      const Step step = guide_.root_corner(i);
      const bool known = seen() > 0 && coder_.code(root_known_[i], step.operation == Operation::kReference);
      face[i] = known ? ReferenceModel::code_any(coder_, seen(), step.vertex) : seen();
      if (!known && !add_vertex(gate)) return false;
      if (face[i] >= seen()) return false;
      if (i == 0) gate.n = face[0];
      if (i == 1 && face[1] != face[0]) gate.p = face[1];
    }
    add_face(face);
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
      return true;  // nothing is glued to it
    std::array<std::uint32_t, 3> edges{};
    for (std::size_t i = 0; i < 3; ++i) edges[i] = open(face[i], face[(i + 1) % 3], face[(i + 2) % 3], i);
    for (std::size_t i = 0; i < 3; ++i) border_.link(edges[i], edges[(i + 1) % 3]);
    return true;
  }

  /// What lies behind a border edge.
  bool code_edge(std::uint32_t id) {
    const Step step = guide_.behind(id);
    const std::uint32_t coded = operations_.code(coder_, border_, id, step.operation);
    if (coded >= kOperationCount) return false;
    const auto operation = static_cast<Operation>(coded);
    if (operation == Operation::kBoundary) {
      border_.close(id);
      return true;
    }
    const BorderEdge gate = border_.edge(id);
    const bool to_previous = operation == Operation::kPrevious || operation == Operation::kClose;
    const bool to_next = operation == Operation::kNext || operation == Operation::kClose;
    if ((to_previous && !border_.meets_previous(id)) || (to_next && !border_.meets_next(id))) return false;

    std::uint32_t v = seen();
    if (operation == Operation::kNew && !add_vertex({gate.from, gate.to, gate.across})) return false;
    if (operation == Operation::kReference)
      v = references_.code_near(coder_, border_, id, seen(), step.vertex);
    if (to_next) v = border_.edge(gate.next).to;
    if (to_previous) v = border_.edge(gate.previous).from;
    if (to_previous && to_next && v != border_.edge(gate.next).to) return false;
    if (v >= seen() || v == gate.from || v == gate.to) return false;
    add_face({gate.to, gate.from, v});
    advance(id, v, to_previous, to_next, operation == Operation::kReference);
    return true;
  }

  /// Moves the border over the triangle behind an edge, whose third vertex is v.
  void advance(std::uint32_t id, std::uint32_t v, bool to_previous, bool to_next, bool touches) {
    const BorderEdge gate = border_.edge(id);
    const std::uint32_t known = touches ? border_.edge_at(v) : kNoEdge;
    std::uint32_t incoming = kNoEdge;
    if (!to_previous) {
      incoming = open(gate.from, v, gate.to, 1);
      border_.insert_before(id, incoming);
    }
    if (!to_next) border_.insert_before(id, open(v, gate.to, gate.from, 2));
    border_.close(id);
    if (to_previous) border_.close(gate.previous);
    if (to_next) border_.close(gate.next);
    if (known != kNoEdge) border_.splice(incoming, known);
  }

  std::uint32_t open(std::uint32_t from, std::uint32_t to, std::uint32_t across, std::size_t side) {
    const std::uint32_t id = border_.open(from, to, across);
    guide_.opened(id, side);
    return id;
  }

  bool add_vertex(const Gate& gate) {
    if (seen() >= vertex_count_) return false;
    result_.gates.push_back(gate);
    guide_.added_vertex();
    return true;
  }

  void add_face(const Face& face) {
    result_.faces.push_back(face);
    for (const std::uint32_t v : face) border_.raise_degree(v);
  }

  Coder& coder_;
  Guide& guide_;
  std::uint32_t vertex_count_, face_count_;
  Border border_;
  Connectivity& result_;
  OperationModels operations_;
  ReferenceModel references_;
  std::array<AdaptiveBit, 3> root_known_;
};

}  // namespace tvg
