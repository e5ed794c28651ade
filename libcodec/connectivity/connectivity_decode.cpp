#include "base/allocation.hpp"
#include "connectivity/traversal.hpp"

namespace tvg {
namespace {

/// The decoder's Guide: it knows nothing.
struct NoGuide {
  void attach(const Border&) {}
  Step root_corner(std::size_t) { return {}; }
  Step behind(std::uint32_t) { return {}; }
  void opened(std::uint32_t, std::size_t) {}
  void added_vertex() {}
};

Error connectivity_error(ErrorCode code, const char* message) {
  Error error;
  error.code = code;
  error.message = message;
  error.section = "§5.1";
  return error;
}

}  // namespace

bool can_allocate_connectivity(std::span<const std::uint8_t> connectivity, std::uint32_t vertex_count,
                               std::uint32_t face_count, std::size_t bytes_per_vertex) {
  constexpr std::size_t kPerFace = 96, kModels = std::size_t{1} << 18;
  const std::uint64_t elements = std::uint64_t{vertex_count} + face_count;
  return elements > kMaxElementsPerByte * connectivity.size() ||
         can_allocate(bytes_per_vertex * vertex_count + kPerFace * face_count + kModels);
}

// format-spec §5.1
Result<Connectivity> decode_connectivity(std::span<const std::uint8_t> bytes, std::uint32_t vertex_count,
                                         std::uint32_t face_count) {
  const std::uint64_t elements = std::uint64_t{vertex_count} + face_count;
  if (elements > kMaxElementsPerByte * bytes.size() || face_count > kMaxFaceCount) {
    return connectivity_error(ErrorCode::kLimitExceeded,
                              "more vertices and faces than the connectivity's bytes can hold");
  }
  Connectivity result;
  RangeDecoder coder(bytes);
  NoGuide guide;
  Traversal traversal(coder, guide, vertex_count, face_count, result);
  if (!traversal.run() || !code_padding(coder, vertex_count, face_count, false) || !coder.finished()) {
    return connectivity_error(ErrorCode::kMalformed,
                              "the connectivity is not a valid traversal of the faces declared");
  }
  return result;
}

}  // namespace tvg
