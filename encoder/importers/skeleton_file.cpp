#include "encoder/importers/skeleton_file.hpp"

#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

using nlohmann::json;

/// The parts of the document, with messages that name the file.
class SkeletonReader {
 public:
  SkeletonReader(const std::string& file, const json& document) : file_(file), document_(document) {}

  JointTracks read() {
    JointTracks tracks;
    read_joints(tracks.skeleton);
    for (const json& frame : array("frames")) tracks.frames.push_back(read_frame(frame, tracks));
    if (document_.contains("heaviest_joint")) read_skin(tracks.skeleton);
    return tracks;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", file_, what));
  }

  const json& array(const char* key) const {
    const auto found = document_.find(key);
    if (found == document_.end() || !found->is_array() || found->empty()) {
      fail(fmt::format(
          "\"{}\" is missing or no list: a skeleton is {{\"joints\": [{{\"name\", \"parent\"}}], \"frames\": "
          "[frame][joint][x, y, z]}}",
          key));
    }
    return *found;
  }

  void read_joints(Skeleton& skeleton) const {
    for (const json& joint : array("joints")) {
      const std::size_t number = skeleton.joint_names.size();
      if (!joint.is_object() || !joint.contains("name") || !joint["name"].is_string() ||
          !joint.contains("parent")) {
        fail(fmt::format("joint {} is not {{\"name\": text, \"parent\": number or null}}", number));
      }
      const json& parent = joint["parent"];
      const bool known = parent.is_number_unsigned() && parent.get<std::uint64_t>() < number;
      if (!parent.is_null() && !known) {
        fail(fmt::format("the parent of joint {} is {}: it must be null or the number of an earlier joint",
                         number, parent.dump()));
      }
      skeleton.joint_names.push_back(joint["name"].get<std::string>());
      skeleton.parents.push_back(parent.is_null() ? -1 : parent.get<std::int32_t>());
    }
  }

  std::vector<float> read_frame(const json& frame, const JointTracks& tracks) const {
    const std::size_t joint_count = tracks.skeleton.joint_names.size();
    if (!frame.is_array() || frame.size() != joint_count) {
      fail(fmt::format("frame {} has not the places of {} joints", tracks.frames.size(), joint_count));
    }
    std::vector<float> positions;
    for (const json& place : frame) {
      bool good = place.is_array() && place.size() == 3;
      for (std::size_t k = 0; good && k < 3; ++k) {
        good = place[k].is_number();
        if (good) positions.push_back(place[k].get<float>());
        good = good && std::isfinite(positions.back());
      }
      if (good) continue;
      fail(fmt::format("frame {}, joint {} is not [x, y, z] in finite numbers", tracks.frames.size(),
                       positions.size() / 3));
    }
    return positions;
  }

  void read_skin(Skeleton& skeleton) const {
    for (const json& joint : array("heaviest_joint")) {
      if (!joint.is_number_unsigned() || joint.get<std::uint64_t>() >= skeleton.joint_names.size()) {
        fail(fmt::format("\"heaviest_joint\" of vertex {} is {}: there are {} joints",
                         skeleton.heaviest_joint.size(), joint.dump(), skeleton.joint_names.size()));
      }
      skeleton.heaviest_joint.push_back(joint.get<std::uint32_t>());
    }
  }

  const std::string& file_;
  const json& document_;
};

/// Whether the skin, where there is one, is that of the mesh.
bool fits(const Skeleton& skeleton, const Mesh& mesh) {
  return skeleton.heaviest_joint.empty() || skeleton.heaviest_joint.size() == mesh.vertex_count;
}

std::string misfit(const std::string& file, const Skeleton& skeleton, const Mesh& mesh) {
  return fmt::format("{} is for {} vertices, and the mesh has {}", file, skeleton.heaviest_joint.size(),
                     mesh.vertex_count);
}

class JointedSource final : public SourceDecorator {
 public:
  JointedSource(std::unique_ptr<FrameSource> source, JointTracks tracks, std::string file,
                std::uint64_t first_frame)
      : SourceDecorator(std::move(source)),
        tracks_(std::move(tracks)),
        file_(std::move(file)),
        first_frame_(first_frame) {}

  const Skeleton& skeleton() const override { return tracks_.skeleton; }
  std::span<const float> joint_positions() const override {
    if (read_ == 0 || first_frame_ + read_ > tracks_.frames.size()) return {};
    return tracks_.frames[first_frame_ + read_ - 1];
  }
  Result<bool> read_frame(std::span<float> positions) override {
    Result<bool> read = SourceDecorator::read_frame(positions);
    if (!read || !*read) return read;
    // A pipe's number of frames is known only now.
    if (first_frame_ + read_ >= tracks_.frames.size()) {
      return ImportError(
                 ErrorCode::kInvalidInput,
                 fmt::format("{} ends after {} frames, and the mesh goes on", file_, tracks_.frames.size()))
          .as_value();
    }
    ++read_;
    return true;
  }
  Result<bool> begin_next_mesh() override {
    Result<bool> begun = SourceDecorator::begin_next_mesh();
    if (begun && *begun && !fits(tracks_.skeleton, mesh()))
      return ImportError(ErrorCode::kInvalidInput, misfit(file_, tracks_.skeleton, mesh())).as_value();
    return begun;
  }
  Status skip_frames(std::uint64_t count) override {
    read_ += count;
    return SourceDecorator::skip_frames(count);
  }
  bool rewind() override {
    if (!SourceDecorator::rewind()) return false;
    read_ = 0;
    return true;
  }

 private:
  JointTracks tracks_;
  std::string file_;
  std::uint64_t first_frame_;
  std::uint64_t read_ = 0;  // frames read so far
};

}  // namespace

JointTracks read_skeleton_file(const std::string& path) {
  std::string text;
  read_file(path, text);
  return parse_skeleton(path, text);
}

JointTracks parse_skeleton(const std::string& file, std::string_view text) {
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded()) {
    throw ImportError(ErrorCode::kInvalidInput,
                      fmt::format("{} is not well-formed JSON, so it is no skeleton", file));
  }
  return SkeletonReader(file, document).read();
}

std::unique_ptr<FrameSource> with_joints(std::unique_ptr<FrameSource> source, JointTracks tracks,
                                         const std::string& file, std::uint64_t first_frame) {
  if (!fits(tracks.skeleton, source->mesh()))
    throw ImportError(ErrorCode::kInvalidInput, misfit(file, tracks.skeleton, source->mesh()));
  const std::optional<std::uint64_t> frames = source->frame_count();
  if (frames && first_frame + *frames > tracks.frames.size()) {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{} has {} frames, and {} are needed", file,
                                                            tracks.frames.size(), first_frame + *frames));
  }
  return std::make_unique<JointedSource>(std::move(source), std::move(tracks), file, first_frame);
}

}  // namespace tvg::cli
