#include "connectivity/border.hpp"

namespace tvg {

std::uint32_t Border::open(std::uint32_t from, std::uint32_t to, std::uint32_t across) {
  const auto id = static_cast<std::uint32_t>(edges_.size());
  edges_.push_back({from, to, across, id, id, true});
  edge_at_[from] = id;
  if (edge_at_[to] == kNoEdge) edge_at_[to] = id;
  return id;
}

void Border::close(std::uint32_t id) {
  BorderEdge& e = edges_[id];
  e.open = false;
  link(e.previous, e.next);
  if (edge_at_[e.from] == id) {
    const bool other = e.previous != id && edges_[e.previous].to == e.from;
    edge_at_[e.from] = other ? e.previous : kNoEdge;
  }
  if (edge_at_[e.to] == id) {
    const bool other = e.next != id && edges_[e.next].from == e.to;
    edge_at_[e.to] = other ? e.next : kNoEdge;
  }
}

void Border::insert_before(std::uint32_t id, std::uint32_t added) {
  link(edges_[id].previous, added);
  link(added, id);
}

void Border::splice(std::uint32_t incoming, std::uint32_t known) {
  const std::uint32_t vertex = edges_[incoming].to;
  const std::uint32_t other = edges_[known].from == vertex ? edges_[known].previous : known;
  const std::uint32_t after_incoming = edges_[incoming].next;
  const std::uint32_t after_other = edges_[other].next;
  link(incoming, after_other);
  link(other, after_incoming);
}

std::uint32_t Border::last_open() {
  while (!edges_.empty() && !edges_.back().open) edges_.pop_back();
  return edges_.empty() ? kNoEdge : static_cast<std::uint32_t>(edges_.size() - 1);
}

}  // namespace tvg
