#include "connectivity/mesh_coder_encode.hpp"
#include "container/metadata.hpp"
#include "container/stream_writer.hpp"
#include "modes/gop_encoder.hpp"
#include "quantization/bounding_box.hpp"
#include "source/gop_reader.hpp"
#include "source/source_checks.hpp"

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

/// One GOP on its way: what is to be encoded, and what marks it.
struct Job {
  GopContent gop;
  const Mesh* mesh = nullptr;
  const Skeleton* skeleton = nullptr;
  Lattice lattice;
};

/// Algorithm 1, then the GOP's chunk.
Result<std::vector<std::uint8_t>> mark_and_encode(const Job& job, const CodedMesh& coded,
                                                  const EncodeOptions& options, const StreamLimits& limits) {
  GopInput input{.frames = job.gop.content->frames,
                 .first_frame = job.gop.first_frame,
                 .lattice = job.lattice,
                 .flags = {},
                 .predictor = options.predictor};
  if (job.lattice.hybrid()) {
    const GopFrames& seen = *job.gop.marked_by;
    Result<Measure> measured =
        measure(*job.mesh, seen.frames, *job.skeleton, seen.joints, options.importance);
    if (!measured) return measured.error();
    input.flags = std::move(measured->flags);
  }
  return encode_gop(input, coded, limits);
}

/// GOPs on their way: encoded by up to `threads` at a time, written in order.
class GopQueue {
 public:
  GopQueue(StreamWriter& writer, unsigned threads, const EncodeProgress& progress,
           std::optional<std::uint64_t> total)
      : writer_(writer), threads_(std::max(1u, threads)), progress_(progress), total_(total) {}

  Status add(Job job, const CodedMesh& mesh, const EncodeOptions& options, const StreamLimits& limits) {
    const auto frame_count = static_cast<std::uint32_t>(job.gop.content->frames.size());
    const auto policy = threads_ > 1 ? std::launch::async : std::launch::deferred;
    pending_.push_back({frame_count, std::async(policy, [job = std::move(job), &mesh, &options, &limits] {
                          return mark_and_encode(job, mesh, options, limits);
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
  GopReader reader(source, options.gop_frames, options.importance);
  for (;;) {
    Result<std::optional<GopContent>> read = reader.next();
    if (!read) return read.error();
    if (!*read) break;
    GopContent& frames = **read;
    const Result<Lattice> lattice = lattice_over(*whole_box ? **whole_box : frames.box, options.fine_bits,
                                                 options.coarse_bits, options.step);
    if (!lattice) return lattice.error();
    frames.first_frame += options.first_frame;
    Job job{.gop = std::move(frames),
            .mesh = &source.mesh(),
            .skeleton = &source.skeleton(),
            .lattice = *lattice};
    if (Status status = queue.add(std::move(job), mesh.coded, options, limits); !status.ok())
      return status.error();
  }
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
