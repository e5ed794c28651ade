#include "encoder/importers/scene_attributes.hpp"
#include "encoder/importers/scene_choice.hpp"
#include "encoder/importers/scene_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>

namespace tvg::cli {

namespace {

/// As many for each vertex that may be read as positions, joints and weights of a glTF have.
constexpr std::uint64_t kNumbersPerVertex = 16;

/// On attributes, of different meshes.
constexpr std::size_t kMostNotes = 8;

class Gatherer {
 public:
  Gatherer(const SceneReader& reader, const Clip& clip, std::vector<char> chosen, bool with_properties)
      : reader_(reader),
        scene_(reader.scene()),
        clip_(clip),
        chosen_(std::move(chosen)),
        with_properties_(with_properties),
        attributes_(kNumbersPerVertex * scene_.most_vertices) {
    result_.influence_begin = {0};
    result_.morph_begin = {0};
    std::vector<Transform> local;
    clip.pose(clip.first, scene_.nodes.rest_pose(), local);
    scene_.nodes.to_scene_space(local, global_);
  }

  SceneMesh gather(std::vector<std::string>& notes) {
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      if (chosen_[i] == 0) continue;
      const SceneInstance& instance = scene_.instances[i];
      if (instance.skin && !skinned_.emplace(instance.mesh, *instance.skin).second) continue;
      if (!parts_.contains(instance.mesh))
        parts_.emplace(instance.mesh, reader_.read_mesh(instance.mesh, with_properties_));
      for (const ScenePart& part : parts_.at(instance.mesh)) take(instance, part);
    }
    if (result_.mesh.faces.empty()) {
      scene_.fail(scene_.mesh_names.empty() ? "it holds no mesh to encode"
                                            : "its meshes have no faces to encode");
    }
    result_.mesh.vertex_count = static_cast<std::uint32_t>(result_.positions.size());
    finish_properties(notes);
    return std::move(result_);
  }

 private:
  void take(const SceneInstance& instance, const ScenePart& part) {
    result_.left_out += part.left_out;
    if (part.faces.empty()) return;
    const std::size_t first = result_.positions.size();
    const auto fits = [this](std::size_t more, std::size_t present) {
      return present <= scene_.most_vertices && more <= scene_.most_vertices - present;
    };
    if (!fits(part.positions.size(), first) || !fits(part.faces.size(), result_.mesh.faces.size())) {
      scene_.fail(
          fmt::format("its meshes have more than {} vertices or faces as its nodes hold them, the most "
                      "that are read of a file of its size",
                      scene_.most_vertices));
    }
    ++result_.parts;
    take_properties(instance, part);
    take_faces(instance, part, first);
    take_positions(instance, part);
    take_influences(instance, part);
  }

  /// Before the faces are taken.
  void take_properties(const SceneInstance& instance, const ScenePart& part) {
    for (const std::string& note : part.notes) notes_.insert(note);
    if (!with_properties_) return;
    if (!attributes_.take(part.positions.size(), part.attributes)) {
      scene_.fail("the attributes of its meshes are more than is read of a file of its size");
    }
    MeshProperties& properties = result_.properties;
    for (Polygon polygon : part.polygons) {
      polygon.first_triangle += result_.mesh.faces.size();
      properties.polygons.push_back(polygon);
    }
    Part names = part.names.value_or(Part{plain_name(scene_.nodes.list()[instance.node].name),
                                          plain_name(scene_.mesh_names[instance.mesh]), ""});
    if (part.material) names.material = scene_.material_names[*part.material];
    const auto key = std::tuple(names.object, names.group, names.material, part.values);
    const auto [entry, is_new] = part_of_.emplace(key, static_cast<std::uint32_t>(properties.parts.size()));
    if (is_new) {
      properties.parts.push_back(std::move(names));
      values_of_parts_.push_back(part.values);
    }
    properties.face_parts.insert(properties.face_parts.end(), part.faces.size(), entry->second);
  }

  void finish_properties(std::vector<std::string>& notes) {
    MeshProperties& properties = result_.properties;
    properties.attributes = attributes_.finish();
    finish_values_of_parts();
    // What has no name, material and value is not worth a part.
    if (properties.parts.size() == 1 && properties.parts[0] == Part{} && values_of_parts_[0].empty()) {
      properties.parts.clear();
      properties.face_parts.clear();
    }
    if (attributes_.left_out() > 0) {
      notes.push_back(fmt::format("{}: it has more than {} attributes, of which {} are taken", scene_.path,
                                  kMaxAttributes, kMaxAttributes));
    }
    std::size_t told = 0;
    for (const std::string& note : notes_) {
      if (++told > kMostNotes) continue;
      notes.push_back(note.starts_with(scene_.path) ? note : fmt::format("{}: {}", scene_.path, note));
    }
    if (told > kMostNotes)
      notes.push_back(fmt::format("{}: {} more notes on attributes", scene_.path, told - kMostNotes));
  }

