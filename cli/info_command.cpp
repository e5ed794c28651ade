#include "cli/commands.hpp"
#include "cli/properties_info.hpp"
#include "cli/scene_info.hpp"
#include "cli/stream_stretches.hpp"
#include "cli/time_base.hpp"
#include "tool/option_values.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include <tvg/metrics.hpp>
#include <tvg/survey.hpp>

namespace tvg::cli {

namespace {

struct InfoArguments {
  std::string input;
  std::string fps = "30";
  bool bits = false;
  bool json = false;
};

/// What only decoding tells.
struct DecodedFacts {
  std::array<double, 3> residuals{};                       ///< bytes of x, y and z
  double rows = 0;                                         ///< bytes of the rows of frames in mode basis
  std::array<std::uint64_t, kPredictorCount> predicted{};  ///< frames by their predictor
  std::vector<std::uint64_t> animated = {};                ///< [attribute], bytes of the values of frames
  std::map<std::uint64_t, std::uint32_t> flagged;  ///< important vertices of the GOP with this first frame
};

constexpr std::array<const char*, kPredictorCount> kPredictorNames = {"space",   "time", "elp",
                                                                      "pyramid", "rows", "shape"};

const char* name_of(Mode mode) {
  return mode == Mode::kLossless ? "lossless" : mode == Mode::kBasis ? "basis" : "elp";
}

const char* name_of(DataEncoding encoding) {
  return encoding == DataEncoding::kStored ? "stored" : encoding == DataEncoding::kZstd ? "zstd" : "unknown";
}

/// All that is shown of a stream.
struct StreamSummary {
  std::string file;
  StreamSurvey stream;
  std::optional<DecodedFacts> decoded;
  std::uint64_t damages = 0;
  TimeBase time;

  SurveyedMesh last_mesh() const { return stream.meshes.empty() ? SurveyedMesh() : stream.meshes.back(); }
  std::optional<std::uint32_t> flagged(const GopInfo& gop) const {
    if (!decoded) return std::nullopt;
    const auto entry = decoded->flagged.find(gop.first_frame);
    return entry == decoded->flagged.end() ? std::nullopt : std::optional(entry->second);
  }
  /// [attribute of the last mesh], what its values take of all frames, where they were decoded.
  std::span<const std::uint64_t> animated_bytes() const {
    return decoded ? std::span<const std::uint64_t>(decoded->animated) : std::span<const std::uint64_t>();
  }
  /// Vertices summed over frames.
  std::uint64_t vertex_frames() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < stream.gops.size(); ++i)
      sum += std::uint64_t{stream.gops[i].frame_count} * stream.meshes[stream.gop_meshes[i]].vertices;
    return sum;
  }
};

/// Bytes by what they serve; the last takes what is left.
std::vector<std::pair<const char*, double>> purposes(const StreamSummary& summary) {
  double connectivity = 0, order = 0, shape = 0, levels = 0, lods = 0, flags = 0, planes = 0, data = 0;
  double parts = 0, attributes = 0, polygons = 0;
  for (const SurveyedMesh& mesh : summary.stream.meshes) {
    connectivity += static_cast<double>(mesh.parts.connectivity_bytes);
    order += static_cast<double>(mesh.parts.order_bytes);
    shape += static_cast<double>(mesh.parts.shape_bytes);
    levels += static_cast<double>(mesh.parts.levels_bytes);
    lods += static_cast<double>(mesh.parts.lods_bytes);
    parts += static_cast<double>(mesh.parts.parts_bytes);
    attributes += static_cast<double>(mesh.parts.attributes_bytes);
    polygons += static_cast<double>(mesh.parts.polygons_bytes);
  }
  for (const GopInfo& gop : summary.stream.gops) flags += static_cast<double>(gop.flag_bytes);
  for (const SurveyedData& one : summary.stream.data) data += static_cast<double>(one.bytes);
  for (const SurveyedPlan& plan : summary.stream.plans) planes += static_cast<double>(plan.bytes);
  std::vector<std::pair<const char*, double>> result = {{"connectivity", connectivity},
                                                        {"order", order},
                                                        {"shape", shape},
                                                        {"levels", levels},
                                                        {"lods", lods},
                                                        {"flags", flags},
                                                        {"planes", planes},
                                                        {"data", data},
                                                        {"parts", parts},
                                                        {"attributes", attributes},
                                                        {"polygons", polygons}};
  double left = static_cast<double>(summary.stream.bytes);
  for (const auto& [purpose, bytes] : result) left -= bytes;
  if (!summary.decoded) {
    result.emplace_back("frames_and_container", left);
    return result;
  }
  constexpr std::array<const char*, 3> kNames = {"residuals_x", "residuals_y", "residuals_z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.emplace_back(kNames[axis], summary.decoded->residuals[axis]);
    left -= summary.decoded->residuals[axis];
  }
  result.emplace_back("rows", summary.decoded->rows);
  left -= summary.decoded->rows;
  double animated = 0;
  for (const std::uint64_t bytes : summary.decoded->animated) animated += static_cast<double>(bytes);
  result.emplace_back("animated_attributes", animated);
  left -= animated;
  result.emplace_back("container", left);
  return result;
}

