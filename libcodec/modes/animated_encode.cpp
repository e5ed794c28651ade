#include "modes/animated_encode.hpp"

#include "attributes/animated_coder.hpp"
#include "attributes/attribute_grid_encode.hpp"
#include "base/checksum.hpp"
#include "entropy/range_coder.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace tvg {

namespace {

/// Puts the integers of values given in the order in which they are coded.
void put_in_order(std::span<const std::int32_t> given, const AnimatedAttribute& attribute,
                  const GopMesh& mesh, AnimatedCoder& coder) {
  const std::size_t width = coder.grid().integers();
  for (std::size_t i = 0; i < attribute.count; ++i) {
    const std::size_t from = attribute.domain == AttributeDomain::kVertex   ? mesh.coded.order[i]
                             : attribute.domain == AttributeDomain::kCorner ? attribute.given[i]
                                                                            : i;
    std::copy_n(&given[width * from], width, &coder.integers()[width * i]);
  }
}

std::vector<std::uint8_t> code_by(ValuePredictor predictor, AnimatedCoder& coder) {
  ByteWriter piece;
  piece.u8(static_cast<std::uint8_t>(predictor));
  if (coder.frames() == 1) write_steps(piece, coder.grid());
  RangeEncoder encoder;
  coder.code(encoder, predictor);
  piece.bytes(encoder.finish());
  return piece.take();
}

/// The smallest way to code the frame that the coder has.
std::vector<std::uint8_t> code_frame(AnimatedCoder& coder) {
  const bool first = coder.frames() == 1;
  const std::span<const std::int32_t> now = coder.integers();
  if (!first && std::equal(now.begin(), now.end(), coder.before().begin())) return {};
  std::vector<std::uint8_t> by_space = code_by(ValuePredictor::kSpace, coder);
  if (first) return by_space;
  AnimatedCoder::Learnt before = coder.learnt();
  std::vector<std::uint8_t> by_time = code_by(ValuePredictor::kTime, coder);
  if (by_time.size() <= by_space.size()) return by_time;
  coder.take_back(std::move(before));
  return by_space;
}

}  // namespace

// format-spec §5.7.7
std::vector<EncodedChannel> encode_channels(const GopInput& input, const GopMesh& mesh, std::size_t first,
                                            std::size_t count) {
  std::vector<EncodedChannel> channels;
  if (mesh.animated.list.empty()) return channels;
  const PropertyMesh seen{mesh.animated.faces, mesh.coded.order, mesh.pyramid ? &mesh.shape : nullptr};
  const std::vector<std::uint32_t> partner = pair_edges(seen.faces, seen.vertex_count());
  for (std::size_t a = 0; a < mesh.animated.list.size(); ++a) {
    const AnimatedAttribute& attribute = mesh.animated.list[a];
    std::vector<AttributeValues> frames;
    for (std::size_t f = first; f < first + count; ++f) frames.emplace_back(input.values[f][a]);
    AnimatedCoder coder(seen, partner, attribute, grid_over(attribute.grid, frames));
    EncodedChannel channel{channel_of_attribute(attribute.number), {}, 0};
    Hasher digest;
    ByteWriter steps;
    write_steps(steps, coder.grid());
    digest.update(std::span<const std::uint8_t>(steps.take()));
    for (const AttributeValues values : frames) {
      coder.next();
      put_in_order(integers_of(values, coder.grid()), attribute, mesh, coder);
      digest.update(std::span<const std::int32_t>(coder.integers()));
      channel.pieces.push_back(code_frame(coder));
    }
    channel.digest = digest.value();
    channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace tvg
