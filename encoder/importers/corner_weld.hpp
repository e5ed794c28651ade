#pragma once
#include <cstddef>
#include <span>

#include <tvg/geometry.hpp>

// Which corners of triangle soup (STL) are one vertex. Points are [point][xyz]; two are in one place where no
// coordinate differs by more than `tolerance`, directly or by way of others.
namespace tvg::cli {

/// Welds points that are in one place.
Weld weld_within(std::span<const float> points, double tolerance);

/// The weld with those vertices split whose points are not in one place here.
Weld split_weld(const Weld& weld, std::span<const float> points, double tolerance);

/// The number of vertices of the weld whose points are further apart than `tolerance`; with `first` their
/// first point that lies elsewhere than the vertex's first.
std::size_t count_torn(const Weld& weld, std::span<const float> points, double tolerance, std::size_t& first);

}  // namespace tvg::cli
