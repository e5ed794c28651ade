#include "prediction/nearest_search.hpp"

#include "base/allocation.hpp"

#include <algorithm>
#include <functional>

namespace tvg {

bool NearestSearch::reserve(std::uint32_t places) {
  if (!try_resize(reached_, places) || !try_reserve(queue_, std::size_t{kVisits} * kLinks)) return false;
  std::fill(reached_.begin(), reached_.end(), ~std::uint64_t{0});
  return true;
}

std::uint32_t NearestSearch::run(const SurfaceGraph& graph, std::span<const std::uint32_t> time,
                                 std::uint32_t from, std::span<std::uint32_t> found) {
  --search_;
  queue_.clear();
  reached_[from] = std::uint64_t{search_} << 32;
  follow(graph, from, 0);
  std::uint32_t count = 0;
  for (std::uint32_t visits = 1; visits < kVisits && !queue_.empty();) {
    const Link nearest = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    const std::uint32_t place = end_of(nearest), distance = length_of(nearest);
    if (static_cast<std::uint32_t>(reached_[place]) < distance) continue;  // a shorter way was found since
    if (distance >= kApart && count >= kEnough) break;
    ++visits;
    if (time[place] < time[from]) {
      found[count++] = place;
      if (count == found.size()) break;
    }
    follow(graph, place, distance);
  }
  return count;
}

void NearestSearch::follow(const SurfaceGraph& graph, std::uint32_t place, std::uint32_t distance) {
  const std::span<const Link> links = graph.links_of(place);
  for (const Link link : links.first(std::min<std::size_t>(links.size(), kLinks))) {
    const std::uint32_t to = end_of(link), there = add_lengths(distance, length_of(link));
    const std::uint64_t reached = (std::uint64_t{search_} << 32) | there;
    if (reached >= reached_[to]) continue;
    reached_[to] = reached;
    queue_.push_back(make_link(there, to));
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  }
}

}  // namespace tvg
