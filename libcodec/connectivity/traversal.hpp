#pragma once
#include "connectivity/border.hpp"
#include "connectivity/connectivity.hpp"
#include "entropy/range_coder.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

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
  for (std::uint64_t left = (vertex_count + face_count + 15) / 16; left > 0;) {
    const int bits = left < 15 ? static_cast<int>(left) : 15;
    if (coder.code_raw(0, bits) != 0) return false;
    left -= static_cast<std::uint64_t>(bits);
  }
  return true;
}

/// What a Guide tells about the triangle behind an edge, or about a corner of a root triangle.
struct Step {
  Operation operation = Operation::kNew;
  std::uint32_t vertex = 0;  ///< traversal index, for kReference
};

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
    operations_.fill(AdaptiveSymbol(kOperationCount));
    guide_.attach(border_);
  }

  /// Codes everything; false when the stream is malformed (decoding only).
  bool run() {
    while (result_.faces.size() < face_count_) {
      const std::uint32_t edge = border_.dequeue();
      if (!(edge == kNoEdge ? code_root() : code_edge(edge))) return false;
      if constexpr (Coder::kDecoding) {
        if (coder_.overrun()) return false;
      }
    }
    result_.gates.resize(vertex_count_);  // the rest belong to no face
    return true;
  }

 private:
  std::uint32_t visited() const { return static_cast<std::uint32_t>(result_.gates.size()); }

  /// A triangle that no border edge leads to: each corner is a new vertex or refers to one seen before.
  bool code_root() {
    Face face{};
    Gate gate;
    for (std::size_t i = 0; i < 3; ++i) {
      const Step step = guide_.root_corner(i);
      const bool known =
          visited() > 0 && coder_.code(root_known_[i], step.operation == Operation::kReference);
      face[i] = known ? code_reference(step.vertex) : visited();
      if (!known && !add_vertex(gate)) return false;
      if (face[i] >= visited()) return false;
      if (i == 0) gate.n = face[0];
      if (i == 1) gate.p = face[1];
      if (gate.p == gate.n) gate.p = kNoVertex;
    }
    const bool degenerate = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    add_face(face);
    if (degenerate) return true;  // nothing is ever glued to it
    std::array<std::uint32_t, 3> edges{};
    for (std::size_t i = 0; i < 3; ++i) {
      edges[i] = border_.open(face[i], face[(i + 1) % 3], face[(i + 2) % 3]);
      guide_.opened(edges[i], i);
    }
    for (std::size_t i = 0; i < 3; ++i) border_.link(edges[i], edges[(i + 1) % 3]);
    for (const std::uint32_t edge : edges) border_.enqueue(edge);
    return true;
  }

  bool code_edge(std::uint32_t id) {
    const BorderEdge gate = border_.edge(id);
    const Step step = guide_.behind(id);
    const auto operation = static_cast<Operation>(
        coder_.code(operations_[context(id)], static_cast<std::uint32_t>(step.operation)));
    if (operation == Operation::kBoundary) {
      border_.close(id);
      return true;
    }
    const bool to_previous = operation == Operation::kPrevious || operation == Operation::kClose;
    const bool to_next = operation == Operation::kNext || operation == Operation::kClose;
    const std::uint32_t previous = gate.previous, next = gate.next;
    if ((to_previous && !border_.meets_previous(id)) || (to_next && !border_.meets_next(id))) return false;
    if (to_previous && to_next && border_.edge(previous).from != border_.edge(next).to) return false;

    std::uint32_t v = visited();
    if (operation == Operation::kNew && !add_vertex({gate.from, gate.to, gate.across})) return false;
    if (operation == Operation::kReference) v = code_reference(step.vertex);
    if (to_previous) v = border_.edge(previous).from;
    if (to_next) v = border_.edge(next).to;
    if (v >= visited() || v == gate.from || v == gate.to) return false;
    add_face({gate.to, gate.from, v});

    const std::uint32_t known = border_.edge_at(v);
    std::uint32_t incoming = kNoEdge, outgoing = kNoEdge;
    if (!to_previous) {
      incoming = border_.open(gate.from, v, gate.to);
      guide_.opened(incoming, 1);
      border_.insert_before(id, incoming);
    }
    if (!to_next) {
      outgoing = border_.open(v, gate.to, gate.from);
      guide_.opened(outgoing, 2);
      border_.insert_before(id, outgoing);
    }
    border_.close(id);
    if (to_previous) border_.close(previous);
    if (to_next) border_.close(next);
    if (operation == Operation::kReference && known != kNoEdge) border_.splice(incoming, known);
    if (outgoing != kNoEdge) requeue(outgoing);
    if (incoming != kNoEdge) requeue(incoming);
    return true;
  }

  /// Degrees around an edge have grown: it and its neighbours may move up in the queue.
  void requeue(std::uint32_t id) {
    border_.enqueue(border_.edge(id).previous);
    border_.enqueue(border_.edge(id).next);
    border_.enqueue(id);
  }

  std::uint32_t code_reference(std::uint32_t vertex) {
    const std::uint32_t back = visited() - 1 - vertex;
    const int bits = std::bit_width(visited() - 1);
    const int low_bits = bits < 15 ? bits : 15;
    std::uint32_t value = coder_.code_raw(back & ((1u << low_bits) - 1), low_bits);
    for (int shift = 15; shift < bits; shift += 15) {
      const int count = bits - shift < 15 ? bits - shift : 15;
      value |= coder_.code_raw((back >> shift) & ((1u << count) - 1), count) << shift;
    }
    return visited() - 1 - value;  // wraps to a vertex not seen when the value is too large
  }

  std::size_t context(std::uint32_t id) const {
    const BorderEdge& e = border_.edge(id);
    const std::uint32_t a = std::min(border_.degree(e.from), 8u) - 1,
                        b = std::min(border_.degree(e.to), 8u) - 1;
    const bool p = border_.meets_previous(id), n = border_.meets_next(id);
    const bool close = p && n && border_.edge(e.previous).from == border_.edge(e.next).to;
    const std::size_t kind = close ? 4 : (p ? 1 : 0) + (n ? 2 : 0);
    return (kind * 8 + a) * 8 + b;
  }

  bool add_vertex(const Gate& gate) {
    if (visited() >= vertex_count_) return false;
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
  std::array<AdaptiveSymbol, 5 * 64> operations_;
  std::array<AdaptiveBit, 3> root_known_;
};

}  // namespace tvg
