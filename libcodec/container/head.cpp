#include "container/head.hpp"

#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "container/numbers.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace tvg {

namespace {

// Keys of bounds (format-spec §4.1).
enum Key : std::uint64_t {
  kVertices = 1,
  kFaces = 3,
  kFramesPerGop = 5,
  kPacketBytes = 7,
  kDecoderMemory = 9,
  kMeshes = 11,
  kMeshBytes = 13,
  kPlanBytes = 15,
  kComponents = 17,
  kPlans = 19,
  kPropertyBytes = 21,  // which a head may lack
};
constexpr std::array kKeys = {kVertices,      kFaces,  kFramesPerGop, kPacketBytes,
                              kDecoderMemory, kMeshes, kMeshBytes};
constexpr std::array kKeysOfPlanes = {kPlanBytes, kComponents, kPlans};  // which a head may lack

/// The 32-bit bound with this key; null for decoder_memory and keys that are not known.
std::uint32_t* bound_of(StreamLimits& limits, std::uint64_t key) {
  switch (key) {
    case kVertices:
      return &limits.vertices;
    case kFaces:
      return &limits.faces;
    case kFramesPerGop:
      return &limits.frames_per_gop;
    case kPacketBytes:
      return &limits.packet_bytes;
    case kMeshes:
      return &limits.meshes;
    case kMeshBytes:
      return &limits.mesh_bytes;
    case kPlanBytes:
      return &limits.plan_bytes;
    case kComponents:
      return &limits.components;
    case kPlans:
      return &limits.plans;
    case kPropertyBytes:
      return &limits.property_bytes;
    default:
      return nullptr;
  }
}

Status check_version(const StreamHead& head) {
  if (head.major == kFormatMajor && head.minor == kFormatMinor) return {};
  const auto name = [](std::uint16_t major, std::uint16_t minor) {
    return decimal(major) + "." + decimal(minor);
  };
  return stream_error(
      ErrorCode::kUnsupportedVersion, "§4.1",
      {"the stream has format version ", name(head.major, head.minor), ", this decoder reads ",
       name(kFormatMajor, kFormatMinor), ": ",
       head.major == 0 && head.minor < kFormatMinor ? "encode it anew" : "a later release is needed"});
}

/// A bound as it is read; false where its value is out of range.
bool take_bound(StreamLimits& limits, std::uint64_t key, std::uint64_t value) {
  if (key == kDecoderMemory) {
    limits.decoder_memory = value;
    return value < (std::uint64_t{1} << 63);
  }
  if (value > 0xFFFFFFFF || (key == kMeshes && (value == 0 || value > kMaxMeshesInForce))) return false;
  if ((key == kComponents && value > kMaxComponents) ||
      (key == kPlans && (value == 0 || value > kMaxPlansInForce)))
    return false;
  *bound_of(limits, key) = static_cast<std::uint32_t>(value);
  return true;
}

}  // namespace

std::vector<std::uint8_t> write_head(const StreamLimits& limits) {
  ByteWriter head;
  head.u16(kFormatMajor);
  head.u16(kFormatMinor);
  StreamLimits bounds = limits;
  for (const Key key : kKeys) {
    head.varint(key);
    head.varint(key == kDecoderMemory ? bounds.decoder_memory : *bound_of(bounds, key));
  }
  const auto write = [&](Key key) {
    head.varint(key);
    head.varint(*bound_of(bounds, key));
  };
  if (bounds.plan_bytes > 0) std::for_each(kKeysOfPlanes.begin(), kKeysOfPlanes.end(), write);
  if (bounds.property_bytes > 0) write(kPropertyBytes);
  return head.take();
}

namespace {

/// What any stream with these bounds must declare.
// format-spec §8.2
std::uint64_t least_memory(const StreamLimits& limits) {
  return limits.plan_bytes > 0 ? decoder_memory_with_plans(limits) : decoder_memory_needed(limits);
}

// format-spec §4.1
Fault parse_bounds(ByteReader& reader, StreamLimits& limits) {
  constexpr const char* kSection = "§4.1";
  std::size_t known = 0;
  for (AscendingNumbers keys; reader.left() > 0;) {
    const std::uint64_t key = reader.varint();
    const std::uint64_t value = reader.varint();
    if (!reader.ok()) return {kSection, "the bounds of the head do not fill it exactly"};
    if (!keys.take(key)) return {"§3.5", "the keys of the head do not ascend"};
    if (key != kDecoderMemory && bound_of(limits, key) == nullptr) {
      if (!is_required(key)) continue;
      return {kSection, "the head has a bound that this decoder does not know",
              ErrorCode::kUnsupportedVersion};
    }
    if (key <= kMeshBytes) ++known;
    if (!take_bound(limits, key, value)) return {kSection, "a bound of the head is out of range"};
  }
  if (known < kKeys.size()) return {kSection, "the head lacks a bound"};
  if (limits.decoder_memory < least_memory(limits))
    return {kSection, "the declared decoder memory is less than the declared bounds need"};
  return {};
}

}  // namespace

