#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tvg/types.hpp>

// For programs that pass a stream on while it is being made: a splitter that takes it apart into verified
// chunks, and an assembler that makes of such chunks a stream for someone who joins later. Neither decodes.
namespace tvg {

/// What a relay lets a stream ask of it.
struct RelayLimits {
  DecoderLimits stream;                                 ///< what the head may declare
  std::uint64_t chunk_bytes = std::uint64_t{64} << 20;  ///< of any chunk
};

/// A piece of a stream that stands on its own.
struct StreamPart {
  enum class Kind {
    kHead,      ///< limits; comes first
    kMetadata,  ///< metadata
    kData,      ///< chunk: free-form data
    kMesh,      ///< chunk, mesh: a mesh that GOPs behind it may name
    kPlan,      ///< chunk, mesh, planes: planes that GOPs of the mesh behind it may name
    kGop,       ///< chunk, mesh, planes, frame_count, first_frame
    kEnd,       ///< the stream is complete; nothing follows
  };

  Kind kind = Kind::kHead;
  StreamLimits limits;
  Metadata metadata;
  std::vector<std::uint8_t> chunk;  ///< from the first byte of its header to its checksum
  std::uint32_t mesh = 0;           ///< name of the mesh, or of the one that the planes or the GOP belong to
  std::vector<std::uint32_t> planes;  ///< the name of the planes, or of all those that the GOP needs
  std::uint32_t frame_count = 0;
  std::uint64_t first_frame = 0;  ///< number of the GOP's first frame in the sequence it was encoded from
};

/// Takes a stream apart as its bytes arrive. Bytes go in with push(), in pieces of any size; next() then
/// gives the parts they complete, until it has none:
///
///   splitter.push(bytes);
///   for (;;) {
///     Result<std::optional<StreamPart>> part = splitter.next();
///     if (!part) return part.error();
///     if (!*part) break;
///     use(std::move(**part));
///   }
///
/// A part is given out only when all of its checksums fit, of a GOP those of all its packets too, and when it
/// is where the format allows it, with the counts the head allows; whether its packets decode is for decoders
/// to say. Chunks of unknown kinds that may be skipped are left out. The splitter never throws and holds at
/// most RelayLimits::chunk_bytes and the bytes pushed last. After an error it gives that error forever.
class StreamSplitter {
 public:
  explicit StreamSplitter(const RelayLimits& limits = {});
  ~StreamSplitter();
  StreamSplitter(StreamSplitter&&) noexcept;
  StreamSplitter& operator=(StreamSplitter&&) noexcept;

  /// Takes the next bytes of the stream; they are copied. kOutOfMemory where that fails.
  Status push(std::span<const std::uint8_t> bytes);
  /// The next part; nothing when it needs more bytes. Errors are those of the bytes: kNotTvg,
  /// kUnsupportedVersion, kChecksumMismatch, kMalformed; and kLimitExceeded, kOutOfMemory.
  Result<std::optional<StreamPart>> next();
  /// Says that no bytes follow: kTruncated unless kEnd was given out.
  Status finish() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// Writes a stream for one receiver: begin(), then meshes, planes and GOPs as they come, then end(). Whatever
/// was written so far is the beginning of a valid stream, and after end() all of one, with an index of its
/// own. Each call returns what the sink does; after an error nothing more may be written.
class StreamAssembler {
 public:
  /// What becomes of a mesh or of planes that are in force already.
  enum class Again {
    /// They are written, unless they are the latest: GOPs may name them for as long as in the stream they
    /// come from. For who passes on chunks as they come.
    kWrite,
    /// Nothing is written. For who gives each GOP what it names.
    kLeaveOut,
  };

  /// The sink gets whole chunks.
  explicit StreamAssembler(ByteSink sink);
  ~StreamAssembler();
  StreamAssembler(StreamAssembler&&) noexcept;
  StreamAssembler& operator=(StreamAssembler&&) noexcept;

  /// Signature, head and, where there are any, metadata.
  Status begin(const StreamLimits& limits, const Metadata& metadata);
  /// A chunk of data as StreamPart has it.
  Status write_data(std::span<const std::uint8_t> chunk);
  /// A mesh chunk as StreamPart has it. kInvalidInput where another mesh of its name is in force.
  Status write_mesh(std::span<const std::uint8_t> chunk, Again again = Again::kWrite);
  /// A chunk of planes as StreamPart has it. kInvalidInput where others of their name are in force,
  /// kInvalidArgument where their mesh is not.
  Status write_plan(std::span<const std::uint8_t> chunk, Again again = Again::kWrite);
  /// A GOP chunk as StreamPart has it; kInvalidArgument where the mesh or planes that it names are not in
  /// force.
  Status write_gop(std::span<const std::uint8_t> chunk, std::uint32_t frame_count);
  /// Index and tail.
  Status end();

  /// GOPs written so far. The index takes 48 bytes of memory for each.
  std::uint64_t gops() const;
  /// Bytes written so far.
  std::uint64_t bytes() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace tvg
