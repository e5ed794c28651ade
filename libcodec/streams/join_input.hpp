#pragma once
#include "base/checksum.hpp"
#include "container/layout.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/join.hpp>

namespace tvg {

/// One input of join(), read front to back a chunk at a time. Errors name the input and the place; after one
/// nothing more may be asked.
class JoinInputReader {
 public:
  JoinInputReader(JoinInput input, const DecoderLimits& limits)
      : input_(std::move(input)), caller_limits_(limits) {}

  /// Reads signature, head and metadata, and the header of the first chunk after them.
  Status begin();
  /// Reads on to the next GOP, as far as its header packet. False at the stream's end, which has then been
  /// checked.
  Result<bool> next_gop();
  /// Reads the rest of the GOP, checks it, and passes it on where there is a sink. Must be called once after
  /// each next_gop() that gave true.
  Status pass_gop(const ByteSink* sink);

  const std::string& name() const { return input_.name; }
  const StreamLimits& limits() const { return head_.limits; }
  const Metadata& metadata() const { return metadata_; }
  /// Payload of the mesh chunk in force.
  Bytes mesh() const { return mesh_; }
  /// Of the GOP: its chunk from the first byte to the end of its header packet, and its frames.
  Bytes gop_start() const { return gop_start_; }
  std::uint32_t gop_frames() const { return gop_frames_; }
  /// Ancillary chunks that join() does not take over.
  std::uint64_t chunks_passed_over() const { return chunks_passed_over_; }

 private:
  Status read(std::uint64_t size, std::vector<std::uint8_t>& bytes);
  Status read_signature();
  Status read_header();
  Status read_payload(std::uint64_t most);
  Status use_head();
  Status use_mesh();
  Status begin_gop();
  Status use_index();
  Status end_stream();
  Status skip_payload();
  Error fail(ErrorCode code, std::string message, const char* section) const;
  Error located(Error error) const;

  JoinInput input_;
  DecoderLimits caller_limits_;
  std::uint64_t offset_ = 0;
  StreamHead head_;
  Metadata metadata_;
  ChunkHeader chunk_{};
  std::uint64_t chunk_offset_ = 0;
  bool has_header_ = false;        ///< chunk_ has been read and its payload not yet
  std::vector<std::uint8_t> raw_;  ///< the chunk's header as it stands in the stream
  std::vector<std::uint8_t> payload_;
  std::vector<std::uint8_t> mesh_;
  std::vector<std::uint8_t> gop_start_;
  std::uint32_t gop_frames_ = 0;
  std::uint64_t gop_left_ = 0;  ///< bytes of the GOP's payload after its header packet
  std::vector<IndexEntry> seen_;
  std::uint64_t chunks_passed_over_ = 0;
};

}  // namespace tvg
