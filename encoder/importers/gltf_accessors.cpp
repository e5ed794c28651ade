#include "encoder/importers/gltf_accessors.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace tvg::cli {

namespace {

std::size_t width_of(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

/// Bytes of a component; 0 of types that glTF does not have.
std::size_t size_of(int component) {
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

bool is_unsigned(int component) {
  return component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

double load_component(const unsigned char* bytes, int component) {
  const char* at = reinterpret_cast<const char*>(bytes);
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return load<std::int8_t>(at, false);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(at, false);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return load<std::int16_t>(at, false);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at, false);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(at, false);
    default:
      return double{load<float>(at, false)};
  }
}

/// What the largest integer of a type stands for 1 of; 1 for floats.
double divisor(int component) {
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return 127;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 255;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return 32767;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 65535;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return 4294967295;
    default:
      return 1;
  }
}

/// Elements in bytes, one after the other or strided.
struct Elements {
  std::span<const unsigned char> bytes;
  std::uint64_t offset = 0;
  std::uint64_t stride = 0;
  int component = 0;
  std::size_t width = 0;

  std::uint64_t element_size() const { return width * size_of(component); }
  bool has(std::uint64_t count) const {
    if (count == 0) return true;
    if (offset > bytes.size() || element_size() > bytes.size() - offset) return false;
    return count - 1 <= (bytes.size() - offset - element_size()) / stride;
  }
  void read(std::uint64_t element, double* out) const {
    const unsigned char* at = bytes.data() + offset + element * stride;
    for (std::size_t i = 0; i < width; ++i) out[i] = load_component(at + i * size_of(component), component);
  }
};

}  // namespace

std::uint64_t GltfLimits::most_numbers(std::uint64_t bytes) const {
  return numbers + numbers_per_byte * std::min(bytes, std::uint64_t{1} << 50);
}

std::uint64_t GltfLimits::most_vertices(std::uint64_t bytes) const {
  return std::min<std::uint64_t>(most_numbers(bytes) / 16, std::numeric_limits<std::uint32_t>::max());
}

GltfAccessors::GltfAccessors(const std::string& path, const GltfDocument& document, GltfFileReader read_file,
                             const GltfLimits& limits)
    : path_(path),
      document_(document),
      buffers_(path, document, std::move(read_file)),
      limits_(limits),
      bytes_(document.binary ? document.binary->size() : 0) {}

void GltfAccessors::fail(const std::string& what, const std::string& why) const {
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {} {}", path_, what, why));
}

const tinygltf::Accessor& GltfAccessors::find(int index, const std::string& what) const {
  const std::vector<tinygltf::Accessor>& all = document_.model.accessors;
  if (index < 0 || static_cast<std::size_t>(index) >= all.size()) {
    fail(what, fmt::format("is in accessor {}, and there are {}", index, all.size()));
  }
  return all[static_cast<std::size_t>(index)];
}

std::uint64_t GltfAccessors::count(int index, const std::string& what) const {
  return find(index, what).count;
}

std::size_t GltfAccessors::width(int index, const std::string& what) const {
  return width_of(find(index, what).type);
}

bool GltfAccessors::has_bytes(int index, const std::string& what) const {
  const tinygltf::Accessor& accessor = find(index, what);
  return accessor.sparse.isSparse ||
         static_cast<std::size_t>(accessor.bufferView) + 1 != document_.model.bufferViews.size();
}

void GltfAccessors::take_budget(std::uint64_t count, std::size_t width, const std::string& what) {
  const std::uint64_t most = limits_.most_numbers(bytes());
  if (count > (most - taken_) / width) {
    fail(what,
         fmt::format("has {} elements, and with those before them that is more than {} numbers, the most "
                     "that are read of a file of its size",
                     count, most));
  }
  taken_ += count * width;
}

