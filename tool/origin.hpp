#pragma once
#include <array>
#include <optional>
#include <string>

#include <tvg/types.hpp>

// Coordinates far from zero are kept relative to a point, which metadata tell ("origin": "500000 4000000 0"),
// because float32 has no digits for both.
namespace tvg::cli {

/// A point that coordinates are relative to, xyz.
using Origin = std::array<double, 3>;

inline constexpr const char* kOriginKey = "origin";

/// "500000 4000000 0": each number the shortest that reads back as the same.
std::string origin_text(const Origin& origin);

/// The origin that metadata tell; (0, 0, 0) where they tell none, nothing where what they tell is no point.
std::optional<Origin> origin_of(const Metadata& metadata);

/// Whether it is (0, 0, 0): coordinates are what they are.
bool is_zero(const Origin& origin);

/// What is to be said of output in float32: its positions are relative to the origin still.
std::string relative_note(const Origin& origin, const std::string& format);

}  // namespace tvg::cli
