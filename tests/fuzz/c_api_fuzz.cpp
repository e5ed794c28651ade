#include "corruption/repair.hpp"
#include "fuzz/require.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <vector>

#include <tvg/stream_decoder.hpp>

// The C interface called in any order, with any split of the bytes, on any bytes.
namespace {

using tvg::fuzz::require;

tvg_limits small_limits() {
  tvg_limits limits = {};
  limits.struct_size = sizeof limits;
  tvg_limits_init(&limits);
  limits.vertices = 1u << 12;
  limits.faces = 1u << 13;
  limits.meshes = 8;
  limits.memory_bytes = 64u << 20;
  return limits;
}

/// A decoder and the stream it is fed with, told what to do a byte at a time.
class Session {
 public:
  explicit Session(std::span<const std::uint8_t> stream)
      : limits_(small_limits()), decoder_(&limits_), stream_(stream) {
    require(static_cast<bool>(decoder_));
  }

  /// Does what `call` says. The order of the cases is part of the corpus's meaning.
  void act(std::uint8_t call) {
    const std::size_t amount = call >> 3;
    switch (call & 7) {
      case 0:
        push(amount);
        break;
      case 1:
        push(amount * 64);
        break;
      case 2:
        if (amount == 31) decoder_.finish(), plain_ = false;
        if (amount >= 24 && amount < 31)
          decoder_.use_components(static_cast<std::uint32_t>(amount - 24)), plain_ = false;
        if (amount >= 20 && amount < 24)
          decoder_.use_lod(static_cast<std::uint32_t>(amount - 20)), plain_ = false;
        break;
      case 3:
        if (const auto offset = decoder_.seek(amount)) at_ = *offset, plain_ = false;
        break;
      case 4:
        at_ += decoder_.skip();
        break;
      case 5:
        load_index();
        break;
      default:
        use(decoder_.poll());
    }
    look();
  }

  /// Pushes what is left and polls to the end. A decoder that never ends would hang here.
  void run_out() {
    for (;;) {
      const tvg_event event = decoder_.poll();
      if (use(event)) return;
      if (event != TVG_EVENT_NEED_BYTES) continue;
      if (at_ >= stream_.size()) decoder_.finish();
      push(stream_.size());
    }
  }

  /// Whether the bytes went in as they stand and nothing else was said.
  bool plain() const { return plain_; }
  const std::map<std::uint64_t, std::vector<float>>& frames() const { return frames_; }

 private:
  void push(std::size_t size) {
    const std::size_t from = static_cast<std::size_t>(std::min<std::uint64_t>(at_, stream_.size()));
    const std::size_t count = std::min(size, stream_.size() - from);
    // An exact copy, so that a read behind its end is seen.
    const std::vector<std::uint8_t> piece(stream_.begin() + static_cast<std::ptrdiff_t>(from),
                                          stream_.begin() + static_cast<std::ptrdiff_t>(from + count));
    decoder_.push(piece.data(), piece.size());
    at_ += count;
  }

  /// True when nothing more comes.
  bool use(tvg_event event) {
    if (event == TVG_EVENT_FRAME) {
      const auto mesh = decoder_.mesh();
      const auto frame = decoder_.frame();
      require(mesh && frame && mesh->vertex_count <= limits_.vertices);
      std::vector<float> positions(3 * std::size_t{mesh->vertex_count}), normals(positions.size());
      std::vector<std::uint8_t> flags(mesh->vertex_count);
      require(decoder_.copy_positions(positions.data(), positions.size()) == TVG_OK);
      require(decoder_.compute_normals(normals.data(), normals.size()) == TVG_OK);
      require(decoder_.copy_flags(flags.data(), flags.size()) == TVG_OK);
      frames_.insert_or_assign(frame->number, std::move(positions));
    }
    if (event == TVG_EVENT_MESH) use_properties(false);
    if (event == TVG_EVENT_FRAME) use_properties(true);
    if (event == TVG_EVENT_FRAME) use_view();
    if (event == TVG_EVENT_FRAME) use_basis();
    if (event == TVG_EVENT_DATA) use_data();
    if (event == TVG_EVENT_ERROR) require(decoder_.error_code() != TVG_OK && !decoder_.error_text().empty());
    if (event == TVG_EVENT_DAMAGE) require(decoder_.damage() && std::strlen(decoder_.damage()->text) > 0);
    return event == TVG_EVENT_END || event == TVG_EVENT_ERROR;
  }

  /// Whatever the mesh has can be had, and refers to nothing that is not there.
  void use_properties(bool in_frame) {
    const auto mesh = decoder_.mesh();
    const auto properties = decoder_.properties();
    require(mesh && properties);
    std::vector<std::uint32_t> corners(3 * std::size_t{mesh->face_count}), parts(mesh->face_count);
    for (std::uint32_t i = 0; i < properties->attribute_count; ++i) {
      const auto attribute = decoder_.attribute(i);
      require(attribute && attribute->components >= 1 && attribute->components <= 4);
      require(decoder_.copy_corners(i, corners.data(), corners.size()) == TVG_OK);
      for (const std::uint32_t corner : corners) require(corner < attribute->value_count);
      if (attribute->animated != 0 && !in_frame) continue;
      std::vector<float> values(std::size_t{attribute->value_count} * attribute->components);
      require(decoder_.copy_attribute(i, values.data(), values.size()) == TVG_OK);
    }
    require(decoder_.copy_face_parts(parts.data(), parts.size()) == TVG_OK);
    for (const std::uint32_t part : parts) require(part < std::max(properties->part_count, 1u));
    for (std::uint32_t i = 0; i < properties->part_count; ++i) require(decoder_.part(i).has_value());
    std::vector<tvg_polygon> polygons(properties->polygon_count);
    require(decoder_.copy_polygons(polygons.data(), polygons.size()) == TVG_OK);
    for (const tvg_polygon& polygon : polygons)
      require(polygon.corner_count >= 4 && polygon.first_face < mesh->face_count &&
              polygon.corner_count - 2 <= mesh->face_count - polygon.first_face);
  }