/// What the frame says that was just decoded. A row is one of x, y and z together.
void take_frame(const Decoder& decoder, DecodedFacts& facts) {
  const Predictor predictor = decoder.frame_predictor();
  ++facts.predicted.at(static_cast<std::size_t>(predictor));
  for (std::size_t axis = 0; axis < 3; ++axis)
    (predictor == Predictor::kRows ? facts.rows : facts.residuals[axis]) += decoder.frame_bits()[axis] / 8;
  facts.animated.resize(std::max(facts.animated.size(), decoder.properties().attributes.size()));
  for (std::size_t i = 0; i < decoder.properties().attributes.size(); ++i)
    facts.animated[i] += decoder.animated_bytes(i);
}

DecodedFacts decode_facts(const std::string& path, std::uint64_t& damages) {
  StreamReader reader(path);
  Decoder& decoder = reader.decoder();
  decoder.measure_bits(true);
  DecodedFacts facts;
  damages = 0;
  for (;;) {
    switch (reader.next()) {
      case Decoder::Event::kGop:
        facts.flagged[decoder.gop().first_frame] = decoder.gop().flagged;
        break;
      case Decoder::Event::kFrame:
        take_frame(decoder, facts);
        break;
      case Decoder::Event::kDamage:
        ++damages;
        break;
      case Decoder::Event::kError:
        throw tool_error(reader.name(), decoder.error());
      case Decoder::Event::kEnd:
        return facts;
      default:
        break;
    }
  }
}

StreamSummary summarize(const std::string& path, bool bits) {
  StreamSummary summary;
  StreamReader reader(path);
  summary.file = reader.name();
  if (bits && (path == "-" || !reader.size()))
    throw ToolError(ExitStatus::kUsage, "--bits reads the stream twice: no standard input, nothing live");
  const auto read = [&reader](std::uint64_t offset, std::span<std::uint8_t> bytes) {
    return Result<std::size_t>(reader.read_from(offset, bytes));
  };
  Result<StreamSurvey> stream = survey(read, reader.size());
  if (!stream) throw tool_error(reader.name(), stream.error());
  summary.stream = std::move(*stream);
  summary.damages = summary.stream.findings.size();
  const auto is_times = [](const SurveyedData& data) { return data.name == "times"; };
  // What can be read only once has no second look for its times.
  const bool has_times = reader.size() && std::ranges::any_of(summary.stream.data, is_times);
  summary.time = time_base_of(summary.stream.metadata, has_times, path);
  if (bits) summary.decoded = decode_facts(path, summary.damages);
  return summary;
}

/// Names of the predictors that frames of a GOP may have.
std::vector<std::string> predictors_of(const GopInfo& gop) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < gop.predictors.size(); ++i) {
    if (gop.predictors[i]) names.emplace_back(kPredictorNames[i]);
  }
  return names;
}

nlohmann::json to_json(const GopInfo& gop) {
  return {{"first_frame", gop.first_frame},
          {"frame_count", gop.frame_count},
          {"mode", name_of(gop.mode)},
          {"predictors", predictors_of(gop)},
          {"components", gop.components},
          {"fine_bits", gop.fine_bits},
          {"coarse_bits", gop.coarse_bits},
          {"origin", gop.origin},
          {"step", gop.step},
          {"bytes", gop.bytes}};
}

