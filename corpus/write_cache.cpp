#include "corpus/write_cache.hpp"

#include "tool/atomic_file.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string>

namespace tvg::corpus {
namespace {

void put_word(std::string& bytes, std::uint32_t word) {
  for (const int shift : {0, 8, 16, 24}) bytes.push_back(static_cast<char>(word >> shift));
}

/// The shortest text that reads back as the same float.
void append_number(std::string& text, float value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  text.append(buffer.data(), end);
}

}  // namespace

void write_obj(const std::string& path, const Sequence& sequence) {
  const FramePositions& first = sequence.frames.at(0);
  std::string text;
  for (std::size_t v = 0; v < first.size(); v += 3) {
    text += 'v';
    for (std::size_t k = 0; k < 3; ++k) {
      text += ' ';
      append_number(text, first[v + k]);
    }
    text += '\n';
  }
  for (const Face& face : sequence.mesh.faces) {
    text += 'f';
    for (const std::uint32_t corner : face) text += ' ' + std::to_string(corner + 1);
    text += '\n';
  }
  cli::AtomicFile file(path);
  file.write(text);
  file.finish();
}

void write_pc2(const std::string& path, const Sequence& sequence) {
  std::string bytes = "POINTCACHE2";
  bytes.push_back('\0');
  put_word(bytes, 1);
  put_word(bytes, sequence.mesh.vertex_count);
  put_word(bytes, std::bit_cast<std::uint32_t>(0.0F));  // number of the first frame
  put_word(bytes, std::bit_cast<std::uint32_t>(1.0F));  // frames per sample
  put_word(bytes, static_cast<std::uint32_t>(sequence.frames.size()));
  cli::AtomicFile file(path);
  for (const FramePositions& frame : sequence.frames) {
    for (const float value : frame) put_word(bytes, std::bit_cast<std::uint32_t>(value));
    file.write(bytes);
    bytes.clear();
  }
  file.finish();
}

void write_skeleton(const std::string& path, const JointTracks& tracks) {
  const Skeleton& skeleton = tracks.skeleton;
  nlohmann::json joints = nlohmann::json::array();
  for (std::size_t j = 0; j < skeleton.joint_names.size(); ++j) {
    nlohmann::json parent = nullptr;
    if (skeleton.parents[j] >= 0) parent = skeleton.parents[j];
    joints.push_back({{"name", skeleton.joint_names[j]}, {"parent", parent}});
  }
  nlohmann::json frames = nlohmann::json::array();
  for (const std::vector<float>& frame : tracks.frames) {
    nlohmann::json positions = nlohmann::json::array();
    for (std::size_t k = 0; k < frame.size(); k += 3)
      positions.push_back({frame[k], frame[k + 1], frame[k + 2]});
    frames.push_back(std::move(positions));
  }
  nlohmann::json document = {{"joints", std::move(joints)}, {"frames", std::move(frames)}};
  if (!skeleton.heaviest_joint.empty()) document["heaviest_joint"] = skeleton.heaviest_joint;
  cli::AtomicFile file(path);
  file.write(document.dump() + '\n');
  file.finish();
}

}  // namespace tvg::corpus
