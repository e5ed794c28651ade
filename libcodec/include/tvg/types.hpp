#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// What both halves of the library speak of: errors, meshes and frames, limits, bytes on their way.
namespace tvg {

// --- errors ---

/// What went wrong. The numbers are frozen: grouped in tens, never renumbered, never reused.
enum class ErrorCode : int {
  // 1x: the caller
  kInvalidArgument = 10,  ///< an option or argument is outside its documented range
  kInvalidInput = 11,     ///< geometry that cannot be encoded: NaN, infinity, index out of range, no faces
  kWrongState = 12,       ///< what is asked for is not there yet, or not any more
  // 2x: the bytes
  kNotTvg = 20,              ///< the signature is missing
  kUnsupportedVersion = 21,  ///< a version, a bound or a critical chunk this decoder does not know
  kTruncated = 22,           ///< the bytes end before the structure does
  kChecksumMismatch = 23,    ///< a checksum does not fit its bytes
  kMalformed = 24,           ///< a field has a value the specification forbids
  kDigestMismatch = 25,      ///< decoded integers differ from those that were encoded
  kUnsupported = 26,         ///< frames need what this decoder does not know; they may be valid
  // 3x: resources
  kLimitExceeded = 30,  ///< a declared or actual size is above the caller's or the stream's limit
  kOutOfMemory = 31,    ///< an allocation failed
  // 4x: the outside world
  kIo = 40,  ///< reading or writing failed
};

/// The code's name in kebab case ("checksum-mismatch"), as `--json` prints it.
const char* error_name(ErrorCode code);

/// An error as a value: nothing in the library throws across its public interface.
struct Error {
  ErrorCode code = ErrorCode::kMalformed;
  std::string message;  ///< one sentence: what is wrong and, where known, what would be right
  std::optional<std::uint64_t> byte_offset = {};  ///< where in the stream, counted from its first byte
  std::optional<std::uint64_t> frame = {};        ///< the first frame concerned, counted from 0
  const char* section = "";  ///< section of format-spec/tvg.md that the bytes break, or ""
  bool names_file = false;   ///< the message names the file at fault, as that of a source of many files does

  /// The message with code, offset, frame and section appended, on one line.
  std::string describe() const;
};

/// Either a value or an error; test with `if (result)` before `*result` or `result.error()`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() { return *std::get_if<0>(&state_); }
  const T& operator*() const { return *std::get_if<0>(&state_); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  Error& error() { return *std::get_if<1>(&state_); }
  const Error& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or an error: test with `if (status.ok())`.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}

  bool ok() const { return !error_.has_value(); }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

// --- meshes and frames ---

/// A triangle: three vertex indices, counter-clockwise seen from outside.
using Face = std::array<std::uint32_t, 3>;

/// Connectivity: any triangle soup. Boundaries, several components, non-manifold edges and vertices, isolated
/// vertices, duplicate and degenerate faces are all allowed; every index is below `vertex_count`.
struct Mesh {
  std::uint32_t vertex_count = 0;
  std::vector<Face> faces;  ///< [face][corner]

