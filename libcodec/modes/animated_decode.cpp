#include "modes/animated_decode.hpp"

#include "attributes/attributes.hpp"
#include "base/allocation.hpp"
#include "base/stream_error.hpp"
#include "entropy/range_coder.hpp"

#include <utility>

namespace tvg {

namespace {

constexpr const char* kSection = "§5.7.7";

bool can_allocate_bytes(std::uint64_t bytes) {
  return bytes <= static_cast<std::size_t>(-1) / 2 && can_allocate(static_cast<std::size_t>(bytes));
}

}  // namespace

// format-spec §4.5.1
Status AnimatedDecoder::begin(const Channels& channels, std::shared_ptr<const GopMesh> mesh) {
  list_.clear();
  mesh_ = std::move(mesh);
  const std::vector<AnimatedAttribute>& attributes = mesh_->animated.list;
  if (attributes.empty()) return {};
  if (!try_resize(list_, attributes.size())) return out_of_memory();
  channels_ = channels;
  for (std::size_t i = 0; i < list_.size(); ++i) {
    list_[i].place = channels.find(channel_of_attribute(attributes[i].number));
    if (list_[i].place == Channels::kMost)
      return malformed("§4.5.1", "a GOP lacks the channel of an animated attribute of its mesh");
  }
  seen_.emplace(
      PropertyMesh{mesh_->animated.faces, mesh_->coded.order, mesh_->pyramid ? &mesh_->shape : nullptr});
  partner_ = {};
  if (!can_allocate_bytes(pair_edges_bytes(seen_->faces.size(), seen_->vertex_count())))
    return out_of_memory();
  partner_ = pair_edges(seen_->faces, seen_->vertex_count());
  return {};
}

// format-spec §5.7.7
Status AnimatedDecoder::take(Bytes packet) {
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const Bytes piece = piece_at(channels_, list_[i].place, packet);
    list_[i].bytes = piece.size();
    if (Status status = take_piece(mesh_->animated.list[i], piece, list_[i]); !status.ok()) return status;
  }
  return {};
}

Status AnimatedDecoder::take_piece(const AnimatedAttribute& attribute, Bytes piece, Channel& channel) {
  const bool first = channel.coder == nullptr;
  if (piece.empty()) {
    if (first) return malformed(kSection, "the first values of an animated attribute repeat others");
    channel.coder->next();
    channel.coder->repeat();
    channel.digest.update(std::span<const std::int32_t>(channel.coder->integers()));
    return {};
  }
  ByteReader reader(piece);
  const std::uint8_t predictor = reader.u8();
  if (predictor > static_cast<std::uint8_t>(ValuePredictor::kTime))
    return malformed(kSection, "the values of an animated attribute are predicted in no known way");
  if (first) {
    if (predictor != static_cast<std::uint8_t>(ValuePredictor::kSpace))
      return malformed(kSection, "the first values of an animated attribute are predicted from others");
    AttributeGrid grid = attribute.grid;
    if (const Fault fault = read_steps(reader, grid)) return error_of(fault);
    channel.digest.update(piece.subspan(1, piece.size() - 1 - reader.left()));
    if (Status status = begin_coder(attribute, grid, channel); !status.ok()) return status;
  }
  if (!can_allocate_bytes(AnimatedCoder::working_bytes(attribute.count) + kSmallThings))
    return out_of_memory();
  AnimatedCoder& coder = *channel.coder;
  coder.next();
  RangeDecoder decoder(reader.bytes(reader.left()));
  if (!coder.code(decoder, static_cast<ValuePredictor>(predictor)) || !decoder.finished())
    return malformed(kSection, "the values of an animated attribute are damaged");
  channel.digest.update(std::span<const std::int32_t>(coder.integers()));
  give(attribute, channel);
  return {};
}

Status AnimatedDecoder::begin_coder(const AnimatedAttribute& attribute, const AttributeGrid& grid,
                                    Channel& channel) {
  const std::uint64_t values = attribute.count;
  if (!can_allocate_bytes(AnimatedCoder::bytes(seen_->faces.size(), values, grid.integers()) +
                          4 * values * grid.components))
    return out_of_memory();
  channel.coder = std::make_unique<AnimatedCoder>(*seen_, partner_, attribute, grid);
  channel.values.resize(static_cast<std::size_t>(values) * grid.components);
  return {};
}

void AnimatedDecoder::give(const AnimatedAttribute& attribute, Channel& channel) const {
  const AttributeGrid& grid = channel.coder->grid();
  const std::size_t width = grid.integers();
  const std::span<const std::int32_t> integers = std::as_const(*channel.coder).integers();
  for (std::size_t i = 0; i < attribute.count; ++i) {
    const std::size_t place = attribute.domain == AttributeDomain::kVertex ? mesh_->coded.order[i] : i;
    grid.value_of(integers.subspan(width * i, width),
                  std::span(channel.values).subspan(grid.components * place, grid.components));
  }
}

// format-spec §4.5.3, §7.6
Status AnimatedDecoder::check_digest(Bytes packet) const {
  for (const Channel& channel : list_) {
    if (digest_at(channel.place, packet) != channel.digest.value())
      return stream_error(ErrorCode::kDigestMismatch, "§7.6",
                          {"the GOP's attributes decoded to other values than were encoded"});
  }
  return {};
}

const AnimatedDecoder::Channel* AnimatedDecoder::find(std::size_t attribute) const {
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (mesh_->animated.list[i].number == attribute) return &list_[i];
  }
  return nullptr;
}

std::span<const float> AnimatedDecoder::values(std::size_t attribute) const {
  const Channel* const channel = find(attribute);
  return channel == nullptr ? std::span<const float>() : channel->values;
}

std::uint64_t AnimatedDecoder::bytes(std::size_t attribute) const {
  const Channel* const channel = find(attribute);
  return channel == nullptr ? 0 : channel->bytes;
}

}  // namespace tvg
