#include "prediction/surface_graph.hpp"

#include "base/allocation.hpp"
#include "prediction/spatial_links.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace tvg {

namespace {

constexpr std::uint32_t kLongest = ~std::uint32_t{0};
/// A place with more links takes its colour before the others.
constexpr std::size_t kHubLinks = 32;

std::uint32_t edge_length(const ShapePoint& a, const ShapePoint& b) {
  const double length = 16.0 * std::sqrt(squared_distance(a, b));
  return length < static_cast<double>(kLongest) ? static_cast<std::uint32_t>(length) : kLongest;
}

/// Counts become the sums of those before them.
void sum_up(std::vector<std::uint32_t>& first) {
  std::uint32_t sum = 0;
  for (std::uint32_t& f : first) {
    const std::uint32_t count = f;
    f = sum;
    sum += count;
  }
}

/// Of links that are filled in so that `first` says where those of each place end: in order and without
/// repetition.
void sort_links(SurfaceGraph& graph) {
  std::uint32_t begin = 0, kept = 0;
  for (std::uint32_t p = 0; p < graph.size(); ++p) {
    const auto from = graph.links.begin() + begin, to = graph.links.begin() + graph.first[p];
    begin = graph.first[p];
    std::sort(from, to);
    graph.first[p] = kept;
    Link last = make_link(0, p);
    for (auto link = from; link != to; ++link) {
      if (*link == last || end_of(*link) == p) continue;
      graph.links[kept++] = last = *link;
    }
  }
  graph.first[graph.size()] = kept;
  graph.links.resize(kept);
}

/// The old places that are drawn together to each new one.
struct Clusters {
  std::vector<std::uint32_t> members;  ///< old places, by new place, then ascending
  std::vector<std::uint32_t> end;      ///< [new place]: where its members end
  std::vector<std::uint32_t> way;      ///< [old place]: how far it is drawn

  std::span<const std::uint32_t> of(std::uint32_t place) const {
    const std::uint32_t begin = place == 0 ? 0 : end[place - 1];
    return std::span(members).subspan(begin, end[place] - begin);
  }
};

/// Draws the places on that have no link to one of colour 0, for which `place` is kLongest: one after the
/// other, the nearest along links first, to what its link leads to is drawn to.
bool draw_further(const SurfaceGraph& graph, std::vector<std::uint32_t>& place, Clusters& clusters) {
  constexpr std::uint32_t kNone = kLongest;
  std::size_t ways = 0;
  for (std::uint32_t p = 0; p < graph.size(); ++p) ways += place[p] == kNone ? graph.links_of(p).size() : 0;
  if (ways == 0) return true;
  std::vector<Link> queue;  // a heap: way and place, the least first
  if (!try_reserve(queue, ways)) return false;
  std::vector<std::uint32_t>& leads_to = clusters.members;  // [place], until it is drawn
  std::fill(leads_to.begin(), leads_to.end(), kNone);
  const auto reach_from = [&](std::uint32_t from) {
    for (const Link link : graph.links_of(from)) {
      const std::uint32_t to = end_of(link), way = add_lengths(clusters.way[from], length_of(link));
      if (place[to] != kNone || (leads_to[to] != kNone && clusters.way[to] <= way)) continue;
      leads_to[to] = place[from];
      clusters.way[to] = way;
      queue.push_back(make_link(way, to));
      std::push_heap(queue.begin(), queue.end(), std::greater<>());
    }
  };
  for (std::uint32_t p = 0; p < graph.size(); ++p) {
    if (place[p] != kNone) reach_from(p);
  }
  while (!queue.empty()) {
    const std::uint32_t nearest = end_of(queue.front());
    std::pop_heap(queue.begin(), queue.end(), std::greater<>());
    queue.pop_back();
    if (place[nearest] != kNone) continue;  // by a shorter way
    place[nearest] = leads_to[nearest];
    reach_from(nearest);
  }
  return true;
}

/// Draws each place to the nearest of colour 0.
bool draw(const SurfaceGraph& graph, std::span<const std::uint32_t> colours,
          std::vector<std::uint32_t>& place, Clusters& clusters) {
  const std::uint32_t size = graph.size();
  place.clear();
  if (!try_resize(place, size) || !try_resize(clusters.way, size) || !try_resize(clusters.members, size))
    return false;
  std::uint32_t kept = 0;
  for (std::uint32_t p = 0; p < size; ++p) {
    if (colours[p] == 0) place[p] = kept++;
  }
  if (!try_resize(clusters.end, kept)) return false;
  for (std::uint32_t p = 0; p < size; ++p) {
    if (colours[p] == 0) continue;
    // Links ascend, so the first is the nearest.
    const std::span<const Link> links = graph.links_of(p);
    const auto nearest =
        std::find_if(links.begin(), links.end(), [colours](Link l) { return colours[end_of(l)] == 0; });
    place[p] = nearest == links.end() ? kLongest : place[end_of(*nearest)];
    clusters.way[p] = nearest == links.end() ? 0 : length_of(*nearest);
  }
  if (!draw_further(graph, place, clusters)) return false;
  for (const std::uint32_t to : place) ++clusters.end[to];
  sum_up(clusters.end);
  for (std::uint32_t p = 0; p < size; ++p) clusters.members[clusters.end[place[p]]++] = p;
  return true;
}

}  // namespace

