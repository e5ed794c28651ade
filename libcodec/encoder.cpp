#include "encoder/sequence_encoder.hpp"

#include <memory>
#include <utility>

#include <tvg/encoder.hpp>

namespace tvg {

class Encoder::State : public SequenceEncoder {
 public:
  using SequenceEncoder::SequenceEncoder;
};

Encoder::Encoder(EncodeOptions options, ByteSink sink, EncodeProgress progress)
    : state_(std::make_unique<State>(std::move(options), std::move(sink), std::move(progress))) {}
Encoder::Encoder(Encoder&&) noexcept = default;
Encoder& Encoder::operator=(Encoder&&) noexcept = default;
Encoder::~Encoder() = default;

Status Encoder::set_mesh(const Mesh& mesh, const Skeleton& skeleton, const MeshProperties& properties) {
  return state_->set_mesh(mesh, skeleton, properties);
}

Status Encoder::add_frame(std::span<const float> positions, std::span<const float> joints) {
  return state_->add_frame(positions, joints, {});
}
Status Encoder::add_frame(std::span<const float> positions, std::span<const float> joints,
                          std::span<const std::span<const float>> values) {
  return state_->add_frame(positions, joints, values);
}

Result<EncodeReport> Encoder::finish() {
  return state_->finish();
}

}  // namespace tvg
