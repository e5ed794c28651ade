#include "encoder/importers/gltf_meshopt.hpp"

#include "encoder/importers/gltf_extensions.hpp"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace tvg::cli {

namespace {

/// What one compressed byte can stand for at most is a little less.
constexpr std::uint64_t kMostExpansion = 1024;
constexpr std::uint64_t kMostStride = 256;

/// A number that cannot be one is taken for the largest, which no bound lets pass.
std::uint64_t number(const tinygltf::Value& object, const char* name) {
  const tinygltf::Value& value = object.Get(name);
  if (!value.IsNumber()) return 0;
  const double number = value.GetNumberAsDouble();
  return number >= 0 && number < 0x1p53 ? static_cast<std::uint64_t>(number) : ~std::uint64_t{0};
}

std::string text(const tinygltf::Value& object, const char* name) {
  const tinygltf::Value& value = object.Get(name);
  return value.IsString() ? value.Get<std::string>() : "";
}

/// Whether the library may be asked for a view of this shape.
std::optional<std::string> check_shape(const MeshoptView& view) {
  const bool attributes = view.mode == "ATTRIBUTES";
  if (!attributes && view.mode != "TRIANGLES" && view.mode != "INDICES") {
    return fmt::format("has the mode \"{}\"", view.mode);
  }
  const bool good_stride = attributes ? view.stride > 0 && view.stride <= kMostStride && view.stride % 4 == 0
                                      : view.stride == 2 || view.stride == 4;
  if (!good_stride) return fmt::format("has a stride of {} bytes", view.stride);
  if (view.count == 0 || view.count > kMostExpansion * view.length / view.stride) {
    return fmt::format("promises {} elements of {} bytes in {} bytes", view.count, view.stride, view.length);
  }
  if (view.mode == "TRIANGLES" && view.count % 3 != 0)
    return fmt::format("has {} corners of triangles", view.count);
  return std::nullopt;
}

std::optional<std::string> apply_filter(const MeshoptView& view, std::vector<unsigned char>& decoded) {
  if (view.filter.empty() || view.filter == "NONE") return std::nullopt;
  if (view.mode == "ATTRIBUTES") {
    if (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) {
      meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
      return std::nullopt;
    }
    if (view.filter == "QUATERNION" && view.stride == 8) {
      meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
      return std::nullopt;
    }
    if (view.filter == "EXPONENTIAL") {
      meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
      return std::nullopt;
    }
  }
  return fmt::format("has a filter \"{}\" that does not go with its {} of {} bytes", view.filter, view.mode,
                     view.stride);
}

}  // namespace

std::optional<MeshoptView> find_meshopt(const tinygltf::BufferView& view) {
  for (const char* extension : kMeshoptExtensions) {
    const auto found = view.extensions.find(extension);
    if (found == view.extensions.end()) continue;
    const tinygltf::Value& object = found->second;
    return MeshoptView{number(object, "buffer"),     number(object, "byteOffset"),
                       number(object, "byteLength"), number(object, "byteStride"),
                       number(object, "count"),      text(object, "mode"),
                       text(object, "filter")};
  }
  return std::nullopt;
}

std::optional<std::string> decode_meshopt(const MeshoptView& view, std::span<const unsigned char> bytes,
                                          std::vector<unsigned char>& decoded) {
  if (std::optional<std::string> wrong = check_shape(view)) return wrong;
  decoded.resize(view.stride * view.count);
  int result = 0;
  if (view.mode == "ATTRIBUTES") {
    result = meshopt_decodeVertexBuffer(decoded.data(), view.count, view.stride, bytes.data(), bytes.size());
  } else if (view.mode == "TRIANGLES") {
    result = meshopt_decodeIndexBuffer(decoded.data(), view.count, view.stride, bytes.data(), bytes.size());
  } else {
    result = meshopt_decodeIndexSequence(decoded.data(), view.count, view.stride, bytes.data(), bytes.size());
  }
  if (result != 0 && (bytes[0] & 0xf) > (view.mode == "ATTRIBUTES" ? 0 : 1)) {
    return fmt::format(
        "is of version {} of its codec, which the library here does not read: pack it with "
        "EXT_meshopt_compression (gltfpack -cc), or export it without compression",
        bytes[0] & 0xf);
  }
  if (result != 0) return "is damaged";
  return apply_filter(view, decoded);
}

}  // namespace tvg::cli
