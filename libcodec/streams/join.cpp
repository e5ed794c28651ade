#include "base/errors.hpp"
#include "container/chunk.hpp"
#include "container/head.hpp"
#include "container/metadata.hpp"
#include "container/stream_writer.hpp"
#include "streams/join_input.hpp"
#include "streams/joined_data.hpp"

#include <deque>
#include <new>
#include <optional>
#include <utility>

#include <tvg/join.hpp>

namespace tvg {

namespace {

std::string frames_text(const FrameRange& frames) {
  return std::to_string(frames.first) + "-" + std::to_string(frames.last);
}

class Joiner {
 public:
  Joiner(const JoinOptions& options, const ByteSink& sink, const EncodeProgress& progress)
      : options_(options),
        writer_(sink),
        writer_sink_([this](Bytes bytes) { return writer_.write(bytes); }),
        progress_(progress) {}

  Result<JoinReport> run(std::vector<JoinInput> inputs) {
    if (inputs.empty()) return invalid_argument("there is nothing to join");
    if (options_.frames && options_.frames->first > options_.frames->last) {
      return invalid_argument("frames " + frames_text(*options_.frames) + ": the first comes after the last");
    }
    // All heads and metadata come before the first byte is written.
    for (JoinInput& input : inputs) {
      readers_.emplace_back(std::move(input), options_.limits);
      if (Status status = readers_.back().begin(); !status.ok()) return status.error();
    }
    data_.emplace(readers_.size(), !options_.frames);
    for (JoinInputReader& reader : readers_) data_->add_start(reader.name(), reader.take_data());
    if (Status status = options_.frames ? Status() : data_->check_parts(); !status.ok())
      return status.error();
    if (Status status = write_start(); !status.ok()) return status.error();
    for (; !readers_.empty() && !done(); readers_.pop_front()) {
      if (Status status = add(readers_.front()); !status.ok()) return status.error();
    }
    if (options_.frames && !done()) {
      return invalid_argument("frames " + frames_text(*options_.frames) +
                              " are asked for, but the input has " +
                              (position_ == 0 ? "none" : "the frames " + frames_text({0, position_ - 1})));
    }
    if (report_.frames == 0) return Error{ErrorCode::kInvalidInput, "the inputs have no frames", {}, {}, ""};
    if (Status status = writer_.write_end(); !status.ok()) return status.error();
    report_.bytes = writer_.offset();
    return std::move(report_);
  }

 private:
  bool done() const { return options_.frames && position_ > options_.frames->last; }

  Status write_start() {
    StreamLimits limits;
    for (const JoinInputReader& reader : readers_) limits = larger_limits(limits, reader.limits());
    const Metadata metadata = merge_metadata();
    if (write_metadata(metadata).size() > kMaxMetadataPayload) {
      return Error{ErrorCode::kLimitExceeded,
                   "the metadata of all inputs together are too long for a stream",
                   {},
                   {},
                   "§4.2"};
    }
    if (Status status = writer_.write_start(limits, metadata); !status.ok()) return status;
    return write_chunks(data_->start_chunks());
  }

  Status write_chunks(const std::vector<std::vector<std::uint8_t>>& chunks) {
    for (const std::vector<std::uint8_t>& chunk : chunks) {
      if (Status status = writer_.write(chunk); !status.ok()) return status;
    }
    return {};
  }

  Metadata merge_metadata() {
    Metadata merged;
    for (const JoinInputReader& reader : readers_) {
      for (const auto& [key, value] : reader.metadata()) {
        const std::string& kept = merged.emplace(key, value).first->second;
        if (kept == value) continue;
        std::string& note = report_.notes.emplace_back(reader.name());
        note.append(": its ").append(key).append(" is \"").append(value);
        note.append("\"; \"").append(kept).append("\" of an earlier input is kept");
      }
    }
    return merged;
  }

  Status add(JoinInputReader& reader) {
    while (!done()) {
      const Result<bool> more = reader.next_gop();
      if (!more) return more.error();
      if (!*more) break;
      const FrameRange gop{position_, position_ + reader.gop_frames() - 1};
      const Result<bool> wanted = is_wanted(gop, reader.name());
      if (!wanted) return wanted.error();
      if (*wanted) {
        if (Status status = write_gop_start(reader); !status.ok()) return status;
      }
      if (Status status = reader.pass_gop(*wanted ? &writer_sink_ : nullptr); !status.ok()) return status;
      position_ = gop.last + 1;
      if (!*wanted) continue;
      ++report_.gops;
      report_.frames += reader.gop_frames();
      if (progress_) progress_(report_.frames, std::nullopt);
    }
    if (reader.chunks_passed_over() > 0) {
      report_.notes.push_back(reader.name() + ": chunks of unknown kinds are left out: " +
                              std::to_string(reader.chunks_passed_over()));
    }
    Status status = write_chunks(data_->later_chunks(reader.name(), reader.take_data()));
    for (std::string& note : data_->take_notes()) report_.notes.push_back(std::move(note));
    return status;
  }

  /// Whether a GOP is to be copied; an error where a border of the frames asked for lies inside it.
  Result<bool> is_wanted(const FrameRange& gop, const std::string& name) const {
    if (!options_.frames) return true;
    const FrameRange& wanted = *options_.frames;
    const std::string where =
        " lies inside the GOP of frames " + frames_text(gop) + " (" + name + "): a cut can ";
    if (wanted.first > gop.first && wanted.first <= gop.last) {
      return invalid_argument("frame " + std::to_string(wanted.first) + where + "begin at frame " +
                              std::to_string(gop.first) + ", or at " + std::to_string(gop.last + 1) +
                              " where frames follow");
    }
    if (wanted.last >= gop.first && wanted.last < gop.last) {
      const std::string before = gop.first > wanted.first ? std::to_string(gop.first - 1) + " or " : "";
      return invalid_argument("frame " + std::to_string(wanted.last) + where + "end at frame " + before +
                              std::to_string(gop.last));
    }
    return wanted.first <= gop.first && gop.last <= wanted.last;
  }

  Status write_gop_start(const JoinInputReader& reader) {
    if (Status status = writer_.write_mesh_chunk(reader.mesh()); !status.ok()) return status;
    report_.meshes = writer_.meshes();
    for (const Bytes chunk : reader.planes()) {
      if (Status status = writer_.write_plan_chunk(chunk); !status.ok()) return status;
    }
    return writer_.write_gop_chunk(reader.gop_start(), reader.gop_frames());
  }

  const JoinOptions& options_;
  StreamWriter writer_;
  ByteSink writer_sink_;  ///< appends to what the writer has written
  const EncodeProgress& progress_;
  std::deque<JoinInputReader> readers_;
  std::optional<JoinedData> data_;
  std::uint64_t position_ = 0;  ///< of the next frame over all inputs
  JoinReport report_;
};

}  // namespace

Result<JoinReport> join(std::vector<JoinInput> inputs, const JoinOptions& options, const ByteSink& sink,
                        const EncodeProgress& progress) {
  try {
    return Joiner(options, sink, progress).run(std::move(inputs));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "there is not enough memory for the inputs' meshes", {}, {}, ""};
  }
}

}  // namespace tvg
