#include "prediction/surface_graph.hpp"

#include "base/allocation.hpp"
#include "prediction/spatial_links.hpp"

#include <algorithm>
#include <cmath>

namespace tvg {

namespace {

constexpr std::uint32_t kLongest =
    ~std::uint32_t{0};  /// A place with more links takes its colour before the others.
constexpr std::size_t kHubLinks = 32;

std::uint32_t edge_length(const ShapePoint& a, const ShapePoint& b) {
  const double length = 16.0 * std::sqrt(squared_distance(a, b));
  return length < static_cast<double>(kLongest) ? static_cast<std::uint32_t>(length) : kLongest;
}

/// Counts become where each place starts; the last is the end.
void sum_up(std::vector<std::uint32_t>& first) {
  std::uint32_t sum = 0;
  for (std::uint32_t& f : first) {
    const std::uint32_t count = f;
    f = sum;
    sum += count;
  }
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
  // Each start has become the end: sorted and without repetition the lists move together.
  std::uint32_t begin = 0, kept = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    const auto from = graph.links.begin() + begin, to = graph.links.begin() + graph.first[v];
    begin = graph.first[v];
    std::sort(from, to);
    graph.first[v] = kept;
    Link last = make_link(0, v);  // no link to itself, whose length would be 0
    for (auto link = from; link != to; ++link) {
      if (*link == last || end_of(*link) == v) continue;
      graph.links[kept++] = last = *link;
    }
  }
  graph.first[count] = kept;
  graph.links.resize(kept);
  return true;
}

bool colour(const SurfaceGraph& graph, std::span<const std::uint32_t> order,
            std::vector<std::uint32_t>& colours) {
  const std::uint32_t none = kLongest;
  colours.clear();
  std::vector<std::uint32_t> taken_for;  // [colour]: the place that has a neighbour of it
  if (!try_resize(colours, graph.size()) || !try_resize(taken_for, std::size_t{graph.size()} + 1))
    return false;
  std::fill(colours.begin(), colours.end(), none);
  std::fill(taken_for.begin(), taken_for.end(), none);
  // Those with many links first: a vertex that many surround is worth more than they are.
  for (const bool hubs : {true, false}) {
    for (const std::uint32_t place : order) {
      const std::span<const Link> links = graph.links_of(place);
      if ((links.size() > kHubLinks) != hubs) continue;
      for (const Link link : links) {
        const std::uint32_t other = colours[end_of(link)];
        if (other != none) taken_for[other] = place;
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
  const std::uint32_t size = graph.size();
  std::vector<std::uint32_t> way;  // [old place]: how far it is drawn
  place.clear();
  if (!try_resize(place, size) || !try_resize(way, size)) return false;
  std::uint32_t kept = 0;
  for (std::uint32_t p = 0; p < size; ++p) {
    if (colours[p] == 0) place[p] = kept++;
  }
  const std::uint32_t removed = size - kept;
  next = {};
  std::vector<std::uint32_t> members, first, seen;  // of each new place, those drawn to it
  if (!try_reserve(next.vertex, kept) || !try_reserve(next.first, std::size_t{kept} + 1) ||
      !try_reserve(next.links, graph.links.size() - 2 * std::size_t{removed}) || !try_resize(members, size) ||
      !try_resize(first, std::size_t{kept} + 1) || !try_resize(seen, kept))
    return false;
  for (std::uint32_t p = 0; p < size; ++p) {
    if (colours[p] != 0) {
      for (const Link link : graph.links_of(p)) {  // one of them has colour 0, or this had taken it
        if (colours[end_of(link)] != 0) continue;
        place[p] = place[end_of(link)];
        way[p] = length_of(link);
        break;
      }
    }
    ++first[place[p]];
  }
  sum_up(first);
  for (std::uint32_t p = 0; p < size; ++p) members[first[place[p]]++] = p;
  std::uint32_t begin = 0;
  for (std::uint32_t p = 0; p < kept; ++p) {
    const auto start = static_cast<std::uint32_t>(next.links.size());
    next.first.push_back(start);
    for (std::uint32_t i = begin; i < first[p]; ++i) {
      const std::uint32_t member = members[i];
      for (const Link link : graph.links_of(member)) {
        const std::uint32_t to = place[end_of(link)];
        if (to == p) continue;
        const Link found =
            make_link(add_lengths(add_lengths(way[member], length_of(link)), way[end_of(link)]), to);
        // A link already in the list of this place is found again through the place it leads to.
        if (seen[to] >= start && seen[to] < next.links.size() && end_of(next.links[seen[to]]) == to) {
          next.links[seen[to]] = std::min(next.links[seen[to]], found);
        } else {
          seen[to] = static_cast<std::uint32_t>(next.links.size());
          next.links.push_back(found);
        }
      }
    }
    begin = first[p];
    std::sort(next.links.begin() + start, next.links.end());
  }
  next.first.push_back(static_cast<std::uint32_t>(next.links.size()));
  for (std::uint32_t p = 0; p < size; ++p) {
    if (colours[p] == 0) next.vertex.push_back(graph.vertex[p]);
  }
  return true;
}

}  // namespace tvg
