#include "cli/bench_report.hpp"

#include "tool/line_plot.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace tvg::cli {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const BitPair& bits) {
  return bits.fine == bits.coarse ? fmt::format("{}", bits.fine)
                                  : fmt::format("{}:{}", bits.fine, bits.coarse);
}

Json finite(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

/// The figures of a row by the names that `tvg compare` and `tvg encode` have for them; of JSON the keys, of
/// CSV the columns, in this order.
Json figures(const BenchedAnimation& animation, const BenchRow& row) {
  const ComparisonReport& errors = row.errors;
  const auto frames = static_cast<double>(animation.frames);
  const double vertices = frames * static_cast<double>(animation.vertices);
  Json json = {{"codec", row.codec}, {"mode", nullptr}, {"bits", nullptr}, {"coarse_bits", nullptr}};
  if (!row.mode.empty()) json["mode"] = row.mode;
  if (row.bits) json["bits"] = row.bits->fine;
  if (row.bits) json["coarse_bits"] = row.bits->coarse;
  json["bytes"] = row.bytes;
  json["bits_per_coordinate"] = bits_per_coordinate(row.bytes, animation.vertices, animation.frames);
  json["bits_per_vertex_frame"] = bits_per_vertex_and_frame(row.bytes, animation.vertices, animation.frames);
  json["rms_coordinate_error"] = errors.rms_coordinate_error;
  json["max_coordinate_error"] = errors.max_coordinate_error;
  json["relative_rms_coordinate_error"] = finite(errors.relative_rms_coordinate_error);
  json["relative_max_coordinate_error"] = finite(errors.relative_max_coordinate_error);
  json["kg_percent"] = finite(errors.kg_percent);
  json["snr_db"] = finite(errors.snr_db);
  json["sted"] = finite(errors.sted);
  json["hausdorff"] = errors.hausdorff ? Json(*errors.hausdorff) : Json(nullptr);
  json["relative_hausdorff"] = errors.relative_hausdorff ? finite(*errors.relative_hausdorff) : Json(nullptr);
  json["hausdorff_frames"] = errors.hausdorff_frames;
  for (const auto& [what, seconds] :
       {std::pair("encode", row.encode_seconds), std::pair("decode", row.decode_seconds)}) {
    json[fmt::format("{}_seconds", what)] = seconds;
    json[fmt::format("{}_frames_per_second", what)] = finite(frames / seconds);
    json[fmt::format("{}_vertices_per_second", what)] = finite(vertices / seconds);
  }
  return json;
}

/// A field as RFC 4180 has it.
std::string field(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  const auto text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? "\"\"" : std::string(1, letter);
  quoted += '"';
  return quoted;
}

std::string table_row(const BenchedAnimation& animation, const BenchRow& row) {
  const ComparisonReport& errors = row.errors;
  const double vertices = static_cast<double>(animation.frames) * static_cast<double>(animation.vertices);
  const std::string hausdorff =
      errors.relative_hausdorff ? fmt::format("{:.5f}", 100 * *errors.relative_hausdorff) : "";
  return fmt::format(
      "  {:<12} {:>5} {:>10} {:>7.3f} {:>7.3f} {:>9.5f} {:>9.5f} {:>9.5f} {:>8.5f} {:>9} {:>8.3f} {:>8.3f} "
      "{:>7.2f} {:>7.2f}\n",
      row.title(), row.bits ? text_of(*row.bits) : "", row.bytes,
      bits_per_coordinate(row.bytes, animation.vertices, animation.frames),
      bits_per_vertex_and_frame(row.bytes, animation.vertices, animation.frames),
      100 * errors.relative_rms_coordinate_error, 100 * errors.relative_max_coordinate_error,
      errors.kg_percent, errors.sted, hausdorff, row.encode_seconds, row.decode_seconds,
      vertices / row.encode_seconds / 1e6, vertices / row.decode_seconds / 1e6);
}

}  // namespace

std::string bench_table(const BenchedAnimation& animation) {
  std::string table = fmt::format("{}: {} vertices, {} faces, {} frames, bounding box diagonal {:.6g}\n",
                                  animation.input.name, animation.vertices, animation.faces, animation.frames,
                                  animation.diagonal);
  table +=
      fmt::format("  {:<12} {:>5} {:>10} {:>7} {:>7} {:>9} {:>9} {:>9} {:>8} {:>9} {:>8} {:>8} {:>7} {:>7}\n",
                  "", "bits", "bytes", "bpc", "bpvf", "RMS %", "max %", "KG %", "STED", "Hausd. %", "enc s",
                  "dec s", "enc Mv", "dec Mv");
  for (const BenchRow& row : animation.rows) table += table_row(animation, row);
  return table;
}

std::string bench_legend(int runs) {
  return fmt::format(
      "bpc, bpvf: bits per coordinate, and per vertex and frame. RMS, max: of a coordinate, and Hausdorff\n"
      "distance of the surfaces, in percent of the diagonal. s: processor time, the fastest of {}; Mv:\n"
      "million vertices a second.\n",
      runs == 1 ? "one run" : fmt::format("{} runs", runs));
}

std::string bench_csv_header() {
  std::string line = "animation,vertices,faces,frames,diagonal";
  const Json columns = figures({}, {});
  for (const auto& [name, value] : columns.items()) line += fmt::format(",{}", name);
  return line + "\n";
}

std::string bench_csv(const BenchedAnimation& animation) {
  std::string lines;
  for (const BenchRow& row : animation.rows) {
    lines += fmt::format("{},{},{},{},{}", field(animation.input.name), animation.vertices, animation.faces,
                         animation.frames, Json(animation.diagonal).dump());
    const Json columns = figures(animation, row);
    for (const auto& [name, value] : columns.items()) lines += fmt::format(",{}", field(value));
    lines += "\n";
  }
  return lines;
}

std::string bench_json(const std::vector<BenchedAnimation>& animations) {
  Json json = {{"animations", Json::array()}};
  for (const BenchedAnimation& animation : animations) {
    Json one = {{"animation", animation.input.name},
                {"inputs", animation.input.files},
                {"vertices", animation.vertices},
                {"faces", animation.faces},
                {"frames", animation.frames},
                {"diagonal", animation.diagonal},
                {"rows", Json::array()}};
    for (const BenchRow& row : animation.rows) one["rows"].push_back(figures(animation, row));
    json["animations"].push_back(std::move(one));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string bench_plots(const std::vector<BenchedAnimation>& animations) {
  std::vector<LinePlot> plots;
  for (const BenchedAnimation& animation : animations) {
    for (const auto& [label, error] : {std::pair("KG error, percent", &ComparisonReport::kg_percent),
                                       std::pair("STED", &ComparisonReport::sted)}) {
      LinePlot plot{animation.input.name, {"bits per coordinate", true}, {label, true}, {}};
      for (const BenchRow& row : animation.rows) {
        if (plot.curves.empty() || plot.curves.back().name != row.title())
          plot.curves.push_back({row.title(), {}});
        plot.curves.back().points.emplace_back(
            bits_per_coordinate(row.bytes, animation.vertices, animation.frames), row.errors.*error);
      }
      plots.push_back(std::move(plot));
    }
  }
  return plot_svg(plots);
}

}  // namespace tvg::cli