void print_json(const StreamSummary& summary) {
  nlohmann::json json;
  const StreamSurvey& stream = summary.stream;
  json["file"] = summary.file;
  json["version"] = fmt::format("{}.{}", stream.head.major, stream.head.minor);
  const StreamLimits& limits = stream.head.limits;
  json["limits"] = {{"vertices", limits.vertices},
                    {"faces", limits.faces},
                    {"frames_per_gop", limits.frames_per_gop},
                    {"packet_bytes", limits.packet_bytes},
                    {"meshes", limits.meshes},
                    {"mesh_bytes", limits.mesh_bytes},
                    {"plan_bytes", limits.plan_bytes},
                    {"components", limits.components},
                    {"plans", limits.plans},
                    {"decoder_memory", limits.decoder_memory}};
  json["metadata"] = stream.metadata;
  json["time"] = json_of(summary.time);
  json["bytes"] = stream.bytes;
  json["frames"] = stream.frames();
  json["vertices"] = summary.last_mesh().vertices;
  json["faces"] = summary.last_mesh().faces;
  json["meshes"] = stream.meshes.size();
  json["stretches"] = json_of_stretches(stream);
  json["keeps_vertex_order"] = summary.last_mesh().parts.keeps_vertex_order;
  json["levels"] = summary.last_mesh().parts.levels;
  for (const LodInfo& lod : summary.last_mesh().parts.lods) {
    json["lods"].push_back(
        {{"levels", lod.levels}, {"vertices", lod.vertices}, {"faces", lod.faces}, {"bytes", lod.bytes}});
  }
  add_to_json(summary.last_mesh(), summary.animated_bytes(), json);
  json["damages"] = summary.damages;
  for (const auto& [purpose, bytes] : purposes(summary)) json["bytes_by_purpose"][purpose] = bytes;
  json["bits_per_coordinate"] = bits_per_coordinate(stream.bytes, summary.vertex_frames(), 1);
  if (summary.decoded) {
    for (std::size_t i = 0; i < kPredictorNames.size(); ++i)
      json["frames_by_predictor"][kPredictorNames[i]] = summary.decoded->predicted[i];
  }
  for (const ChunkInfo& chunk : stream.chunks) {
    json["chunks"].push_back({{"type", chunk.type}, {"offset", chunk.offset}, {"bytes", chunk.bytes}});
  }
  for (const SurveyedData& data : stream.data) {
    json["data"].push_back({{"name", data.name},
                            {"encoding", name_of(data.encoding)},
                            {"decoded_size", data.decoded_size},
                            {"bytes", data.bytes}});
  }
  for (const SurveyedPlan& plan : stream.plans) {
    json["planes"].push_back({{"first_frame", plan.first_frame},
                              {"frame_count", plan.frame_count},
                              {"components", plan.components},
                              {"part", plan.part},
                              {"bytes", plan.bytes}});
  }
  for (const GopInfo& gop : stream.gops) {
    json["gops"].push_back(to_json(gop));
    if (const auto flagged = summary.flagged(gop)) json["gops"].back()["flagged"] = *flagged;
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_purposes(const StreamSummary& summary) {
  const double coordinates = 3 * static_cast<double>(summary.vertex_frames());
  const auto total = static_cast<double>(summary.stream.bytes);
  std::vector<std::pair<const char*, double>> lines = purposes(summary);
  lines.emplace_back("total", total);
  fmt::print("\nwhere the bytes go\n");
  for (const auto& [purpose, bytes] : lines) {
    std::string name = purpose;
    std::replace(name.begin(), name.end(), '_', ' ');
    fmt::print("  {:<21}{:>12.0f} B {:>7.2f} %{:>10.4f} bits per coordinate\n", name, bytes,
               100 * bytes / total, coordinates > 0 ? 8 * bytes / coordinates : 0.0);
  }
}

void print_gops(const StreamSummary& summary) {
  const StreamSurvey& stream = summary.stream;
  fmt::print("\nGOPs\n  {:>8} {:>7}  {:<8} {:>6} {:>9} {:>12} {:>9}  {}\n", "first", "frames", "mode", "bits",
             "step", "bytes", summary.decoded ? "flagged" : "", "predictors");
  for (std::size_t i = 0; i < stream.gops.size(); ++i) {
    const GopInfo& gop = stream.gops[i];
    const std::string bits = gop.fine_bits == gop.coarse_bits
                                 ? fmt::format("{}", gop.fine_bits)
                                 : fmt::format("{}:{}", gop.fine_bits, gop.coarse_bits);
    std::string flagged;
    if (const auto count = summary.flagged(gop))
      flagged = fmt::format("{:.1f} %", 100.0 * *count / stream.meshes[stream.gop_meshes[i]].vertices);
    fmt::print("  {:>8} {:>7}  {:<8} {:>6} {:>9.4g} {:>12} {:>9}  {}\n", gop.first_frame, gop.frame_count,
               name_of(gop.mode), bits, gop.step, gop.bytes, flagged, fmt::join(predictors_of(gop), ", "));
  }
}

/// Planes that GOPs share: their frames are a basis period.
void print_planes(const StreamSummary& summary) {
  if (summary.stream.plans.empty()) return;
  const bool parts = !summary.last_mesh().parts.lods.empty();
  fmt::print("\nplanes shared by GOPs\n  {:>8} {:>7} {:>11} {:>12}{}\n", "first", "frames", "components",
             "bytes", parts ? "   part" : "");
  for (const SurveyedPlan& plan : summary.stream.plans)
    fmt::print("  {:>8} {:>7} {:>11} {:>12}{}\n", plan.first_frame, plan.frame_count, plan.components,
               plan.bytes, parts ? fmt::format("{:>7}", plan.part) : "");
}

/// Coarser meshes that can be drawn instead.
void print_lods(const MeshInfo& mesh) {
  if (mesh.levels == 0) return;
  fmt::print("\n{} levels of vertices\n", mesh.levels);
  if (mesh.lods.empty()) return;
  fmt::print("  {:>4} {:>8} {:>10} {:>10} {:>12}\n", "lod", "levels", "vertices", "faces", "bytes");
  for (std::size_t i = 0; i < mesh.lods.size(); ++i) {
    const LodInfo& lod = mesh.lods[i];
    fmt::print("  {:>4} {:>8} {:>10} {:>10} {:>12}\n", i + 1, lod.levels, lod.vertices, lod.faces, lod.bytes);
  }
}

/// Free-form data.
void print_data(const StreamSurvey& stream) {
  if (stream.data.empty()) return;
  fmt::print("\ndata\n  {:>12} {:>12}  {:<8} {}\n", "size", "bytes", "encoding", "name");
  for (const SurveyedData& data : stream.data)
    fmt::print("  {:>12} {:>12}  {:<8} {}\n", data.decoded_size, data.bytes, name_of(data.encoding),
               data.name);
}

void print_text(const StreamSummary& summary) {
  const StreamSurvey& stream = summary.stream;
  const SurveyedMesh mesh = summary.last_mesh();
  fmt::print("{}: TVG {}.{}, {}\n", summary.file, stream.head.major, stream.head.minor,
             readable_bytes(stream.bytes));
  fmt::print("  {} frames in {} GOPs, {} vertices, {} faces, vertex order {}\n", stream.frames(),
             stream.gops.size(), mesh.vertices, mesh.faces,
             mesh.parts.keeps_vertex_order ? "kept" : "given up");
  if (stream.meshes.size() > 1)
    fmt::print("  {} meshes, listed below; the counts are those of the last\n", stream.meshes.size());
  fmt::print("  decoding needs at most {} of memory\n", readable_bytes(stream.head.limits.decoder_memory));
  for (const auto& [key, value] : stream.metadata) fmt::print("  {}: {}\n", key, value);
  if (const std::string time = words_for(summary.time); !time.empty()) fmt::print("  time: {}\n", time);
  if (summary.decoded) {
    fmt::print("  frames predicted");
    const char* separator = " by";
    for (std::size_t i = 0; i < kPredictorNames.size(); ++i) {
      if (summary.decoded->predicted[i] == 0) continue;
      fmt::print("{} {}: {}", std::exchange(separator, ","), kPredictorNames[i],
                 summary.decoded->predicted[i]);
    }
    fmt::print("\n");
  }
  if (summary.damages > 0) fmt::print("  DAMAGED in {} places: tvg verify tells more\n", summary.damages);
  print_purposes(summary);
  print_properties(mesh, summary.animated_bytes());
  print_data(stream);
  print_lods(mesh.parts);
  print_planes(summary);
  print_stretches(stream);
  print_gops(summary);
  fmt::print("\nchunks\n");
  for (const ChunkInfo& chunk : stream.chunks) {
    fmt::print("  {} at {:>10}, {:>10} bytes\n", chunk.type, chunk.offset, chunk.bytes);
  }
}

}  // namespace

void add_info_command(CLI::App& tool) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App& command =
      *tool.add_subcommand("info", "Show what a .tvg holds and where its bytes go, or what a scene holds");
  command
      .add_option("input", arguments->input,
                  "the stream (- for standard input; an http or https URL too), a scene or a BVH file")
      ->required();
  command.add_option("--fps", arguments->fps, "count the frames of a scene's clips at this rate")
      ->capture_default_str();
  command.add_flag("--bits", arguments->bits,
                   "decode the stream to tell what x, y and z take and how many vertices are flagged");
  command.add_flag("--json", arguments->json, "print everything as JSON");
  command.callback([arguments] {
    static_cast<void>(parse_rate(arguments->fps));
    if (has_scene_info(arguments->input)) {
      print_scene_info(arguments->input, arguments->fps, arguments->json);
      return;
    }
    const StreamSummary summary = summarize(arguments->input, arguments->bits);
    arguments->json ? print_json(summary) : print_text(summary);
  });
}

}  // namespace tvg::cli
