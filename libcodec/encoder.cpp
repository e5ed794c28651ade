#include "container/layout.hpp"
#include "container/stream_writer.hpp"
#include "gop_encoder.hpp"
#include "mesh_encoder.hpp"
#include "quantization/bounding_box.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <memory>
#include <new>
#include <string>

#include <tvg/encoder.hpp>

namespace tvg {

namespace {

Error invalid_argument(std::string message) {
  return {ErrorCode::kInvalidArgument, std::move(message), {}, {}, ""};
}

constexpr std::uint64_t kMaxFirstFrame = std::uint64_t{1} << 61;  // leaves room for the frames that follow

Status check_options(const EncodeOptions& options) {
  if (options.fine_bits < kMinBits || options.fine_bits > kMaxBits || options.coarse_bits < kMinBits ||
      options.coarse_bits > options.fine_bits) {
    return invalid_argument(
        "bits must be 1 to 24, and those of unimportant vertices at most those of important ones");
  }
  if (options.step && !(std::isfinite(*options.step) && *options.step > 0)) {
    return invalid_argument("the step must be a positive length in the mesh's units");
  }
  if (options.predictor > Predictor::kElp) return invalid_argument("there is no such predictor");
  if (options.first_frame > kMaxFirstFrame)
    return invalid_argument("the number of the first frame is too large");
  if (options.gop_frames == 0 || options.gop_frames > (1u << 16)) {
    return invalid_argument("a GOP must have 1 to 65536 frames");
  }
  return {};
}

Status check_mesh(const Mesh& mesh) {
  const auto invalid = [](std::string message) {
    return Error{ErrorCode::kInvalidInput, std::move(message), {}, {}, ""};
  };
  if (mesh.vertex_count == 0) return invalid("the mesh has no vertices");
  if (mesh.vertex_count >= 0x80000000u || mesh.faces.size() >= 0x2AAAAAAAu) {
    return invalid("the mesh has more vertices or faces than a stream can hold");
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::uint32_t corner : mesh.faces[f]) {
      if (corner >= mesh.vertex_count) {
        return invalid("face " + std::to_string(f) + " refers to vertex " + std::to_string(corner) +
                       ", the mesh has " + std::to_string(mesh.vertex_count));
      }
    }
  }
  return {};
}

/// Reads the next frame and refuses what no lattice can hold. False at the end.
Result<bool> read_checked(FrameSource& source, FramePositions& frame, std::uint64_t number) {
  Result<bool> read = source.read_frame(frame);
  if (!read || !*read) return read;
  const auto bad = std::find_if_not(frame.begin(), frame.end(), [](float x) { return std::isfinite(x); });
  if (bad == frame.end()) return true;
  const auto i = static_cast<std::size_t>(bad - frame.begin());
  return Error{ErrorCode::kInvalidInput,
               "vertex " + std::to_string(i / 3) + " has a coordinate that is infinite or not a number",
               {},
               number,
               ""};
}

StreamLimits limits_for(const Mesh& mesh, const EncodeOptions& options) {
  StreamLimits limits;
  limits.vertices = mesh.vertex_count;
  limits.faces = static_cast<std::uint32_t>(mesh.faces.size());
  limits.frames_per_gop = options.gop_frames;
  // 64 bits per coordinate: more than the worst residual can take.
  limits.packet_bytes = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(256 + 24 * std::uint64_t{mesh.vertex_count}, kMaxChunkLength));
  limits.decoder_memory = decoder_memory_needed(limits);
  return limits;
}

/// GOPs on their way: encoded by up to `threads` at a time, written in order.
class GopQueue {
 public:
  GopQueue(StreamWriter& writer, unsigned threads, const EncodeProgress& progress,
           std::optional<std::uint64_t> total)
      : writer_(writer), threads_(std::max(1u, threads)), progress_(progress), total_(total) {}

  Status add(GopInput input, const CodedMesh& mesh, const EncodeOptions& options,
             const StreamLimits& limits) {
    const auto frame_count = static_cast<std::uint32_t>(input.content->frames.size());
    const auto policy = threads_ > 1 ? std::launch::async : std::launch::deferred;
    pending_.push_back({frame_count, std::async(policy, [input = std::move(input), &mesh, &options, &limits] {
                          return encode_gop(input, mesh, options, limits);
                        })});
    return pending_.size() < threads_ ? Status() : write_oldest();
  }
  Status finish() {
    while (!pending_.empty()) {
      if (Status status = write_oldest(); !status.ok()) return status;
    }
    return {};
  }

  std::uint64_t frames() const { return frames_; }
  std::uint64_t gops() const { return gops_; }

 private:
  struct Pending {
    std::uint32_t frame_count;
    std::future<Result<std::vector<std::uint8_t>>> chunk;
  };

  Status write_oldest() {
    Pending oldest = std::move(pending_.front());
    pending_.pop_front();
    const Result<std::vector<std::uint8_t>> chunk = oldest.chunk.get();
    if (!chunk) return chunk.error();
    if (Status status = writer_.write_gop_chunk(*chunk, oldest.frame_count); !status.ok()) return status;
    frames_ += oldest.frame_count;
    ++gops_;
    if (progress_) progress_(frames_, total_);
    return {};
  }

  StreamWriter& writer_;
  unsigned threads_;
  const EncodeProgress& progress_;
  std::optional<std::uint64_t> total_;
  std::deque<Pending> pending_;
  std::uint64_t frames_ = 0;
  std::uint64_t gops_ = 0;
};

