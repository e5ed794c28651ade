#include "tool/decode_ahead.hpp"

#include "tool/stream_reader.hpp"

#include <algorithm>
#include <utility>

namespace tvg::cli {

/// One decoder of the file, which goes from GOP to GOP.
class DecodeAhead::Worker {
 public:
  Worker(const std::string& path, std::uint32_t components) : reader_(path) {
    reader_.decoder().use_components(components);
  }

  DecodedGop decode(const StreamMap::Place& place, std::uint64_t mesh_offset) {
    DecodedGop gop{.first_frame = place.first_frame,
                   .mesh_offset = mesh_offset,
                   .mesh = {},
                   .properties = {},
                   .frames = {},
                   .values = {}};
    if (!begin()) return gop;
    reader_.seek(gop.first_frame);
    gop.whole = read_frames(gop, place.entry.frame_count);
    gop.mesh = mesh_;
    gop.properties = properties_;
    return gop;
  }

 private:
  /// Reads the head and the index, the first time.
  bool begin() {
    if (begun_) return true;
    if (!reader_.read_index()) return false;
    for (;;) {
      switch (reader_.next()) {
        case Decoder::Event::kHead:
          return begun_ = true;
        case Decoder::Event::kDamage:
        case Decoder::Event::kEnd:
        case Decoder::Event::kError:
          return false;
        default:
          break;
      }
    }
  }

  /// Up to the next GOP or the stream's end: what lies between is checked by then.
  bool read_frames(DecodedGop& gop, std::uint64_t frame_count) {
    const Decoder& decoder = reader_.decoder();
    const std::uint64_t end = gop.first_frame + frame_count;
    for (;;) {
      switch (reader_.next()) {
        case Decoder::Event::kGop:
          if (decoder.gop().first_frame >= end) return gop.frames.size() == frame_count;
          break;
        case Decoder::Event::kFrame:
          if (decoder.frame_number() != gop.first_frame + gop.frames.size()) return false;
          if (gop.frames.empty()) take_mesh(gop.mesh_offset);
          decoder.copy_positions(
              gop.frames.emplace_back(3 * std::size_t{decoder.mesh().vertex_count}).data());
          gop.values.emplace_back(decoder);
          break;
        case Decoder::Event::kEnd:
          return gop.frames.size() == frame_count;
        case Decoder::Event::kDamage:
        case Decoder::Event::kError:
          return false;
        default:
          break;
      }
    }
  }

  /// While the GOP's first frame is there: behind its last one the decoder may have the next mesh.
  void take_mesh(std::uint64_t offset) {
    if (mesh_ != nullptr && offset == mesh_offset_) return;
    mesh_ = std::make_shared<const Mesh>(reader_.decoder().mesh());
    properties_ = std::make_shared<const MeshProperties>(reader_.decoder().properties());
    mesh_offset_ = offset;
  }

  StreamReader reader_;
  bool begun_ = false;
  std::shared_ptr<const Mesh> mesh_;  ///< of the GOP decoded last
  std::shared_ptr<const MeshProperties> properties_;
  std::uint64_t mesh_offset_ = 0;
};

DecodeAhead::DecodeAhead(std::string path, StreamMap map, const FrameRange& frames, unsigned threads,
                         std::uint32_t components)
    : path_(std::move(path)), map_(std::move(map)), last_frame_(frames.last) {
  const auto holds_later_frames = [&](const StreamMap::Place& place) {
    return place.end_frame() > frames.first;
  };
  const auto places = map_.places();
  next_place_ = static_cast<std::size_t>(std::find_if(places.begin(), places.end(), holds_later_frames) -
                                         places.begin());
  for (unsigned i = 0; i < threads; ++i) idle_.push_back(std::make_unique<Worker>(path_, components));
  for (unsigned i = 0; i < threads; ++i) start_next();
}

DecodeAhead::~DecodeAhead() = default;

void DecodeAhead::start_next() {
  const auto places = map_.places();
  while (next_place_ < places.size() && !places[next_place_].entry.is_gop()) ++next_place_;
  if (next_place_ == places.size() || places[next_place_].first_frame > last_frame_) return;
  const StreamMap::Place& place = places[next_place_++];
  std::unique_ptr<Worker> worker = std::move(idle_.back());
  idle_.pop_back();
  Worker& decoder = *worker;
  pending_.push_back({std::move(worker), std::async(std::launch::async, [&decoder, place] {
                        return decoder.decode(place, place.mesh_offset.value_or(0));
                      })});
}

std::optional<DecodedGop> DecodeAhead::next() {
  if (pending_.empty()) return std::nullopt;
  Pending oldest = std::move(pending_.front());
  pending_.pop_front();
  DecodedGop gop = oldest.gop.get();
  idle_.push_back(std::move(oldest.worker));
  start_next();
  return gop;
}

}  // namespace tvg::cli
