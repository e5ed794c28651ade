#pragma once
#include "container/chunk.hpp"

#include <cstdint>

#include <tvg/types.hpp>

// Which chunk may follow which, as a table of state and chunk (format-spec §3.4).
namespace tvg {

/// What kind of chunk a header announces. The last two are types that this version does not know.
enum class ChunkKind : std::uint8_t {
  kHead,
  kMetadata,
  kData,
  kMesh,
  kPlan,
  kGop,
  kIndex,
  kTail,
  kAncillary,
  kCritical,
};
inline constexpr std::size_t kChunkKinds = 10;

ChunkKind kind_of(const ChunkHeader& header);

/// Whether a chunk of a known type has the flag that its type has.
bool flag_fits(const ChunkHeader& header, ChunkKind kind);

/// How far a stream has come.
enum class StreamState : std::uint8_t {
  kStart,    ///< before the head
  kOpen,     ///< before the first mesh
  kBody,     ///< meshes and their GOPs
  kIndexed,  ///< behind the index
  kEnded,    ///< behind the tail
};

/// What becomes of a chunk that stands where it does.
struct OrderRule {
  enum class Verdict : std::uint8_t {
    kTake,      ///< it belongs here
    kReport,    ///< it does not, but nothing is lost if it is read all the same
    kPassOver,  ///< it does not, and its content is of no use
    kRefuse,    ///< nothing behind it can be read
  };

  Verdict verdict = Verdict::kTake;
  const char* fault = nullptr;  ///< what is wrong, unless the verdict is kTake
  const char* section = "";     ///< that it breaks
  ErrorCode code = ErrorCode::kMalformed;
};

const OrderRule& order_rule(StreamState state, ChunkKind kind);

}  // namespace tvg