bool edges_of(std::span<const Face> faces, std::span<const ShapePoint> shape, SurfaceGraph& graph) {
  const auto count = static_cast<std::uint32_t>(shape.size());
  SpatialLinks further;
  if (!further.find(faces, shape)) return false;
  std::uint64_t links = 6 * std::uint64_t{faces.size()};
  further.for_each(shape, [&links](std::uint32_t, std::uint32_t, bool) { links += 2; });
  if (links > kLongest || !try_resize(graph.vertex, count) ||
      !try_resize(graph.first, std::size_t{count} + 1) ||
      !try_resize(graph.links, static_cast<std::size_t>(links)))
    return false;
  for (std::uint32_t v = 0; v < count; ++v) graph.vertex[v] = v;
  for (const Face& face : faces) {
    for (const std::uint32_t v : face) graph.first[v] += 2;
  }
  further.for_each(shape, [&graph](std::uint32_t a, std::uint32_t b, bool) {
    ++graph.first[a];
    ++graph.first[b];
  });
  sum_up(graph.first);
  const auto put = [&graph](std::uint32_t from, std::uint32_t to, std::uint32_t length) {
    graph.links[graph.first[from]++] = make_link(length, to);
    graph.links[graph.first[to]++] = make_link(length, from);
  };
  for (const Face& face : faces) {
    const std::uint32_t ab = edge_length(shape[face[0]], shape[face[1]]),
                        bc = edge_length(shape[face[1]], shape[face[2]]),
                        ca = edge_length(shape[face[2]], shape[face[0]]);
    put(face[0], face[1], ab);
    put(face[1], face[2], bc);
    put(face[2], face[0], ca);
  }
  further.for_each(shape, [&](std::uint32_t a, std::uint32_t b, bool at_one_point) {
    put(a, b, at_one_point ? 0 : add_lengths(kApart, edge_length(shape[a], shape[b])));
  });
  sort_links(graph);
  return true;
}

bool colour(const SurfaceGraph& graph, std::span<const std::uint32_t> order,
            std::vector<std::uint32_t>& colours) {
  constexpr std::uint32_t kNone = kNoColour;
  colours.clear();
  std::vector<std::uint32_t> taken_for;  // [colour]: the place that has a neighbour of it
  if (!try_resize(colours, graph.size()) || !try_resize(taken_for, std::size_t{graph.size()} + 1))
    return false;
  std::fill(colours.begin(), colours.end(), kNone);
  std::fill(taken_for.begin(), taken_for.end(), kNone);
  // Those with many links first: a vertex that many surround is worth more than they are.
  for (const bool hubs : {true, false}) {
    for (const std::uint32_t place : order) {
      const std::span<const Link> links = graph.links_of(place);
      if ((links.size() > kHubLinks) != hubs) continue;
      for (const Link link : links) {
        const std::uint32_t other = colours[end_of(link)];
        if (other != kNone) taken_for[other] = place;
      }
      std::uint32_t least = 0;
      while (taken_for[least] == place) ++least;
      colours[place] = least;
    }
  }
  return true;
}

bool contract(const SurfaceGraph& graph, std::span<const std::uint32_t> colours, SurfaceGraph& next,
              std::vector<std::uint32_t>& place) {
  Clusters clusters;
  if (!draw(graph, colours, place, clusters)) return false;
  const auto kept = static_cast<std::uint32_t>(clusters.end.size());
  const std::size_t removed = graph.size() - kept;
  next = {};
  std::vector<std::uint32_t> found;  // [new place]: the last link that leads there
  // Of each place that is drawn to another, the link between the two goes, both ways.
  if (!try_reserve(next.vertex, kept) || !try_reserve(next.first, std::size_t{kept} + 1) ||
      !try_reserve(next.links, graph.links.size() - 2 * removed) || !try_resize(found, kept))
    return false;
  for (std::uint32_t p = 0; p < graph.size(); ++p) {
    if (colours[p] == 0) next.vertex.push_back(graph.vertex[p]);
  }
  for (std::uint32_t p = 0; p < kept; ++p) {
    const auto start = static_cast<std::uint32_t>(next.links.size());
    next.first.push_back(start);
    for (const std::uint32_t member : clusters.of(p)) {
      for (const Link link : graph.links_of(member)) {
        const std::uint32_t to = place[end_of(link)];
        if (to == p) continue;
        const std::uint32_t length =
            add_lengths(add_lengths(clusters.way[member], length_of(link)), clusters.way[end_of(link)]);
        // What an earlier place left there lies below `start`; what nothing was left in may say 0, wrongly.
        const std::uint32_t at = found[to];
        if (at >= start && at < next.links.size() && end_of(next.links[at]) == to) {
          next.links[at] = std::min(next.links[at], make_link(length, to));
        } else {
          found[to] = static_cast<std::uint32_t>(next.links.size());
          next.links.push_back(make_link(length, to));
        }
      }
    }
    std::sort(next.links.begin() + start, next.links.end());
  }
  next.first.push_back(static_cast<std::uint32_t>(next.links.size()));
  return true;
}

}  // namespace tvg