  /// The numbers of parts as attributes, 0 for a part that has none.
  void finish_values_of_parts() {
    std::map<std::string, std::size_t> widths;
    for (const auto& values : values_of_parts_) {
      for (const auto& [name, numbers] : values) widths[name] = std::max(widths[name], numbers.size());
    }
    for (const auto& [name, width] : widths) {
      if (result_.properties.attributes.size() == kMaxAttributes) return;
      Attribute attribute = empty_attribute(name, AttributeKind::kGeneric, static_cast<std::uint32_t>(width));
      attribute.domain = AttributeDomain::kPart;
      attribute.bits = Attribute::kExact;
      for (const auto& values : values_of_parts_) {
        const auto found = values.find(name);
        for (std::size_t i = 0; i < width; ++i) {
          const bool has = found != values.end() && i < found->second.size();
          attribute.values.push_back(has ? found->second[i] : 0.0F);
        }
      }
      result_.properties.attributes.push_back(std::move(attribute));
    }
  }

  /// Turns faces to look the other way. The fan of a polygon then begins with its last triangle.
  void turn(const ScenePart& part, std::size_t first_face) {
    const auto begin = result_.mesh.faces.begin() + static_cast<std::ptrdiff_t>(first_face);
    std::for_each(begin, result_.mesh.faces.end(), [](Face& face) { std::swap(face[1], face[2]); });
    for (const Polygon& polygon : part.polygons) {
      const auto fan = begin + static_cast<std::ptrdiff_t>(polygon.first_triangle);
      std::reverse(fan, fan + polygon.corners - 2);
    }
  }

  void take_faces(const SceneInstance& instance, const ScenePart& part, std::size_t first) {
    const std::size_t first_face = result_.mesh.faces.size();
    const bool mirrored =
        !instance.skin && (global_[instance.node] * instance.placed).linear().determinant() < 0;
    for (std::size_t i = 0; i < part.faces.size(); ++i) {
      Face face = part.faces[i];
      for (std::uint32_t& corner : face) {
        if (corner >= part.positions.size()) {
          scene_.fail(fmt::format("mesh \"{}\", face {} names vertex {} of {}",
                                  scene_.mesh_names[instance.mesh], i, corner, part.positions.size()));
        }
        corner += static_cast<std::uint32_t>(first);
      }
      result_.mesh.faces.push_back(face);
    }
    if (mirrored) turn(part, first_face);
  }

  /// The slots of the channel that moves the instance's morph targets; nothing where none does.
  const MorphSlots* slots_of(const SceneInstance& instance) {
    const auto names = [](const std::vector<std::size_t>& numbers, std::size_t wanted) {
      return std::find(numbers.begin(), numbers.end(), wanted) != numbers.end();
    };
    for (std::size_t channel = 0; channel < clip_.morphs.size(); ++channel) {
      const MorphChannel& moves = clip_.morphs[channel];
      if (!names(moves.nodes, instance.node) && !names(moves.meshes, instance.mesh)) continue;
      for (const MorphSlots& slots : result_.slots) {
        if (slots.channel == channel) return &slots;
      }
      const std::size_t count = moves.weights.width;
      result_.slots.push_back({channel, result_.slot_count, count});
      result_.slot_count += count;
      return &result_.slots.back();
    }
    return nullptr;
  }

  void take_positions(const SceneInstance& instance, const ScenePart& part) {
    const MorphSlots* slots = part.targets.empty() ? nullptr : slots_of(instance);
    std::vector<Eigen::Vector3d> positions = part.positions;
    std::vector<std::vector<MorphDelta>> morphs(slots == nullptr ? 0 : positions.size());
    for (std::size_t target = 0; target < part.targets.size(); ++target) {
      const double weight = target < instance.weights.size() ? instance.weights[target] : 0;
      for (const VertexShift& shift : part.targets[target]) {
        if (!shift.delta.allFinite())
          fail_vertex(instance, shift.vertex, "a morph target that is NaN or infinite");
        if (slots == nullptr) {
          positions[shift.vertex] += weight * shift.delta;
        } else if (target < slots->count) {
          morphs[shift.vertex].push_back({static_cast<std::uint32_t>(slots->first + target), shift.delta});
        }
      }
    }
    for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
      if (!positions[vertex].allFinite())
        fail_vertex(instance, vertex, "a coordinate that is NaN or infinite");
      result_.positions.push_back(positions[vertex]);
      if (slots != nullptr) {
        result_.morphs.insert(result_.morphs.end(), morphs[vertex].begin(), morphs[vertex].end());
      }
      result_.morph_begin.push_back(result_.morphs.size());
    }
  }