void GltfAccessors::read_elements(const tinygltf::Accessor& accessor, std::size_t width,
                                  const std::string& what, std::vector<double>& values) {
  const int view = accessor.bufferView;
  if (static_cast<std::size_t>(view) + 1 == document_.model.bufferViews.size()) {
    take_budget(accessor.count, width, what);
    values.assign(accessor.count * width, 0);
    return;
  }
  Elements elements{buffers_.view(view), accessor.byteOffset, 0, accessor.componentType, width};
  const std::uint64_t stride = document_.model.bufferViews[static_cast<std::size_t>(view)].byteStride;
  elements.stride = stride == 0 ? elements.element_size() : stride;
  if (elements.stride < elements.element_size()) {
    fail(what, fmt::format("has elements of {} bytes, {} apart", elements.element_size(), elements.stride));
  }
  if (!elements.has(accessor.count)) {
    fail(what, fmt::format("promises {} elements, {} bytes apart from byte {} on, and its view has {} bytes",
                           accessor.count, elements.stride, accessor.byteOffset, elements.bytes.size()));
  }
  take_budget(accessor.count, width, what);
  values.resize(accessor.count * width);
  for (std::uint64_t i = 0; i < accessor.count; ++i) elements.read(i, &values[i * width]);
}

void GltfAccessors::read_sparse(const tinygltf::Accessor& accessor, std::size_t width,
                                const std::string& what, std::vector<double>& values) {
  const auto& sparse = accessor.sparse;
  // Versions of tinygltf have numbers of different types here.
  const auto indices_begin = static_cast<std::int64_t>(sparse.indices.byteOffset);
  const auto values_begin = static_cast<std::int64_t>(sparse.values.byteOffset);
  if (sparse.count < 0 || indices_begin < 0 || values_begin < 0 ||
      !is_unsigned(sparse.indices.componentType)) {
    fail(what, "is sparse, and its \"sparse\" makes no sense");
  }
  const auto count = static_cast<std::uint64_t>(sparse.count);
  Elements indices{buffers_.view(sparse.indices.bufferView), static_cast<std::uint64_t>(indices_begin), 0,
                   sparse.indices.componentType, 1};
  Elements replaced{buffers_.view(sparse.values.bufferView), static_cast<std::uint64_t>(values_begin), 0,
                    accessor.componentType, width};
  indices.stride = indices.element_size();
  replaced.stride = replaced.element_size();
  if (!indices.has(count) || !replaced.has(count)) {
    fail(what, fmt::format("is sparse, and its views have not the {} elements it promises", count));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    double index = 0;
    indices.read(i, &index);
    if (index >= static_cast<double>(accessor.count)) {
      fail(what, fmt::format("is sparse, and names element {} of {}", index, accessor.count));
    }
    replaced.read(i, &values[static_cast<std::size_t>(index) * width]);
  }
}

std::vector<double> GltfAccessors::read_plain(const tinygltf::Accessor& accessor, std::size_t width,
                                              const std::string& what) {
  const std::size_t held = width_of(accessor.type);
  if (size_of(accessor.componentType) == 0 || held != width) {
    fail(what, fmt::format("has {} components of type {}, where {} are wanted", held, accessor.componentType,
                           width));
  }
  std::vector<double> values;
  read_elements(accessor, width, what, values);
  if (accessor.sparse.isSparse) read_sparse(accessor, width, what, values);
  return values;
}

std::vector<double> GltfAccessors::read(int index, std::size_t width, const std::string& what,
                                        bool normalized) {
  const tinygltf::Accessor& accessor = find(index, what);
  std::vector<double> values = read_plain(accessor, width, what);
  const double scale = divisor(accessor.componentType);
  if (!(normalized || accessor.normalized) || scale == 1) return values;
  // The least integer of a signed type is one below what stands for -1.
  for (double& value : values) value = std::max(value / scale, -1.0);
  return values;
}

std::vector<std::uint32_t> GltfAccessors::read_numbers(int index, std::size_t width,
                                                       const std::string& what) {
  const tinygltf::Accessor& accessor = find(index, what);
  if (!is_unsigned(accessor.componentType)) {
    fail(what, fmt::format("is of type {}, where whole numbers are wanted", accessor.componentType));
  }
  const std::vector<double> values = read_plain(accessor, width, what);
  std::vector<std::uint32_t> numbers;
  numbers.reserve(values.size());
  for (const double value : values) numbers.push_back(static_cast<std::uint32_t>(value));
  return numbers;
}

}  // namespace tvg::cli
