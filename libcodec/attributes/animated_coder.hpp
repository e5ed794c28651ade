#pragma once
#include "attributes/animated_attributes.hpp"
#include "attributes/field_coder.hpp"
#include "attributes/normal_coder.hpp"
#include "attributes/wedges.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tvg {

/// How the values of an animated attribute are coded in a frame. The numbers are those of the format.
enum class ValuePredictor : std::uint8_t {
  kSpace = 0,  ///< as those of an attribute that is not animated
  kTime = 1,   ///< by how they change
};

/// Codes the values of an animated attribute, frame after frame of a GOP (format-spec §5.7.7), written once
/// for encoder and decoder.
class AnimatedCoder {
 public:
  /// `mesh`, `partner` ([half-edge], as pair_edges() has it) and the attribute must outlive it.
  AnimatedCoder(const PropertyMesh& mesh, std::span<const std::uint32_t> partner,
                const AnimatedAttribute& attribute, const AttributeGrid& grid)
      : mesh_(mesh),
        partner_(partner),
        grid_(grid),
        corners_of_vertices_(attribute.domain == AttributeDomain::kVertex ? corners_of_vertices(mesh.faces)
                                                                          : std::vector<std::uint32_t>()),
        fans_(attribute.domain == AttributeDomain::kVertex ? corners_of_vertices_ : attribute.of_corner,
              attribute.count) {
    for (std::vector<std::int32_t>* frame : {&now_, &before_, &older_})
      frame->resize(attribute.count * grid.integers());
    forget();
  }
  AnimatedCoder(const AnimatedCoder&) = delete;
  AnimatedCoder& operator=(const AnimatedCoder&) = delete;

  /// What it takes beside what it is given, in bytes.
  static std::uint64_t bytes(std::uint64_t faces, std::uint64_t values, std::uint64_t integers) {
    return 24 * faces + 4 * values + 12 * integers * values + sizeof(AnimatedCoder) + kModelBytes;
  }
  /// What coding a frame takes for a while.
  static std::uint64_t working_bytes(std::uint64_t values) {
    return std::max(FieldCoder::kBytesPerValue, NormalCoder::kBytesPerValue) * values;
  }

  const AttributeGrid& grid() const { return grid_; }
  std::uint32_t frames() const { return frames_; }
  /// [value][integer] of the frame that is being coded.
  std::span<std::int32_t> integers() { return now_; }
  std::span<const std::int32_t> integers() const { return now_; }
  /// Of the frame before.
  std::span<const std::int32_t> before() const { return before_; }

  /// Begins another frame.
  void next() {
    std::swap(older_, before_);
    std::swap(before_, now_);
    ++frames_;
  }
  /// The frame has the values of the one before, of which there is one.
  void repeat() { std::copy(before_.begin(), before_.end(), now_.begin()); }
  /// Codes the frame; false where the stream is malformed. Time needs a frame before.
  template <class Coder>
  bool code(Coder& coder, ValuePredictor predictor) {
    if (predictor == ValuePredictor::kTime) {
      const FrameHistory history{
          before_, frames_ > 2 ? std::span<const std::int32_t>(older_) : std::span<const std::int32_t>()};
      if (normals_) return NormalCoder(mesh_, fans_, grid_, *normals_, history).code(coder, now_);
      return FieldCoder(mesh_, fans_, partner_, grid_, *fields_, history).code(coder, now_);
    }
    if (grid_.octahedral()) {
      NormalModels models;
      return NormalCoder(mesh_, fans_, grid_, models).code(coder, now_);
    }
    FieldModels models(grid_);
    return FieldCoder(mesh_, fans_, partner_, grid_, models).code(coder, now_);
  }

  /// What was learnt of changes so far.
  struct Learnt {
    std::optional<FieldModels> fields;
    std::optional<NormalModels> normals;
  };
  Learnt learnt() const { return {fields_, normals_}; }
  void take_back(Learnt learnt) {
    fields_ = std::move(learnt.fields);
    normals_ = learnt.normals;
  }

 private:
  static constexpr std::uint64_t kModelBytes = 1 << 14;

  void forget() {
    if (grid_.octahedral()) {
      normals_.emplace();
    } else {
      fields_.emplace(grid_);
    }
  }

  const PropertyMesh& mesh_;
  std::span<const std::uint32_t> partner_;
  AttributeGrid grid_;
  std::vector<std::uint32_t> corners_of_vertices_;
  WedgeFans fans_;
  std::vector<std::int32_t> now_, before_, older_;  ///< [value][integer]
  std::uint32_t frames_ = 0;
  std::optional<FieldModels> fields_;  ///< of changes
  std::optional<NormalModels> normals_;
};

}  // namespace tvg
