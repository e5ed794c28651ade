#include "decoder/exporters/gltf_sink.hpp"

#include "decoder/exporters/bytes.hpp"
#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <limits>

namespace tvg::cli {

using nlohmann::json;

namespace {

constexpr const char* kGenerator = "TVG";
/// What players of glTF suppose, and the importer here takes, where a stream has no rate.
constexpr double kDefaultRate = 30;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// A buffer that lies beside another program's file is not ours to replace.
void refuse_foreign_buffer(const std::string& gltf, const std::string& buffer) {
  std::error_code ignored;
  if (!std::filesystem::exists(buffer, ignored)) return;
  std::ifstream file(gltf, std::ios::binary);
  const json existing = json::parse(file, nullptr, false);
  if (text_of(member(existing, "asset"), "generator") == kGenerator) return;
  throw ToolError(
      ExitStatus::kUsage,
      fmt::format("{} would get the buffer of {}, but it exists and another program wrote it: give "
                  "another name for the output, or a .glb, which needs no file beside it",
                  buffer, gltf));
}

/// How many metres a unit of the metadata is.
double metres_of(const Metadata& metadata) {
  static const std::map<std::string, double> units_known = {{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                                                            {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048},
                                                            {"dm", 0.1},  {"um", 1e-6},   {"yd", 0.9144}};
  const auto entry = metadata.find("units");
  if (entry == metadata.end()) return 1;
  const auto unit = units_known.find(entry->second);
  return unit == units_known.end() ? 1 : unit->second;
}

bool is_z_up(const Metadata& metadata) {
  const auto up = metadata.find("up");
  return up != metadata.end() && (up->second == "z" || up->second == "Z");
}

}  // namespace

std::string buffer_beside(const std::string& gltf) {
  return std::filesystem::path(gltf).replace_extension(".bin").string();
}

GltfSink::GltfSink(const std::string& path, const SinkOptions& options)
    : path_(path),
      options_(options),
      is_binary_(has_suffix(path, ".glb")),
      file_(is_binary_ ? path : buffer_beside(path)),
      document_({{"asset", {{"version", "2.0"}, {"generator", kGenerator}}}}),
      buffer_(file_, document_) {
  for (const char* list : {"accessors", "bufferViews", "meshes", "nodes"}) document_[list] = json::array();
  if (!is_binary_) {
    refuse_foreign_buffer(path, file_.path());
    text_ = std::make_unique<AtomicFile>(path);
  }
  if (!file_.seekable()) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{} is no plain file, and glTF begins with what is known last", file_.path()));
  }
}

GltfSink::~GltfSink() = default;

void GltfSink::add_data(const NamedData& data) {
  materials_.add_data(data);
  times_.add_data(data);
  if (data.name == "extras") extras_ = parse_json(data.bytes).value_or(json());
  if (data.name == "skeleton") losses_.add("the skeleton (frames are morph targets)");
}

void GltfSink::begin_mesh(const Mesh& mesh, const MeshProperties& properties, const Metadata& metadata,
                          std::optional<std::uint64_t> /*frame_count*/) {
  end_stretch();
  metadata_ = metadata;
  losses_.add(HeldBy::kGltf, mesh, properties);
  std::unique_ptr<AtomicFile> scratch;
  if (options_.gltf_quantized) scratch = std::make_unique<AtomicFile>(path_ + ".positions");
  stretch_ = std::make_unique<GltfStretch>(mesh, properties, frames_, std::move(scratch));
}

void GltfSink::write_frame(std::span<const float> positions, AnimatedValues animated) {
  stretch_->add_frame(positions, animated, buffer_);
  ++frames_;
}

void GltfSink::end_stretch() {
  if (!stretch_) return;
  const GltfPlacedMesh placed = stretch_->finish(document_, buffer_, materials_);
  if (placed.mesh) {
    texcoord_sets_ = std::min(texcoord_sets_.value_or(stretch_->texcoord_sets()), stretch_->texcoord_sets());
  }
  if (placed.frames > 0) placed_.push_back(placed);
  stretch_.reset();
}

double GltfSink::time_of(std::uint64_t frame) const {
  return times_.of(frame) - std::min(0.0, times_.of(0));  // glTF has no time before 0
}

std::size_t GltfSink::write_times(const std::vector<double>& times) {
  std::vector<float> seconds;
  seconds.reserve(times.size());
  for (const double time : times) seconds.push_back(static_cast<float>(time));
  buffer_.begin_view(GltfTarget::kNone);
  const std::size_t accessor = buffer_.add_accessor(
      {GltfComponent::kFloat, "SCALAR", seconds.size(), false, {seconds.front()}, {seconds.back()}});
  buffer_.write(std::span<const float>(seconds));
  buffer_.end_view();
  return accessor;
}

namespace {

void add_channel(json& animation, std::size_t node, const char* path, json sampler) {
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back(std::move(sampler));
}

}  // namespace

/// The mesh is there from its first frame to before the next mesh's.
void GltfSink::add_sizes(json& animation, std::size_t node, const GltfPlacedMesh& placed, bool is_last) {
  std::vector<double> times;
  std::vector<float> sizes;
  const auto add_key = [&](std::uint64_t frame, float size) {
    times.push_back(time_of(frame));
    sizes.insert(sizes.end(), 3, size);
  };
  if (placed.first_frame > 0) add_key(0, 0);
  add_key(placed.first_frame, 1);
  if (!is_last) add_key(placed.first_frame + placed.frames, 0);
  const std::size_t input = write_times(times);
  buffer_.begin_view(GltfTarget::kNone);
  const std::size_t output =
      buffer_.add_accessor({GltfComponent::kFloat, "VEC3", times.size(), false, {}, {}});
  buffer_.write(std::span<const float>(sizes));
  buffer_.end_view();
  add_channel(animation, node, "scale", {{"input", input}, {"output", output}, {"interpolation", "STEP"}});
}

/// Each frame has its own target at weight 1 and all others at 0.
void GltfSink::add_weights(json& animation, std::size_t node, const GltfPlacedMesh& placed) {
  std::vector<double> times;
  times.reserve(placed.frames);
  for (std::uint64_t i = 0; i < placed.frames; ++i) times.push_back(time_of(placed.first_frame + i));
  const std::size_t input = write_times(times);
  const std::uint64_t targets = placed.frames - 1;
  buffer_.begin_view(GltfTarget::kNone);
  const std::size_t output =
      buffer_.add_accessor({GltfComponent::kFloat, "SCALAR", placed.frames * targets, false, {}, {}});
  std::vector<float> weights(targets, 0);
  for (std::uint64_t frame = 0; frame < placed.frames; ++frame) {
    if (frame > 0) weights[frame - 1] = 1;
    buffer_.write(std::span<const float>(weights));
    if (frame > 0) weights[frame - 1] = 0;
  }
  buffer_.end_view();
  add_channel(
      animation, node, "weights",
      {{"input", input}, {"output", output}, {"interpolation", options_.gltf_steps ? "STEP" : "LINEAR"}});
}

/// What stands above all meshes where coordinates are not as glTF has them: metres, y up, around 0.
json GltfSink::root_node() const {
  json root = json::object();
  const Origin origin = origin_of(metadata_).value_or(Origin{});
  const double scale = metres_of(metadata_);
  std::array<double, 3> moved = {origin[0] * scale, origin[1] * scale, origin[2] * scale};
  if (is_z_up(metadata_)) {
    moved = {moved[0], moved[2], -moved[1]};
    root["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  }
  if (scale != 1) root["scale"] = {scale, scale, scale};
  if (moved != std::array<double, 3>{}) root["translation"] = moved;
  return root;
}

void GltfSink::write_nodes() {
  json& nodes = document_["nodes"];
  json animation = {{"name", "frames"}, {"channels", json::array()}, {"samplers", json::array()}};
  json tops = json::array();
  const auto name = metadata_.find("name");
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const GltfPlacedMesh& placed = placed_[i];
    if (!placed.mesh) continue;
    json node = {{"mesh", *placed.mesh}};
    std::string called = name == metadata_.end() ? "mesh" : name->second;
    if (placed_.size() > 1) called += fmt::format(" {}", i);
    node["name"] = called;
    document_["meshes"][*placed.mesh]["name"] = called;
    if (options_.gltf_quantized) {
      node["translation"] = placed.translation;
      node["scale"] = {placed.scale, placed.scale, placed.scale};
    }
    std::size_t top = nodes.size();
    nodes.push_back(std::move(node));
    if (placed.frames > 1) add_weights(animation, top, placed);
    if (placed_.size() > 1) {
      json shown = {{"name", called + " shown"}, {"children", {top}}};
      if (i > 0) shown["scale"] = {0, 0, 0};
      top = nodes.size();
      nodes.push_back(std::move(shown));
      add_sizes(animation, top, placed, i + 1 == placed_.size());
    }
    tops.push_back(top);
  }
  if (json root = root_node(); !root.empty() && !tops.empty()) {
    root["children"] = std::move(tops);
    tops = json::array({nodes.size()});
    nodes.push_back(std::move(root));
  }
  json scene = json::object();
  if (!tops.empty()) scene["nodes"] = std::move(tops);
  document_["scenes"] = json::array({std::move(scene)});
  document_["scene"] = 0;
  if (!animation["channels"].empty()) document_["animations"] = json::array({std::move(animation)});
}

/// What is known once everything is written; empty lists are not valid. What comes back to the importer alone
/// is among the extras of `asset`.
void GltfSink::complete_document() {
  if (extras_.is_object()) {
    if (const auto scene = extras_.find("scene"); scene != extras_.end()) {
      document_["scenes"][0]["extras"] = *scene;
      extras_.erase(scene);
    }
    if (!extras_.empty()) document_["extras"] = extras_;
  }
  if (!metadata_.empty()) document_["asset"]["extras"]["metadata"] = metadata_;
  std::set<std::string> used = materials_.extensions();
  if (options_.gltf_quantized) {
    used.insert("KHR_mesh_quantization");
    document_["extensionsRequired"] = json::array({"KHR_mesh_quantization"});
  }
  if (!used.empty()) document_["extensionsUsed"] = used;
  for (const char* list :
       {"accessors", "bufferViews", "meshes", "nodes", "materials", "textures", "images", "samplers"}) {
    if (document_[list].empty()) document_.erase(list);
  }
  if (buffer_.size() > 0) document_["buffers"] = json::array({{{"byteLength", buffer_.size()}}});
}

void GltfSink::finish() {
  end_stretch();
  if (frames_ == 0) throw ToolError(ExitStatus::kInvalidInput, "there are no frames to write");
  times_.set_rate(metadata_, kDefaultRate);
  write_nodes();
  materials_.write(document_, buffer_, texcoord_sets_.value_or(0));
  complete_document();
  is_binary_ ? write_glb() : write_text();
}

void GltfSink::write_glb() {
  constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;
  static constexpr std::array<char, 4> kZeros{};
  const std::uint64_t used = file_.size();
  file_.write(kZeros.data(), (4 - used % 4) % 4);
  const std::uint64_t buffer = file_.size();
  std::string text = document_.dump(-1, ' ', false, json::error_handler_t::replace);
  text.append((4 - text.size() % 4) % 4, ' ');
  const std::uint64_t before = kFileHeader + kChunkHeader + text.size() + (buffer > 0 ? kChunkHeader : 0);
  if (before + buffer > std::numeric_limits<std::uint32_t>::max()) {
    throw ToolError(
        ExitStatus::kUsage,
        fmt::format("{} would be larger than the 4 GiB that a .glb can be: write a .gltf, or fewer "
                    "frames (--frames)",
                    path_));
  }
  std::string header(kFileHeader + kChunkHeader, '\0');
  store32(header.data(), std::uint32_t{0x46546C67}, false);
  store32(header.data() + 4, std::uint32_t{2}, false);
  store32(header.data() + 8, static_cast<std::uint32_t>(before + buffer), false);
  store32(header.data() + 12, static_cast<std::uint32_t>(text.size()), false);
  store32(header.data() + 16, kJsonChunk, false);
  header += text;
  if (buffer > 0) {
    header.resize(before);
    store32(header.data() + before - 8, static_cast<std::uint32_t>(buffer), false);
    store32(header.data() + before - 4, kBinaryChunk, false);
    file_.move_tail(0, before);
    file_.overwrite(0, header.data(), header.size());
  } else {
    file_.write(header);
  }
  file_.finish();
  files_.push_back(path_);
}

void GltfSink::write_text() {
  if (buffer_.size() > 0)
    document_["buffers"][0]["uri"] = std::filesystem::path(file_.path()).filename().string();
  text_->write(document_.dump(1, ' ', false, json::error_handler_t::replace));
  if (buffer_.size() > 0) {
    file_.finish();
    files_.push_back(file_.path());
  }
  text_->finish();
  files_.insert(files_.begin(), path_);
}

std::vector<std::string> GltfSink::notes() const {
  std::vector<std::string> notes;
  if (placed_.size() > 1) {
    notes.push_back(fmt::format(
        "the mesh changes: glTF has {} of them, each shown in its time by its node's scale", placed_.size()));
  }
  for (const std::string& note : losses_.notes("glTF")) notes.push_back(note);
  for (const std::string& note : materials_.notes()) notes.push_back(note);
  return notes;
}

}  // namespace tvg::cli