  /// One carrier for each node and offset, so that seams between materials can be joined.
  std::uint32_t carrier(std::size_t node, const Transform& offset, bool is_bone) {
    std::vector<double> key = {static_cast<double>(node), is_bone ? 1.0 : 0.0};
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 4; ++column) key.push_back(offset.matrix()(row, column));
    }
    const auto [entry, is_new] =
        carriers_.emplace(std::move(key), static_cast<std::uint32_t>(result_.carriers.size()));
    if (is_new) result_.carriers.push_back({node, offset, is_bone});
    return entry->second;
  }

  /// [joint]
  const std::vector<std::uint32_t>& carriers_of(const SceneInstance& instance, std::size_t skin_index) {
    const auto [entry, is_new] = of_skin_.try_emplace(skin_index);
    if (!is_new) return entry->second;
    const SceneSkin& skin = scene_.skins[skin_index];
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
      if (!skin.offsets[joint].matrix().allFinite()) {
        scene_.fail(fmt::format("mesh \"{}\": the offset of bone \"{}\" is not finite",
                                scene_.mesh_names[instance.mesh],
                                scene_.nodes.list()[skin.joints[joint]].name));
      }
      entry->second.push_back(carrier(skin.joints[joint], skin.offsets[joint], true));
    }
    return entry->second;
  }

  void take_influences(const SceneInstance& instance, const ScenePart& part) {
    static const std::vector<std::uint32_t> kNone;
    const std::vector<std::uint32_t>& carriers =
        instance.skin ? carriers_of(instance, *instance.skin) : kNone;
    std::vector<Influence> influences;
    for (std::size_t vertex = 0; vertex < part.positions.size(); ++vertex) {
      influences.clear();
      if (instance.skin && !part.weights.empty()) {
        for (const JointWeight& weight : part.weights[vertex]) {
          if (!std::isfinite(weight.weight))
            fail_vertex(instance, vertex, "a weight that is NaN or infinite");
          if (!(weight.weight > 0)) continue;
          if (weight.joint >= carriers.size()) {
            fail_vertex(
                instance, vertex,
                fmt::format("a weight of joint {}, and its skin has {}", weight.joint, carriers.size()));
          }
          influences.push_back({carriers[weight.joint], weight.weight});
        }
      }
      normalize(influences);
      if (influences.empty()) influences.push_back({carrier(instance.node, instance.placed, false), 1});
      result_.influences.insert(result_.influences.end(), influences.begin(), influences.end());
      result_.influence_begin.push_back(result_.influences.size());
    }
  }

  /// In order of carrier, each once, summing to 1; empty where the weights are too small to tell.
  static void normalize(std::vector<Influence>& influences) {
    std::stable_sort(influences.begin(), influences.end(),
                     [](const Influence& a, const Influence& b) { return a.carrier < b.carrier; });
    std::size_t kept = 0;
    double sum = 0;
    for (const Influence& influence : influences) {
      sum += influence.weight;
      if (kept > 0 && influences[kept - 1].carrier == influence.carrier) {
        influences[kept - 1].weight += influence.weight;
      } else {
        influences[kept++] = influence;
      }
    }
    influences.resize(sum > 1e-12 ? kept : 0);
    for (Influence& influence : influences) influence.weight /= sum;
  }

  [[noreturn]] void fail_vertex(const SceneInstance& instance, std::size_t vertex,
                                const std::string& what) const {
    scene_.fail(fmt::format("mesh \"{}\", vertex {} has {}", scene_.mesh_names[instance.mesh], vertex, what));
  }

  const SceneReader& reader_;
  const Scene& scene_;
  const Clip& clip_;
  std::vector<char> chosen_;  // [instance]
  bool with_properties_;
  std::vector<Transform> global_;  // [node], where the clip begins
  SceneMesh result_;
  AttributeGatherer attributes_;
  using PartValues = std::map<std::string, std::vector<float>>;
  std::map<std::tuple<std::string, std::string, std::string, PartValues>, std::uint32_t> part_of_;
  std::vector<PartValues> values_of_parts_;  // [part]
  std::set<std::string> notes_;
  std::map<std::size_t, std::vector<ScenePart>> parts_;        // by mesh
  std::set<std::pair<std::size_t, std::size_t>> skinned_;      // mesh and skin of those that have been taken
  std::map<std::vector<double>, std::uint32_t> carriers_;      // by node and offset
  std::map<std::size_t, std::vector<std::uint32_t>> of_skin_;  // carriers, by skin
};

}  // namespace

SceneMesh gather_meshes(const SceneReader& reader, const Clip& clip, const std::vector<std::string>& wanted,
                        bool with_properties, std::vector<std::string>& notes) {
  return Gatherer(reader, clip, choose_instances(reader.scene(), wanted, notes), with_properties)
      .gather(notes);
}

}  // namespace tvg::cli
