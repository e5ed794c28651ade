#include "connectivity/connectivity_encode.hpp"

#include "connectivity/traversal.hpp"
#include "geometry/half_edges_encode.hpp"

namespace tvg {
namespace {

/// The encoder's Guide: leads a Traversal over a mesh.
class MeshGuide {
 public:
  explicit MeshGuide(const Mesh& mesh)
      : mesh_(mesh),
        partner_(pair_half_edges(mesh)),
        visited_(mesh.faces.size(), false),
        index_(mesh.vertex_count, kNoVertex) {
    order_.reserve(mesh.vertex_count);
    first_corners_.reserve(mesh.faces.size());
  }

  void attach(const Border& border) { border_ = &border; }

  Step root_corner(std::size_t corner) {
    if (corner == 0) {
      while (visited_[next_root_]) ++next_root_;
      visited_[next_root_] = true;
      enter(3 * next_root_);
    }
    return step_to(mesh_.faces[current_ / 3][corner]);
  }

  Step behind(std::uint32_t edge) {
    const std::uint32_t partner = partner_[half_edge_[edge]];
    if (partner == kNoHalfEdge || visited_[partner / 3]) return {Operation::kBoundary, 0};
    visited_[partner / 3] = true;
    enter(partner);
    const BorderEdge& gate = border_->edge(edge);
    const bool previous =
        border_->meets_previous(edge) && half_edge_[gate.previous] == partner_[following(1)];
    const bool next = border_->meets_next(edge) && half_edge_[gate.next] == partner_[following(2)];
    if (previous && next) return {Operation::kClose, 0};
    if (previous) return {Operation::kPrevious, 0};
    if (next) return {Operation::kNext, 0};
    return step_to(mesh_.faces[current_ / 3][(current_ % 3 + 2) % 3]);
  }

  void opened(std::uint32_t edge, std::size_t side) {
    if (edge >= half_edge_.size()) half_edge_.resize(edge + 1);
    half_edge_[edge] = following(static_cast<std::uint32_t>(side));
  }

  void added_vertex() {
    index_[pending_] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(pending_);
  }

  /// [traversal index] = vertex index in the mesh, those that no face uses last.
  std::vector<std::uint32_t> take_order() {
    for (std::uint32_t v = 0; v < mesh_.vertex_count; ++v) {
      if (index_[v] == kNoVertex) order_.push_back(v);
    }
    return std::move(order_);
  }

  /// [traversal face]: the half-edge through which it was entered.
  std::vector<std::uint32_t> take_first_corners() { return std::move(first_corners_); }

 private:
  std::uint32_t following(std::uint32_t side) const { return current_ / 3 * 3 + (current_ % 3 + side) % 3; }

  void enter(std::uint32_t half_edge) {
    current_ = half_edge;
    first_corners_.push_back(half_edge);
  }

  Step step_to(std::uint32_t vertex) {
    pending_ = vertex;
    if (index_[vertex] == kNoVertex) return {Operation::kNew, 0};
    return {Operation::kReference, index_[vertex]};
  }

  const Mesh& mesh_;
  const Border* border_ = nullptr;
  std::vector<std::uint32_t> partner_;    ///< [half-edge]
  std::vector<bool> visited_;             ///< [face]
  std::vector<std::uint32_t> index_;      ///< [vertex in the mesh] = traversal index
  std::vector<std::uint32_t> order_;      ///< [traversal index]
  std::vector<std::uint32_t> half_edge_;  ///< [border edge]
  std::vector<std::uint32_t> first_corners_;
  std::uint32_t current_ = 0;  ///< the half-edge through which the current face was entered
  std::uint32_t pending_ = 0;  ///< the vertex that is numbered if it is new
  std::uint32_t next_root_ = 0;
};

}  // namespace

EncodedConnectivity encode_connectivity(const Mesh& mesh) {
  EncodedConnectivity result;
  RangeEncoder coder;
  MeshGuide guide(mesh);
  Traversal traversal(coder, guide, mesh.vertex_count, static_cast<std::uint32_t>(mesh.faces.size()),
                      result.connectivity);
  traversal.run();
  result.order = guide.take_order();
  result.first_corners = guide.take_first_corners();

  const std::uint64_t elements = std::uint64_t{mesh.vertex_count} + mesh.faces.size();
  RangeEncoder padded = coder;
  code_padding(coder, mesh.vertex_count, mesh.faces.size(), false);
  result.bytes = coder.finish();
  if (elements > kMaxElementsPerByte * result.bytes.size()) {
    code_padding(padded, mesh.vertex_count, mesh.faces.size(), true);
    result.bytes = padded.finish();
  }
  return result;
}

}  // namespace tvg
