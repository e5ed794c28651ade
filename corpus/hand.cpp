#include "corpus/catmull_clark.hpp"
#include "corpus/corpus.hpp"
#include "corpus/exact_math.hpp"
#include "corpus/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

// The hand: a cage of 98 quads (palm, five fingers of three sections), subdivided, then skinned. Units: cm.
namespace tvg::corpus {
namespace {

constexpr std::size_t kFingers = 5;
constexpr std::size_t kJointsPerFinger = 4;  // three that bend, and the tip
constexpr std::uint32_t kPalmColumns = 4;
constexpr std::uint32_t kPalmRows = 3;

/// Where the joints of a finger lie along it, as shares of its length.
constexpr std::array<double, kJointsPerFinger> kJointAt = {0.06, 0.45, 0.73, 0.95};
/// Where the cage's rings lie.
constexpr std::array<double, 3> kRingAt = {0.45, 0.73, 1.0};

struct Finger {
  const char* name;
  Vec3 base;         ///< centre of the palm's quad it grows from
  Vec3 direction;    ///< unit
  Vec3 across;       ///< unit: the axis it bends about
  double length;     ///< of the cage
  double thickness;  ///< half of the cage's width
  double phase;      ///< turns by which its curl comes later
};

std::array<Finger, kFingers> hand_fingers() {
  const auto finger = [](const char* name, const Vec3& base, double lean, double length, double thickness,
                         double phase) {
    const Vec3 direction{sine(lean), cosine(lean), 0};
    return Finger{name, base, direction, {direction.y, -direction.x, 0}, length, thickness, phase};
  };
  return {finger("thumb", {-3.9, 4.2, 0.2}, -0.13, 6.4, 1.15, 0.62),
          finger("index", {-3.1, 9.0, 0}, -0.025, 7.6, 1.0, 0.36),
          finger("middle", {-1.05, 9.4, 0}, -0.006, 8.4, 1.02, 0.24),
          finger("ring", {1.05, 9.2, 0}, 0.012, 7.8, 0.98, 0.12),
          finger("little", {3.05, 8.6, 0}, 0.034, 6.2, 0.88, 0.0)};
}

std::uint32_t palm_vertex(std::uint32_t front, std::uint32_t row, std::uint32_t column) {
  return (front * (kPalmRows + 1) + row) * (kPalmColumns + 1) + column;
}

/// Grows a finger out of the quad `base`, whose last section's end becomes the cap. `corner_signs` are the
/// quad's corners in the finger's own frame: [corner]{across, front}.
void extrude_finger(Cage& cage, const Finger& finger, std::size_t channel, std::array<std::uint32_t, 4> base,
                    const std::array<std::array<double, 2>, 4>& corner_signs) {
  for (const double ring_at : kRingAt) {
    const double taper = 1.08 - 0.22 * ring_at;
    const Vec3 centre = finger.base + ring_at * finger.length * finger.direction;
    std::array<std::uint32_t, 4> next{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 p = centre + corner_signs[k][0] * finger.thickness * taper * finger.across;
      CageVertex vertex{p.x, p.y, p.z + corner_signs[k][1] * finger.thickness * taper};
      vertex[3 + channel] = 1;
      next[k] = static_cast<std::uint32_t>(cage.vertices.size());
      cage.vertices.push_back(vertex);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      cage.quads.push_back({base[k], base[(k + 1) % 4], next[(k + 1) % 4], next[k]});
    }
    base = next;
  }
  cage.quads.push_back(base);
}

Cage make_cage(const std::array<Finger, kFingers>& fingers) {
  Cage cage;
  constexpr std::array<double, kPalmRows + 1> kRowY = {-2.5, 2.6, 5.8, 9.1};
  constexpr std::array<double, kPalmRows + 1> kRowHalfWidth = {2.9, 3.9, 4.3, 4.15};
  constexpr std::array<double, kPalmRows + 1> kRowHalfDepth = {1.6, 1.75, 1.5, 1.2};
  for (const double side : {-1.0, 1.0}) {
    for (std::size_t row = 0; row <= kPalmRows; ++row) {
      for (std::uint32_t column = 0; column <= kPalmColumns; ++column) {
        const double x = kRowHalfWidth[row] * (2.0 * column / kPalmColumns - 1);
        const double knuckle_arch = row == kPalmRows ? 0.5 - 0.06 * (x - 0.4) * (x - 0.4) : 0;
        cage.vertices.push_back({x, kRowY[row] + knuckle_arch, side * kRowHalfDepth[row]});
      }
    }
  }
  const auto front = [](std::uint32_t row, std::uint32_t column) { return palm_vertex(1, row, column); };
  const auto back = [](std::uint32_t row, std::uint32_t column) { return palm_vertex(0, row, column); };
  constexpr std::uint32_t kTop = kPalmRows;
  constexpr std::uint32_t kRight = kPalmColumns;
  for (std::uint32_t r = 0; r < kPalmRows; ++r) {
    for (std::uint32_t c = 0; c < kPalmColumns; ++c) {
      cage.quads.push_back({front(r, c), front(r, c + 1), front(r + 1, c + 1), front(r + 1, c)});
      cage.quads.push_back({back(r, c), back(r + 1, c), back(r + 1, c + 1), back(r, c + 1)});
    }
    cage.quads.push_back({front(r, kRight), back(r, kRight), back(r + 1, kRight), front(r + 1, kRight)});
    const std::array<std::uint32_t, 4> left = {back(r, 0), front(r, 0), front(r + 1, 0), back(r + 1, 0)};
    if (r == 1) {
      extrude_finger(cage, fingers[0], 0, left, {{{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}});
    } else {
      cage.quads.push_back(left);
    }
  }
  for (std::uint32_t c = 0; c < kPalmColumns; ++c) {
    cage.quads.push_back({back(0, c), back(0, c + 1), front(0, c + 1), front(0, c)});
    extrude_finger(cage, fingers[c + 1], c + 1,
                   {front(kTop, c), front(kTop, c + 1), back(kTop, c + 1), back(kTop, c)},
                   {{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}});
  }
  return cage;
}

Vec3 joint_rest(const Finger& finger, std::size_t joint) {
  return finger.base + kJointAt[joint] * finger.length * finger.direction;
}

/// A vertex at rest and the share of each pose in its motion.
struct SkinnedVertex {
  Vec3 rest;
  std::array<double, 1 + kFingers * 3> weights{};  ///< palm, then three per finger; they sum to 1
};

SkinnedVertex skin(const CageVertex& vertex, const std::array<Finger, kFingers>& fingers) {
  SkinnedVertex skinned;
  skinned.rest = {vertex[0], vertex[1], vertex[2]};
  skinned.weights[0] = 1;
  for (std::size_t f = 0; f < kFingers; ++f) {
    // The channel falls off over the web between fingers; it reaches this share just beyond the knuckle.
    const double share = smooth_step(vertex[3 + f] / 0.35);
    const double along = dot(skinned.rest - fingers[f].base, fingers[f].direction) / fingers[f].length;
    const double second = smooth_step((along - kJointAt[1]) / 0.2 + 0.5);
    const double third = smooth_step((along - kJointAt[2]) / 0.18 + 0.5);
    skinned.weights[0] -= share;
    skinned.weights[1 + f * 3] = share * (1 - second);
    skinned.weights[2 + f * 3] = share * second * (1 - third);
    skinned.weights[3 + f * 3] = share * second * third;
  }
  return skinned;
}

/// The poses of palm and finger joints at a time, in the order of SkinnedVertex::weights.
std::array<Pose, 1 + kFingers * 3> hand_poses(const std::array<Finger, kFingers>& fingers, double seconds) {
  std::array<Pose, 1 + kFingers * 3> poses;
  const Vec3 wrist{0, -2, 0};
  const Pose wave = rotation_about(wrist, {0, 0, 1}, 0.045 * sine(0.7 * seconds));
  const Pose nod = rotation_about(wrist, {1, 0, 0}, 0.03 * sine(0.4 * seconds + 0.1));
  poses[0] =
      translation_by({1.5 * sine(0.35 * seconds), 0.6 * sine(0.7 * seconds), 0}).after(wave.after(nod));
  for (std::size_t f = 0; f < kFingers; ++f) {
    const Finger& finger = fingers[f];
    const double curl = 0.5 - 0.5 * cosine(0.55 * seconds - finger.phase * 0.5);
    const double reach = f == 0 ? 0.5 : 1.0;
    const std::array<double, 3> bend = {0.15 * reach * curl, 0.2 * reach * curl, 0.12 * reach * curl};
    const double spread = 0.012 * (static_cast<double>(f) - 2.5) * sine(0.45 * seconds);
    Pose pose = poses[0].after(rotation_about(joint_rest(finger, 0), {0, 0, 1}, -spread));
    for (std::size_t j = 0; j < 3; ++j) {
      pose = pose.after(rotation_about(joint_rest(finger, j), finger.across, bend[j]));
      poses[1 + f * 3 + j] = pose;
    }
  }
  return poses;
}

std::vector<float> joint_positions(const std::array<Finger, kFingers>& fingers,
                                   const std::array<Pose, 1 + kFingers * 3>& poses) {
  std::vector<Vec3> joints = {poses[0].apply({0, -2, 0})};
  for (std::size_t f = 0; f < kFingers; ++f) {
    for (std::size_t j = 0; j < kJointsPerFinger; ++j) {
      joints.push_back(poses[1 + f * 3 + std::min<std::size_t>(j, 2)].apply(joint_rest(fingers[f], j)));
    }
  }
  return to_frame(joints);
}

Skeleton hand_skeleton(const std::array<Finger, kFingers>& fingers) {
  Skeleton skeleton;
  skeleton.joint_names = {"palm"};
  skeleton.parents = {-1};
  for (const Finger& finger : fingers) {
    for (std::size_t j = 0; j < kJointsPerFinger; ++j) {
      const std::string suffix = j + 1 == kJointsPerFinger ? "tip" : std::to_string(j + 1);
      skeleton.parents.push_back(j == 0 ? 0 : static_cast<std::int32_t>(skeleton.joint_names.size()) - 1);
      skeleton.joint_names.push_back(std::string(finger.name) + "_" + suffix);
    }
  }
  return skeleton;
}

/// The joint of each vertex's largest weight; every pose is that of a joint.
std::vector<std::uint32_t> heaviest_joints(const std::vector<SkinnedVertex>& skinned) {
  std::vector<std::uint32_t> joints;
  for (const SkinnedVertex& vertex : skinned) {
    const auto heaviest = std::max_element(vertex.weights.begin(), vertex.weights.end());
    const auto pose = static_cast<std::size_t>(heaviest - vertex.weights.begin());
    // Pose 1 + 3 f + j is that of joint 1 + 4 f + j: the tips have none of their own.
    joints.push_back(
        static_cast<std::uint32_t>(pose == 0 ? 0 : 1 + (pose - 1) / 3 * kJointsPerFinger + (pose - 1) % 3));
  }
  return joints;
}

/// Subdivided until another step would lead further away from the wanted size than it is now.
Cage subdivide_to(Cage cage, std::uint32_t vertices) {
  cage = subdivide(cage);
  // One step multiplies by four, so twice the present size is the (geometric) middle.
  while (cage.vertices.size() * 2 < vertices) cage = subdivide(cage);
  return cage;
}

}  // namespace

SkinnedSequence make_hand(const SequenceSize& size) {
  const std::array<Finger, kFingers> fingers = hand_fingers();
  const Cage cage = subdivide_to(make_cage(fingers), size.vertices);
  SkinnedSequence hand;
  hand.joints.skeleton = hand_skeleton(fingers);
  Mesh& mesh = hand.sequence.mesh;
  mesh.vertex_count = static_cast<std::uint32_t>(cage.vertices.size());
  for (const auto& [a, b, c, d] : cage.quads) {
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
  }
  std::vector<SkinnedVertex> skinned;
  for (const CageVertex& vertex : cage.vertices) skinned.push_back(skin(vertex, fingers));
  hand.joints.skeleton.heaviest_joint = heaviest_joints(skinned);

  std::vector<Vec3> points(cage.vertices.size());
  for (std::uint32_t frame = 0; frame < size.frames; ++frame) {
    const auto poses = hand_poses(fingers, frame / 30.0);
    for (std::size_t v = 0; v < points.size(); ++v) {
      Vec3 sum;
      for (std::size_t j = 0; j < poses.size(); ++j) {
        const double weight = skinned[v].weights[j];
        if (weight != 0) sum = sum + weight * poses[j].apply(skinned[v].rest);
      }
      points[v] = sum;
    }
    hand.sequence.frames.push_back(to_frame(points));
    hand.joints.frames.push_back(joint_positions(fingers, poses));
  }
  hand.sequence.metadata = {{"name", "hand"}, {"fps", "30"}, {"units", "cm"}, {"up", "y"}};
  return hand;
}

}  // namespace tvg::corpus