  bool operator==(const Mesh&) const = default;
};

/// Key-value pairs of text (see is_metadata_text). Reserved keys: `fps` ("30", "30000/1001"), `name`, `units`
/// ("m", "cm", ...), `up` ("y", "z"), `start` (when frame 0 is, in seconds: "0.5"), `shading` ("flat": the
/// normals are those of the faces).
using Metadata = std::map<std::string, std::string>;

/// Whether `text` may be a key or a value of metadata: well-formed UTF-8 without U+0000 (format-spec §4.2).
bool is_metadata_text(std::string_view text);

/// Positions of one frame: float32 [vertex][xyz], 3 * vertex_count values.
using FramePositions = std::vector<float>;

/// Frames first to last, both included, counted from 0.
struct FrameRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

// --- streams ---

/// Version of the format this library reads and writes (format-spec §4.1).
inline constexpr std::uint16_t kFormatMajor = 0;
inline constexpr std::uint16_t kFormatMinor = 2;

/// Bits of a lattice index (format-spec §7.1): predictions of 24-bit indices, residuals and all, stay within
/// 32 bits.
inline constexpr int kMinBits = 1;
inline constexpr int kMaxBits = 24;

/// Vertices of one mesh (format-spec §4.3): counts are written with 31 bits.
inline constexpr std::uint32_t kMaxVertexCount = 0x7FFFFFFF;
/// Faces of one mesh (format-spec §5.1): their half-edges, three to a face, are numbered with 32 bits.
inline constexpr std::uint32_t kMaxFaceCount = 1u << 30;

/// How the frames of a GOP are coded. The numbers are those of the format (§4.5.1).
enum class Mode : std::uint8_t {
  kElp = 0,       ///< positions on a lattice, predicted in space and time
  kBasis = 1,     ///< sums of a few planes that a period shares: smallest, once the period is complete
  kLossless = 2,  ///< float32 positions, of which every bit comes back
};

/// How frames are predicted (format-spec §7.2, §7.7).
enum class Predictor : std::uint8_t {
  kSpace = 0,  ///< the parallelogram of the gate in the same frame
  kTime = 1,   ///< the same vertex in the frame before
  kElp = 2,    ///< Extended Lorenzo: the parallelogram of the motion (the paper's Eq. 9)
  /// The mean of neighbours along the surface, coarse to fine, and how the vertex missed it before.
  kPyramid = 3,
  kRows = 4,    ///< rows of a frame in mode basis, which are no frame to choose a predictor for
  kShape = 5,   ///< the mesh's reference shape is the frame (§7.10), for meshes that have one frame
  kAuto = 255,  ///< for an encoder: for each frame elp or pyramid, whichever takes fewer bytes
};

/// Predictors that frames have: all but kAuto.
inline constexpr std::size_t kPredictorCount = 6;

/// Meshes that may be in force at once (format-spec §4.1).
inline constexpr std::uint32_t kMaxMeshesInForce = 1u << 16;
/// Chunks of planes that may be in force at once, and components of one (format-spec §4.1).
inline constexpr std::uint32_t kMaxPlansInForce = 256;
inline constexpr std::uint32_t kMaxComponents = 65535;

/// Upper bounds a stream declares for itself (format-spec §4.1).
struct StreamLimits {
  std::uint32_t vertices = 0;        ///< of any mesh
  std::uint32_t faces = 0;           ///< of any mesh
  std::uint32_t frames_per_gop = 0;  ///< of any GOP
  std::uint32_t packet_bytes = 0;    ///< of the content of any packet
  std::uint32_t meshes = 1;          ///< in force at once: how many a decoder keeps
  std::uint32_t mesh_bytes = 0;      ///< of any mesh chunk's payload
  std::uint64_t decoder_memory = 0;  ///< bytes, at least what decoder_memory_needed() says of the others
  std::uint32_t plan_bytes = 0;      ///< of any chunk's payload that holds planes GOPs share; 0: none of use
  std::uint32_t components = 0;      ///< that any such chunk has
  std::uint32_t plans = 1;           ///< such chunks in force at once
  std::uint32_t property_bytes =
      0;  ///< that the properties of any mesh take (format-spec §5.7); 0: none has any

