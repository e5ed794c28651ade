#include "container/chunk_order.hpp"

#include <array>

namespace tvg {

namespace {

using Verdict = OrderRule::Verdict;

constexpr std::array<ChunkType, 8> kKnown = {kHeadChunk, kMetadataChunk, kDataChunk,  kMeshChunk,
                                             kPlanChunk, kGopChunk,      kIndexChunk, kTailChunk};

constexpr OrderRule kTake = {};
// Malformed too, since no mesh is in force; but what they begin with says what is lost with them.
constexpr OrderRule kNoMesh = {};
constexpr OrderRule kNoHead = {Verdict::kRefuse, "the stream does not begin with its head", "§3.4"};
constexpr OrderRule kHeadTwice = {Verdict::kPassOver, "the stream has a second head", "§3.4"};
constexpr OrderRule kIndexTwice = {Verdict::kPassOver, "the stream has a second index", "§3.4"};
constexpr OrderRule kMetaLate = {Verdict::kPassOver, "metadata follow the index", "§3.4"};
constexpr OrderRule kDataLate = {Verdict::kPassOver, "data follow the index", "§3.4"};
constexpr OrderRule kMeshLate = {Verdict::kPassOver, "a mesh follows the index", "§3.4"};
constexpr OrderRule kPlanLate = {Verdict::kPassOver, "planes follow the index", "§3.4"};
constexpr OrderRule kGopLate = {Verdict::kPassOver, "a GOP follows the index", "§3.4"};
constexpr OrderRule kNoIndex = {Verdict::kReport, "the stream ends without an index", "§3.4"};
constexpr OrderRule kUnknown = {Verdict::kRefuse, "the stream needs a decoder that knows this chunk", "§3.2",
                                ErrorCode::kUnsupportedVersion};

// format-spec §3.4
// clang-format off
constexpr std::array<std::array<OrderRule, kChunkKinds>, 4> kTable = {{
  //             HEAD        META       DATA       MESH       PLAN       GOP       INDX         TAIL      ancillary critical
  /* start */   {kTake,      kNoHead,   kNoHead,   kNoHead,   kNoHead,   kNoHead,  kNoHead,     kNoHead,  kNoHead,  kNoHead},
  /* open */    {kHeadTwice, kTake,     kTake,     kTake,     kNoMesh,   kNoMesh,  kTake,       kNoIndex, kTake,    kUnknown},
  /* body */    {kHeadTwice, kTake,     kTake,     kTake,     kTake,     kTake,    kTake,       kNoIndex, kTake,    kUnknown},
  /* indexed */ {kHeadTwice, kMetaLate, kDataLate, kMeshLate, kPlanLate, kGopLate, kIndexTwice, kTake,    kTake,    kUnknown},
}};
// clang-format on

}  // namespace

ChunkKind kind_of(const ChunkHeader& header) {
  for (std::size_t i = 0; i < kKnown.size(); ++i) {
    if (header.type == kKnown[i]) return static_cast<ChunkKind>(i);
  }
  return header.ancillary ? ChunkKind::kAncillary : ChunkKind::kCritical;
}

bool flag_fits(const ChunkHeader& header, ChunkKind kind) {
  const bool ancillary = kind == ChunkKind::kMetadata || kind == ChunkKind::kData ||
                         kind == ChunkKind::kIndex || kind == ChunkKind::kAncillary;
  return header.ancillary == ancillary;
}

const OrderRule& order_rule(StreamState state, ChunkKind kind) {
  return kTable[static_cast<std::size_t>(state)][static_cast<std::size_t>(kind)];
}

}  // namespace tvg
