#pragma once
#include <nlohmann/json_fwd.hpp>

#include <tvg/metrics.hpp>

// What commands say of the distance between two surfaces.
namespace tvg::cli {

/// Null for what JSON has no number for.
nlohmann::json finite_or_null(double value);

/// "maximum, vertex   0.12   0.01 % of the diagonal", for standard output.
void print_distance(const char* name, double value, double relative);

/// To standard output: a few lines for people, or JSON with every frame measured.
void print_surface_report(const SurfaceReport& report);
void print_surface_json(const SurfaceReport& report);

/// All figures, with `measured` a list of frames.
nlohmann::json json_of(const SurfaceReport& report);

}  // namespace tvg::cli