  bool operator==(const StreamLimits&) const = default;
};

/// The memory a decoder of this library may need for a stream with these limits, in bytes (format-spec §8.2).
/// Below 2^63 for any limits within their ranges.
constexpr std::uint64_t decoder_memory_needed(const StreamLimits& limits) {
  const std::uint64_t vertices = limits.vertices, faces = limits.faces;
  const std::uint64_t further_meshes = limits.meshes > 0 ? limits.meshes - 1 : 0;
  const std::uint64_t properties =
      limits.property_bytes == 0
          ? 0
          : (limits.meshes + std::uint64_t{1}) * limits.property_bytes + 192 * vertices + 512 * faces;
  return (std::uint64_t{1} << 20) + 160 * vertices + 96 * faces + 4 * std::uint64_t{limits.packet_bytes} +
         limits.mesh_bytes + further_meshes * (512 + 24 * vertices + 16 * faces) + properties;
}

/// The same where meshes have reference shapes, from which the pyramid is made that frames may be predicted
/// along (format-spec §8.2).
constexpr std::uint64_t decoder_memory_with_shapes(const StreamLimits& limits) {
  const std::uint64_t vertices = limits.vertices, faces = limits.faces;
  return decoder_memory_needed(limits) + vertices * (400 + 128 * std::uint64_t{limits.meshes}) + 96 * faces;
}

/// The same where GOPs share planes, which stay as long as they are in force (format-spec §8.2).
constexpr std::uint64_t decoder_memory_with_plans(const StreamLimits& limits) {
  const std::uint64_t vertices = limits.vertices, components = limits.components;
  const std::uint64_t of_each = 4096 + components * (64 + 4 * vertices) + 8 * vertices;
  return decoder_memory_with_shapes(limits) + limits.plan_bytes + limits.plans * of_each + 128 * vertices +
         1536 * components;
}

/// The same where meshes have coarser ones, and planes that GOPs share come in parts (format-spec §8.2).
constexpr std::uint64_t decoder_memory_with_lods(const StreamLimits& limits) {
  const std::uint64_t vertices = limits.vertices, faces = limits.faces, meshes = limits.meshes;
  const std::uint64_t parts = std::uint64_t{limits.plans} * limits.plan_bytes;
  return (limits.plan_bytes > 0 ? decoder_memory_with_plans(limits) : decoder_memory_with_shapes(limits)) +
         parts + (std::uint64_t{1} << 18) + vertices * (64 + 16 * meshes) + faces * (96 + 16 * meshes);
}

/// What the head of a stream says.
struct StreamHead {
  std::uint16_t major = kFormatMajor;
  std::uint16_t minor = kFormatMinor;
  StreamLimits limits;
};

/// A number for each chunk of planes that a GOP names, none of them 0. None or one, as in all modes so far,
/// take no memory of their own.
class PlaneList {
 public:
  PlaneList() = default;
  explicit PlaneList(std::uint64_t only) : only_(only) {}
  /// A list of any length; nothing where there is no memory for it.
  static std::optional<PlaneList> of(std::span<const std::uint64_t> numbers);

  /// In the order of the GOP's header; valid as long as the list is.
  std::span<const std::uint64_t> numbers() const {
    return more_ ? std::span<const std::uint64_t>(*more_) : std::span(&only_, only_ == 0 ? 0 : 1);
  }
  bool operator==(const PlaneList& other) const;

 private:
  std::uint64_t only_ = 0;  ///< 0 where there is none, or more than one
  std::shared_ptr<const std::vector<std::uint64_t>> more_;
};

/// One line of a stream's index (format-spec §4.6).
struct IndexEntry {
  /// The numbers are those of the format.
  enum class Kind : std::uint8_t {
    kMesh = 1,
    kPlan = 2,          ///< what several GOPs share
    kGop = 3,           ///< decoding can begin at it
    kDependentGop = 4,  ///< it needs GOPs before it; no mode makes one so far
  };

  std::uint64_t offset = 0;       ///< of the chunk's first byte, from the first byte of the stream
  std::uint32_t frame_count = 0;  ///< frames of a GOP, 0 for others
  std::uint32_t meshes_back = 0;  ///< of a GOP: its mesh is so many meshes back, 1 the last before it; else 0
  Kind kind = Kind::kGop;
  PlaneList planes_back = {};  ///< of a GOP: its planes are so many chunks of planes back, as its mesh is

  bool is_gop() const { return kind == Kind::kGop || kind == Kind::kDependentGop; }
  bool operator==(const IndexEntry&) const = default;
};

/// What a caller lets a stream ask for. A stream that declares more in its head is refused before anything is
/// allocated.
struct DecoderLimits {
  std::uint32_t vertices = 1u << 24;
  std::uint32_t faces = 1u << 25;
  std::uint32_t frames_per_gop = 1u << 16;
  std::uint32_t packet_bytes = 1u << 29;
  std::uint32_t meshes = kMaxMeshesInForce;
  std::uint32_t mesh_bytes = 1u << 30;
  std::uint64_t memory = std::uint64_t{4} << 30;  ///< bytes
  std::uint32_t plan_bytes = 1u << 30;
  std::uint32_t components = 1u << 14;
  std::uint32_t plans = kMaxPlansInForce;
  std::uint32_t property_bytes = 1u << 31;
};

struct ByteRange {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

/// Takes the stream's bytes front to back. An error ends the encoding.
using ByteSink = std::function<Status(std::span<const std::uint8_t>)>;
/// Hears how far encoding is: frames written, and how many there will be if that is known.
using EncodeProgress = std::function<void(std::uint64_t frames, std::optional<std::uint64_t> total)>;

/// Reads the next bytes of a stream into the span: how many there were, 0 only at the end.
using ByteSource = std::function<Result<std::size_t>(std::span<std::uint8_t>)>;

}  // namespace tvg
