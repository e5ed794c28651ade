#include "cli/commands.hpp"
#include "cli/scene_info.hpp"
#include "tool/option_values.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include <tvg/metrics.hpp>

namespace tvg::cli {

namespace {

struct InfoArguments {
  std::string input;
  std::string fps = "30";
  bool json = false;
};

/// All that a walk over the stream tells.
struct StreamSummary {
  std::string file;
  StreamHead head;
  Metadata metadata;
  std::vector<ChunkInfo> chunks;
  std::vector<GopInfo> gops;
  std::uint64_t meshes = 0;
  std::uint32_t vertices = 0;  ///< of the last mesh
  std::uint64_t faces = 0;
  bool keeps_vertex_order = true;
  std::uint64_t frames = 0;
  std::uint64_t vertex_frames = 0;  ///< vertices summed over frames
  std::uint64_t bytes = 0;
  std::uint64_t damaged = 0;
  // Bytes by purpose.
  double connectivity = 0, order = 0, flags = 0;
  std::array<double, 3> residuals{};

  double container() const {
    return static_cast<double>(bytes) - connectivity - order - flags - residuals[0] - residuals[1] -
           residuals[2];
  }
};

StreamSummary summarize(const std::string& path) {
  StreamReader reader(path);
  Decoder& decoder = reader.decoder();
  decoder.measure_bits(true);
  StreamSummary summary;
  summary.file = reader.name();
  summary.bytes = 8;
  for (;;) {
    switch (reader.next()) {
      case Decoder::Event::kChunk:
        summary.chunks.push_back(decoder.chunk());
        summary.bytes += decoder.chunk().bytes;
        break;
      case Decoder::Event::kHead:
        summary.head = decoder.head();
        break;
      case Decoder::Event::kMetadata:
        summary.metadata = decoder.metadata();
        break;
      case Decoder::Event::kMesh:
        ++summary.meshes;
        summary.vertices = decoder.mesh().vertex_count;
        summary.faces = decoder.mesh().faces.size();
        summary.keeps_vertex_order = decoder.mesh_info().keeps_vertex_order;
        summary.connectivity += static_cast<double>(decoder.mesh_info().connectivity_bytes);
        summary.order += static_cast<double>(decoder.mesh_info().order_bytes);
        break;
      case Decoder::Event::kGop:
        summary.gops.push_back(decoder.gop());
        summary.flags += static_cast<double>(decoder.gop().flag_bytes);
        break;
      case Decoder::Event::kFrame:
        ++summary.frames;
        summary.vertex_frames += decoder.mesh().vertex_count;
        for (std::size_t axis = 0; axis < 3; ++axis)
          summary.residuals[axis] += decoder.frame_bits()[axis] / 8;
        break;
      case Decoder::Event::kDamage:
        ++summary.damaged;
        break;
      case Decoder::Event::kError:
        throw tool_error(reader.name(), decoder.error());
      case Decoder::Event::kEnd:
        return summary;
      case Decoder::Event::kNeedBytes:
        break;
    }
  }
}

const char* predictor_name(Predictor predictor) {
  constexpr std::array<const char*, 3> kNames = {"space", "time", "elp"};
  return kNames[static_cast<std::size_t>(predictor)];
}

void print_json(const StreamSummary& summary) {
  nlohmann::json json;
  json["file"] = summary.file;
  json["version"] = fmt::format("{}.{}", summary.head.major, summary.head.minor);
  const StreamLimits& limits = summary.head.limits;
  json["limits"] = {{"vertices", limits.vertices},
                    {"faces", limits.faces},
                    {"frames_per_gop", limits.frames_per_gop},
                    {"packet_bytes", limits.packet_bytes},
                    {"decoder_memory", limits.decoder_memory}};
  json["metadata"] = summary.metadata;
  json["bytes"] = summary.bytes;
  json["frames"] = summary.frames;
  json["vertices"] = summary.vertices;
  json["faces"] = summary.faces;
  json["meshes"] = summary.meshes;
  json["keeps_vertex_order"] = summary.keeps_vertex_order;
  json["damages"] = summary.damaged;
  json["bytes_by_purpose"] = {{"connectivity", summary.connectivity},
                              {"order", summary.order},
                              {"flags", summary.flags},
                              {"residuals_x", summary.residuals[0]},
                              {"residuals_y", summary.residuals[1]},
                              {"residuals_z", summary.residuals[2]},
                              {"container", summary.container()}};
  json["bits_per_coordinate"] = bits_per_coordinate(summary.bytes, summary.vertex_frames, 1);
  for (const ChunkInfo& chunk : summary.chunks) {
    json["chunks"].push_back({{"type", chunk.type}, {"offset", chunk.offset}, {"bytes", chunk.bytes}});
  }
  for (const GopInfo& gop : summary.gops) {
    json["gops"].push_back({{"first_frame", gop.first_frame},
                            {"frame_count", gop.frame_count},
                            {"predictor", predictor_name(gop.predictor)},
                            {"fine_bits", gop.fine_bits},
                            {"coarse_bits", gop.coarse_bits},
                            {"origin", gop.origin},
                            {"step", gop.step},
                            {"flagged", gop.flagged},
                            {"bytes", gop.bytes}});
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_purposes(const StreamSummary& summary) {
  const auto line = [&summary](const char* purpose, double bytes) {
    const double coordinates = 3 * static_cast<double>(summary.vertex_frames);
    fmt::print("  {:<14}{:>12.0f} B {:>7.2f} %", purpose, bytes,
               100 * bytes / static_cast<double>(summary.bytes));
    fmt::print("{:>10.4f} bits per coordinate\n", coordinates > 0 ? 8 * bytes / coordinates : 0.0);
  };
  fmt::print("\nwhere the bytes go\n");
  line("connectivity", summary.connectivity);
  line("vertex order", summary.order);
  line("flags", summary.flags);
  line("residuals x", summary.residuals[0]);
  line("residuals y", summary.residuals[1]);
  line("residuals z", summary.residuals[2]);
  line("container", summary.container());
  line("total", static_cast<double>(summary.bytes));
}

void print_text(const StreamSummary& summary) {
  fmt::print("{}: TVG {}.{}, {}\n", summary.file, summary.head.major, summary.head.minor,
             readable_bytes(summary.bytes));
  fmt::print("  {} frames in {} GOPs, {} vertices, {} faces, vertex order {}\n", summary.frames,
             summary.gops.size(), summary.vertices, summary.faces,
             summary.keeps_vertex_order ? "kept" : "given up");
  if (summary.meshes > 1) fmt::print("  {} meshes; the counts are those of the last\n", summary.meshes);
  fmt::print("  decoding needs at most {} of memory\n", readable_bytes(summary.head.limits.decoder_memory));
  for (const auto& [key, value] : summary.metadata) fmt::print("  {}: {}\n", key, value);
  if (summary.damaged > 0) fmt::print("  DAMAGED in {} places: tvg verify tells more\n", summary.damaged);
  print_purposes(summary);

  fmt::print("\nGOPs\n  {:>8} {:>7} {:>10} {:>6} {:>9} {:>9} {:>12}\n", "first", "frames", "predictor",
             "bits", "flagged", "step", "bytes");
  for (const GopInfo& gop : summary.gops) {
    const std::string bits = gop.fine_bits == gop.coarse_bits
                                 ? fmt::format("{}", gop.fine_bits)
                                 : fmt::format("{}:{}", gop.fine_bits, gop.coarse_bits);
    const double share = 100.0 * gop.flagged / std::max(1u, summary.vertices);
    fmt::print("  {:>8} {:>7} {:>10} {:>6} {:>7.1f} % {:>9.4g} {:>12}\n", gop.first_frame, gop.frame_count,
               predictor_name(gop.predictor), bits, share, gop.step, gop.bytes);
  }
  fmt::print("\nchunks\n");
  for (const ChunkInfo& chunk : summary.chunks) {
    fmt::print("  {} at {:>10}, {:>10} bytes\n", chunk.type, chunk.offset, chunk.bytes);
  }
}

}  // namespace

void add_info_command(CLI::App& tool) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App& command =
      *tool.add_subcommand("info", "Show what a .tvg holds and where its bytes go, or what a scene holds");
  command.add_option("input", arguments->input, "the stream (- for standard input), a scene or a BVH file")
      ->required();
  command.add_option("--fps", arguments->fps, "count the frames of a scene's clips at this rate")
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "print everything as JSON");
  command.callback([arguments] {
    if (has_scene_info(arguments->input)) {
      print_scene_info(arguments->input, arguments->fps, arguments->json);
      return;
    }
    const StreamSummary summary = summarize(arguments->input);
    arguments->json ? print_json(summary) : print_text(summary);
  });
}

}  // namespace tvg::cli
