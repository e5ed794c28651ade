#include "player/playback/stream_loader.hpp"
#include "tool/frame_times.hpp"

#include <algorithm>
#include <utility>

#include <tvg/data.hpp>

// What the loader keeps beside frames: the mesh, how it looks, and times.
namespace tvg::player {

namespace {

// Frames that may be held outside the ring: the one being made, the one shown, and two that the window still
// compares it with.
constexpr std::size_t kFramesOutside = 4;

}  // namespace

void StreamLoader::take_data() {
  if (decoder_->data().name == "times") {
    const Result<NamedData> data = unpack_data(decoder_->data());
    const std::lock_guard lock(mutex_);
    if (data) state_.times = cli::times_from(data->bytes);
    return;
  }
  if (!options_.surfaces || has_materials_ || !ShownMaterials::wants(decoder_->data().name)) return;
  if (Result<NamedData> data = unpack_data(decoder_->data())) materials_.take(*std::move(data));
}

void StreamLoader::begin_mesh() {
  if (options_.surfaces) {
    if (!std::exchange(has_materials_, true)) materials_.make(options_.folder);
    surface_ = make_surface(decoder_->mesh(), decoder_->properties(), materials_);
  }
  const std::lock_guard lock(mutex_);
  if (state_.mesh && *state_.mesh == decoder_->mesh()) return;
  state_.mesh = std::make_shared<const Mesh>(decoder_->mesh());
  state_.lod = decoder_->mesh_info().lod;
  state_.lods = decoder_->lod_count();
  fit_ring(state_.mesh->vertex_count);
}

/// As many frames as fit the bytes allowed: positions, normals and values of each, and its colours.
void StreamLoader::fit_ring(std::size_t vertices) {
  std::uint64_t numbers = 7 * std::max<std::uint64_t>(vertices, 1);
  if (surface_ != nullptr && surface_->frame_colours)
    numbers += decoder_->properties().attributes[surface_->frame_colours->attribute].values.size();
  const std::uint64_t frame_bytes = numbers * sizeof(float);
  const std::uint64_t fitting = std::max<std::uint64_t>(options_.ring_bytes / frame_bytes, 2);
  ring_.set_capacity(static_cast<std::size_t>(
      std::min<std::uint64_t>(std::max<std::size_t>(options_.ring_frames, 2), fitting)));
  pool_.drop_free();
  pool_.set_limit(ring_.capacity() + kFramesOutside);
}

}  // namespace tvg::player
