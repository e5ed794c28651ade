#pragma once
#include "tool/atomic_file.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace tvg::cli {

/// Component types of accessors, with glTF's numbers.
enum class GltfComponent {
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};

/// What a view of the buffer is for, with glTF's numbers.
enum class GltfTarget { kNone = 0, kVertices = 34962, kIndices = 34963 };

/// What an accessor is, beside where its elements lie.
struct GltfAccessor {
  GltfComponent component = GltfComponent::kFloat;
  const char* type = "SCALAR";
  std::size_t count = 0;
  bool normalized = false;
  std::vector<double> least = {};  ///< of each component; left out where empty
  std::vector<double> most = {};
};

/// The buffer of a glTF file: appends to `file` from its first byte on, and describes views and accessors in
/// `document`, which outlives it. Numbers are written least significant byte first.
class GltfBuffer {
 public:
  GltfBuffer(AtomicFile& file, nlohmann::json& document) : file_(file), document_(document) {}

  /// Opens a view, which holds what is written up to end_view(). `stride`: bytes from element to element; 0
  /// where they are packed.
  void begin_view(GltfTarget target, std::size_t stride = 0);
  void end_view();
  bool view_is_open() const { return view_.has_value(); }

  void write(std::span<const std::uint8_t> bytes);
  void write(std::span<const float> values);
  void write(std::span<const std::uint32_t> values);

  /// An accessor of what is written next into the open view. Gives its number.
  std::size_t add_accessor(const GltfAccessor& accessor);
  /// The number of the view that is open, or was last.
  std::size_t view() const { return document_["bufferViews"].size() - 1; }
  std::uint64_t size() const { return file_.size(); }

 private:
  AtomicFile& file_;
  nlohmann::json& document_;
  std::optional<std::uint64_t> view_;  ///< where the open view begins
  std::vector<char> bytes_;
};

/// The least and the most of each component of `values` ([element][component]).
struct GltfBounds {
  std::vector<double> least;
  std::vector<double> most;
};
GltfBounds bounds_of(std::span<const float> values, std::size_t components);

}  // namespace tvg::cli
