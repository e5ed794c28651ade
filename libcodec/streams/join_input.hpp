#pragma once
#include "container/chunk_reader.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tvg/join.hpp>

namespace tvg {

/// One input of join(), read front to back. Errors name the input and the place; after one nothing more may
/// be asked.
class JoinInputReader {
 public:
  JoinInputReader(JoinInput input, const DecoderLimits& limits) : input_(std::move(input)), reader_(limits) {}

  /// Reads signature, head, and metadata and data that follow it, up to the first other chunk.
  Status begin();
  /// Reads on to the next GOP, as far as its header packet. False at the stream's end, which has then been
  /// checked.
  Result<bool> next_gop();
  /// Reads the rest of the GOP, checks it, and passes it on where there is a sink. Must be called once after
  /// each next_gop() that gave true.
  Status pass_gop(const ByteSink* sink);

  const std::string& name() const { return input_.name; }
  const StreamLimits& limits() const { return reader_.head().limits; }
  const Metadata& metadata() const { return metadata_; }
  /// Free-form data and all of their chunk.
  struct DataChunk {
    std::uint32_t id = 0;  ///< payload checksum
    std::string name;
    std::vector<std::uint8_t> bytes;
    /// Where join() looks into them: what is said of frames or of parts, unless it cannot be unpacked.
    std::optional<NamedData> unpacked;
  };
  /// Hands out the data that were read since it was asked last.
  std::vector<DataChunk> take_data() { return std::exchange(data_, {}); }
  /// The chunk of the mesh that the GOP names.
  Bytes mesh() const { return kept(reader_.meshes(), gop_mesh_); }
  /// The chunks of the planes that the GOP names.
  std::vector<Bytes> planes() const;
  /// Of the GOP: its chunk from the first byte to the end of its header packet, and its frames.
  Bytes gop_start() const { return gop_start_; }
  std::uint32_t gop_frames() const { return gop_frames_; }
  /// Ancillary chunks other than data, which join() does not take over.
  std::uint64_t chunks_passed_over() const { return chunks_passed_over_; }

 private:
  /// The next event that is neither a want of bytes nor anything wrong; what is wrong is an error.
  Result<ChunkReader::Event> next();
  void use(ChunkReader::Event event);
  std::vector<std::uint8_t> chunk_with(Bytes payload) const;
  std::optional<NamedData> unpacked() const;
  static Bytes kept(const ChunkWindow& window, std::uint32_t id) {
    return *static_cast<const std::vector<std::uint8_t>*>(window.find(id)->content.get());
  }
  Error located(Error error) const;

  JoinInput input_;
  ChunkReader reader_;
  std::vector<std::uint8_t> piece_;
  Metadata metadata_;
  std::vector<DataChunk> data_;
  bool at_start_ = true;  ///< what was read stands before meshes and frames
  std::uint32_t gop_mesh_ = 0;
  std::vector<std::uint32_t> gop_planes_;
  std::vector<std::uint8_t> gop_start_;  ///< or what was read last of another chunk
  std::uint32_t gop_frames_ = 0;
  std::uint64_t chunks_passed_over_ = 0;
};

}  // namespace tvg
