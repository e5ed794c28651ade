#pragma once
#include <utility>

#include <tvg/metrics.hpp>
#include <tvg/tvg.h>

/// What a handle stands for.
struct tvg_comparer {
  explicit tvg_comparer(tvg::Mesh given) : mesh(std::move(given)), comparison(mesh) {}

  tvg::Mesh mesh;
  tvg::SequenceComparison comparison;
};