/// The box of the whole sequence; leaves the source at its first frame. Empty when the source can be read
/// only once.
Result<std::optional<BoundingBox>> scan_box(FrameSource& source) {
  if (!source.rewind()) return std::optional<BoundingBox>();
  BoundingBox box;
  FramePositions frame(3 * std::size_t{source.mesh().vertex_count});
  for (std::uint64_t number = 0;; ++number) {
    const Result<bool> read = read_checked(source, frame, number);
    if (!read) return read.error();
    if (!*read) break;
    box.extend(frame);
  }
  if (!source.rewind()) return Error{ErrorCode::kIo, "the input cannot be read a second time", {}, {}, ""};
  return std::optional(box);
}

/// Where the joints are in the frame that was read last, which all have to be somewhere.
Result<std::vector<float>> read_joints(const FrameSource& source, std::uint64_t number) {
  const std::span<const float> joints = source.joint_positions();
  const std::size_t joint_count = source.skeleton().joint_names.size();
  const auto invalid = [number](std::string message) {
    return Error{ErrorCode::kInvalidInput, std::move(message), {}, number, ""};
  };
  if (joints.size() != 3 * joint_count) {
    return invalid("there are positions for " + std::to_string(joints.size() / 3) + " of the skeleton's " +
                   std::to_string(joint_count) + " joints");
  }
  if (!std::all_of(joints.begin(), joints.end(), [](float x) { return std::isfinite(x); })) {
    return invalid("a joint has a coordinate that is infinite or not a number");
  }
  return std::vector<float>(joints.begin(), joints.end());
}

/// The frames of the next GOP, and their box.
struct GopRead {
  GopFrames content;
  BoundingBox box;
  bool at_end = false;  ///< of the sequence
};

Result<GopRead> read_gop(FrameSource& source, const EncodeOptions& options, std::uint64_t number) {
  const bool with_joints = uses_skeleton(options.importance);
  GopRead gop;
  for (; gop.content.frames.size() < options.gop_frames; ++number) {
    FramePositions frame(3 * std::size_t{source.mesh().vertex_count});
    const Result<bool> read = read_checked(source, frame, number);
    if (!read) return read.error();
    gop.at_end = !*read;
    if (gop.at_end) break;
    gop.box.extend(frame);
    gop.content.frames.push_back(std::move(frame));
    if (!with_joints) continue;
    Result<std::vector<float>> joints = read_joints(source, number);
    if (!joints) return joints.error();
    gop.content.joints.push_back(std::move(*joints));
  }
  return gop;
}

/// The first frame alone.
std::shared_ptr<const GopFrames> first_frame_of(const GopFrames& content) {
  auto first = std::make_shared<GopFrames>();
  first->frames.push_back(content.frames.front());
  if (!content.joints.empty()) first->joints.push_back(content.joints.front());
  return first;
}

/// The encoding pipeline: frames → GOPs → chunks.
Result<EncodeReport> encode_checked(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                                    const EncodeProgress& progress) {
  const Result<std::optional<BoundingBox>> whole_box = scan_box(source);
  if (!whole_box) return whole_box.error();

  const StreamLimits limits = limits_for(source.mesh(), options);
  EncodedMesh mesh = encode_mesh(source.mesh(), options.keep_vertex_order);
  Metadata metadata = options.metadata;
  metadata.merge(source.metadata());
  if (metadata.count("") > 0) return invalid_argument("a key of the metadata is empty");
  for (const auto& [key, value] : metadata) {
    if (!is_metadata_text(key)) return invalid_argument("a key of the metadata is no text in UTF-8");
    if (!is_metadata_text(value))
      return invalid_argument("the metadata's value of '" + key + "' is no text in UTF-8");
  }
  if (write_metadata(metadata).size() > kMaxSmallPayload)
    return invalid_argument("the metadata is above 1 MiB");
  StreamWriter writer(sink);
  if (Status status = writer.write_start(limits, metadata); !status.ok()) return status.error();
  if (Status status = writer.write_mesh_chunk(write_chunk(kMeshChunk, false, mesh.payload)); !status.ok())
    return status.error();

  GopQueue queue(writer, options.threads, progress, source.frame_count());
  std::shared_ptr<const GopFrames> previous;
  std::uint64_t number = 0;
  for (bool at_end = false; !at_end;) {
    Result<GopRead> read = read_gop(source, options, number);
    if (!read) return read.error();
    at_end = read->at_end;
    if (read->content.frames.empty()) break;
    const Result<Lattice> lattice = lattice_over(*whole_box ? **whole_box : read->box, options.fine_bits,
                                                 options.coarse_bits, options.step);
    if (!lattice) return lattice.error();
    const auto content = std::make_shared<const GopFrames>(std::move(read->content));
    if (!previous) previous = first_frame_of(*content);
    GopInput gop{content, options.importance.low_delay ? previous : content, &source.skeleton(),
                 options.first_frame + number, *lattice};
    number += content->frames.size();
    previous = content;
    if (Status status = queue.add(std::move(gop), mesh.coded, options, limits); !status.ok())
      return status.error();
  }
  if (number == 0) return Error{ErrorCode::kInvalidInput, "the sequence has no frames", {}, {}, ""};
  if (Status status = queue.finish(); !status.ok()) return status.error();
  if (Status status = writer.write_end(); !status.ok()) return status.error();
  return EncodeReport{queue.frames(), source.mesh().vertex_count, queue.gops(), writer.offset(), !*whole_box};
}

}  // namespace

Result<EncodeReport> encode(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                            const EncodeProgress& progress) {
  if (Status status = check_options(options); !status.ok()) return status.error();
  if (Status status = check_mesh(source.mesh()); !status.ok()) return status.error();
  if (Status status = check_importance(options.importance, source.mesh(), source.skeleton()); !status.ok())
    return status.error();
  try {
    return encode_checked(source, options, sink, progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 "there is not enough memory: use fewer frames per GOP or fewer threads",
                 {},
                 {},
                 ""};
  }
}

}  // namespace tvg