  /// The view shows every corner of the mesh.
  void use_view() {
    const auto view = decoder_.view();
    const auto mesh = decoder_.mesh();
    require(view && mesh && view->index_count == 3 * mesh->face_count);
    for (std::uint32_t i = 0; i < view->index_count; ++i) {
      require(view->indices[i] < view->vertex_count);
      require(view->source_vertices[view->indices[i]] ==
              mesh->faces[3 * std::size_t{view->source_faces[i / 3]} + i % 3]);
    }
    std::vector<float> rows(4 * std::size_t{view->vertex_count});
    require(decoder_.copy_view_positions(rows.data(), 3 * std::size_t{view->vertex_count}) == TVG_OK);
    require(decoder_.compute_view_normals(rows.data(), 3 * std::size_t{view->vertex_count}) == TVG_OK);
    for (std::uint32_t i = 0; decoder_.attribute(i); ++i)
      require(decoder_.copy_view_attribute(i, rows.data(), rows.size()) == TVG_OK);
  }

  /// Every plane and row can be had.
  void use_basis() {
    const auto basis = decoder_.basis();
    if (!basis) return;
    std::vector<float> room(std::max<std::size_t>(4 * basis->vertex_count, 3 * (1 + basis->component_count)));
    std::vector<std::int16_t> shorts(4 * std::size_t{basis->vertex_count});
    require(decoder_.copy_rows(room.data(), room.size()) == TVG_OK);
    for (std::uint32_t group = 0; 4 * group < basis->component_count; ++group) {
      require(decoder_.copy_planes(group, room.data(), room.size()) == TVG_OK);
      const tvg_code code = decoder_.copy_short_planes(group, shorts.data(), shorts.size());
      require((code == TVG_OK) == (basis->most <= 32767));
    }
  }

  void use_data() {
    const auto data = decoder_.data();
    require(data && std::strlen(data->name) > 0 && data->packed_size <= data->size);
    if (data->size > (1u << 16)) return;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(data->size));
    decoder_.copy_data(bytes.data(), bytes.size());
  }

  /// Everything that can be asked at any time.
  void look() {
    std::vector<float> room(48);
    std::vector<std::uint8_t> flags(16);
    decoder_.copy_positions(room.data(), room.size());
    decoder_.compute_normals(room.data(), room.size());
    decoder_.copy_flags(flags.data(), flags.size());
    (void)decoder_.stream();
    (void)decoder_.gop();
    (void)decoder_.basis();
    decoder_.copy_planes(0, room.data(), room.size());
    decoder_.copy_rows(room.data(), room.size());
    (void)decoder_.frame();
    (void)decoder_.damage();
    (void)decoder_.metadata("fps");
    (void)decoder_.properties();
    (void)decoder_.data();
    decoder_.copy_attribute(0, room.data(), room.size());
    decoder_.copy_view_positions(room.data(), room.size());
    decoder_.copy_view_attribute(0, room.data(), room.size());
    if (const auto mesh = decoder_.mesh()) {
      for (std::size_t i = 0; i < 3 * std::size_t{mesh->face_count}; ++i)
        require(mesh->faces[i] < mesh->vertex_count);
    }
    for (std::size_t i = 0; const char* const key = tvg_decoder_metadata_key(decoder_.get(), i); ++i) {
      require(tvg_decoder_metadata(decoder_.get(), key) != nullptr);
    }
  }

  void load_index() {
    plain_ = false;
    std::uint64_t offset = 0, size = 0;
    if (stream_.size() < TVG_TAIL_BYTES ||
        tvg_locate_index(stream_.data() + stream_.size() - TVG_TAIL_BYTES, TVG_TAIL_BYTES, stream_.size(),
                         &offset, &size) != TVG_OK) {
      return;
    }
    require(offset <= stream_.size() && size <= stream_.size() - offset);
    decoder_.load_index(stream_.data() + offset, static_cast<std::size_t>(size));
  }

  tvg_limits limits_;
  tvg::StreamDecoder decoder_;
  std::span<const std::uint8_t> stream_;
  std::uint64_t at_ = 0;
  bool plain_ = true;
  std::map<std::uint64_t, std::vector<float>> frames_;
};

}  // namespace

/// The input: a byte of options (1: repair lengths, 2: repair checksums), the number of calls, the calls, and
/// a stream. Where nothing was sought, any split gives the same frames.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t calls = std::min<std::size_t>(data[1], size - 2);
  std::vector<std::uint8_t> stream(data + 2 + calls, data + size);
  if ((data[0] & 1) != 0) tvg::corruption::repair_lengths(stream);
  if ((data[0] & 2) != 0) tvg::corruption::repair_checksums(stream);

  Session session(stream);
  for (std::size_t i = 0; i < calls; ++i) session.act(data[2 + i]);
  session.run_out();
  if (!session.plain()) return 0;
  Session whole(stream);
  whole.run_out();
  require(session.frames() == whole.frames());
  return 0;
}