// format-spec §4.1
Result<StreamHead> read_head(Bytes payload) {
  if (!can_allocate(kSmallThings)) return out_of_memory();
  ByteReader reader(payload);
  StreamHead head;
  head.major = reader.u16();
  head.minor = reader.u16();
  if (!reader.ok()) return malformed("§4.1", "the head is too short");
  if (Status version = check_version(head); !version.ok()) return version.error();
  if (const Fault fault = parse_bounds(reader, head.limits)) return error_of(fault);
  return head;
}

// format-spec §8.1
Status check_declared(const StreamLimits& declared, const DecoderLimits& allowed) {
  struct Bound {
    const char* what;
    std::uint32_t StreamLimits::*declared;
    std::uint32_t DecoderLimits::*allowed;
  };
  static constexpr Bound kBounds[] = {
      {"vertices", &StreamLimits::vertices, &DecoderLimits::vertices},
      {"faces", &StreamLimits::faces, &DecoderLimits::faces},
      {"frames per GOP", &StreamLimits::frames_per_gop, &DecoderLimits::frames_per_gop},
      {"bytes per packet", &StreamLimits::packet_bytes, &DecoderLimits::packet_bytes},
      {"meshes in force", &StreamLimits::meshes, &DecoderLimits::meshes},
      {"bytes per mesh", &StreamLimits::mesh_bytes, &DecoderLimits::mesh_bytes},
      {"bytes per chunk of planes", &StreamLimits::plan_bytes, &DecoderLimits::plan_bytes},
      {"components", &StreamLimits::components, &DecoderLimits::components},
      {"chunks of planes in force", &StreamLimits::plans, &DecoderLimits::plans},
      {"bytes of properties", &StreamLimits::property_bytes, &DecoderLimits::property_bytes},
  };
  const auto above = [](const char* what, std::uint64_t asked, std::uint64_t most) {
    if (!can_allocate(kSmallThings)) return out_of_memory();
    return stream_error(
        ErrorCode::kLimitExceeded, "§8.1",
        {"the stream declares ", decimal(asked), " ", what, ", the limit set here is ", decimal(most)});
  };
  for (const Bound& bound : kBounds) {
    if (declared.*bound.declared > allowed.*bound.allowed)
      return above(bound.what, declared.*bound.declared, allowed.*bound.allowed);
  }
  if (declared.decoder_memory > allowed.memory)
    return above("bytes of decoder memory", declared.decoder_memory, allowed.memory);
  return {};
}

namespace {

/// Whether meshes of such a stream may have reference shapes.
bool has_room_for_shapes(const StreamLimits& limits) {
  return limits.decoder_memory >= decoder_memory_with_shapes(limits);
}

/// Whether they may have coarser ones.
bool has_room_for_lods(const StreamLimits& limits) {
  return limits.decoder_memory >= decoder_memory_with_lods(limits);
}

}  // namespace

StreamLimits larger_limits(const StreamLimits& a, const StreamLimits& b) {
  StreamLimits limits;
  limits.vertices = std::max(a.vertices, b.vertices);
  limits.faces = std::max(a.faces, b.faces);
  limits.frames_per_gop = std::max(a.frames_per_gop, b.frames_per_gop);
  limits.packet_bytes = std::max(a.packet_bytes, b.packet_bytes);
  limits.meshes = std::max(a.meshes, b.meshes);
  limits.mesh_bytes = std::max(a.mesh_bytes, b.mesh_bytes);
  limits.plan_bytes = std::max(a.plan_bytes, b.plan_bytes);
  limits.components = std::max(a.components, b.components);
  limits.plans = std::max(a.plans, b.plans);
  limits.property_bytes = std::max(a.property_bytes, b.property_bytes);
  const bool shapes = has_room_for_shapes(a) || has_room_for_shapes(b);
  const bool lods = has_room_for_lods(a) || has_room_for_lods(b);
  const std::uint64_t needed =
      std::max({least_memory(limits), shapes ? decoder_memory_with_shapes(limits) : 0,
                lods ? decoder_memory_with_lods(limits) : 0});
  limits.decoder_memory = std::max({a.decoder_memory, b.decoder_memory, needed});
  return limits;
}

}  // namespace tvg
