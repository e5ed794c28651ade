#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <tvg/tvg.h>

namespace tvg {

/// The C interface (tvg.h) with an owner: needs that header and the shared library only, and C++17. What each
/// function does, when it may be called and how long what it gives is valid, tvg.h says. Nothing throws, but
/// for std::string's own want of memory.
class StreamDecoder {
 public:
  /// With limits other than the usual: tvg_limits_init() first, then set what differs.
  explicit StreamDecoder(const tvg_limits* limits = nullptr) : handle_(tvg_decoder_create(limits)) {}

  /// False where memory was too short to make a decoder.
  explicit operator bool() const { return handle_ != nullptr; }

  tvg_code push(const void* bytes, std::size_t size) { return tvg_decoder_push(get(), bytes, size); }
  tvg_code finish() { return tvg_decoder_finish(get()); }
  tvg_event poll() { return tvg_decoder_poll(get()); }

  /// What is there now; nothing where it is not there yet, or not any more.
  std::optional<tvg_stream_info> stream() const { return read<tvg_stream_info>(tvg_decoder_get_stream); }
  std::optional<tvg_mesh_info> mesh() const { return read<tvg_mesh_info>(tvg_decoder_get_mesh); }
  std::optional<tvg_gop_info> gop() const { return read<tvg_gop_info>(tvg_decoder_get_gop); }
  std::optional<tvg_frame_info> frame() const { return read<tvg_frame_info>(tvg_decoder_get_frame); }
  std::optional<tvg_damage_info> damage() const { return read<tvg_damage_info>(tvg_decoder_get_damage); }

  std::optional<std::string> metadata(const char* key) const {
    const char* const value = tvg_decoder_metadata(get(), key);
    return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
  }

  /// The frame, [vertex][xyz], into `count` floats, at least 3 * vertex_count.
  tvg_code copy_positions(float* positions, std::size_t count) const {
    return tvg_decoder_copy_positions(get(), positions, count * sizeof(float), 3 * sizeof(float));
  }
  tvg_code compute_normals(float* normals, std::size_t count) {
    return tvg_decoder_compute_normals(get(), normals, count * sizeof(float), 3 * sizeof(float));
  }
  tvg_code copy_flags(std::uint8_t* flags, std::size_t count) const {
    return tvg_decoder_copy_flags(get(), flags, count);
  }

  /// What the mesh has beside its connectivity (tvg_properties.h); nothing where it is not there.
  std::optional<tvg_properties_info> properties() const {
    return read<tvg_properties_info>(tvg_decoder_get_properties);
  }
  std::optional<tvg_attribute_info> attribute(std::uint32_t attribute) const {
    return read<tvg_attribute_info>(tvg_decoder_get_attribute, attribute);
  }
  std::optional<tvg_part_info> part(std::uint32_t part) const {
    return read<tvg_part_info>(tvg_decoder_get_part, part);
  }
  /// [value][component], into `count` floats.
  tvg_code copy_attribute(std::uint32_t attribute, float* values, std::size_t count) const {
    return tvg_decoder_copy_attribute(get(), attribute, values, count * sizeof(float), row_of(attribute));
  }
  tvg_code copy_corners(std::uint32_t attribute, std::uint32_t* corners, std::size_t count) const {
    return tvg_decoder_copy_corners(get(), attribute, corners, count);
  }
  tvg_code copy_face_parts(std::uint32_t* parts, std::size_t count) const {
    return tvg_decoder_copy_face_parts(get(), parts, count);
  }
  tvg_code copy_polygons(tvg_polygon* polygons, std::size_t count) const {
    return tvg_decoder_copy_polygons(get(), polygons, count);
  }

  /// The mesh as graphics hardware draws it; the first call after a mesh makes it.
  std::optional<tvg_view_info> view() {
    tvg_view_info info = {};
    info.struct_size = sizeof info;
    if (tvg_decoder_get_view(get(), &info) != TVG_OK) return std::nullopt;
    return info;
  }
  std::optional<tvg_view_range> view_range(std::uint32_t part) const {
    return read<tvg_view_range>(tvg_decoder_get_view_range, part);
  }
  /// [render vertex][xyz], into `count` floats.
  tvg_code copy_view_positions(float* positions, std::size_t count) {
    return tvg_decoder_copy_view_positions(get(), positions, count * sizeof(float), 3 * sizeof(float));
  }
  tvg_code compute_view_normals(float* normals, std::size_t count) {
    return tvg_decoder_compute_view_normals(get(), normals, count * sizeof(float), 3 * sizeof(float));
  }
  /// [render vertex][component], into `count` floats.
  tvg_code copy_view_attribute(std::uint32_t attribute, float* values, std::size_t count) const {
    return tvg_decoder_copy_view_attribute(get(), attribute, values, count * sizeof(float),
                                           row_of(attribute));
  }

  /// The planes of the GOP (tvg_basis.h); nothing where it is in another mode.
  std::optional<tvg_basis_info> basis() const { return read<tvg_basis_info>(tvg_decoder_get_basis); }
  /// [vertex][4], into `count` numbers.
  tvg_code copy_planes(std::uint32_t group, float* coefficients, std::size_t count) const {
    return tvg_decoder_copy_planes(get(), group, coefficients, count);
  }
  tvg_code copy_short_planes(std::uint32_t group, std::int16_t* coefficients, std::size_t count) const {
    return tvg_decoder_copy_short_planes(get(), group, coefficients, count);
  }
  /// [1 + component][xyz], into `count` floats.
  tvg_code copy_rows(float* rows, std::size_t count) const {
    return tvg_decoder_copy_rows(get(), rows, count);
  }

  /// Free-form data, with TVG_EVENT_DATA.
  std::optional<tvg_data_info> data() const { return read<tvg_data_info>(tvg_decoder_get_data); }
  tvg_code copy_data(void* bytes, std::size_t size) { return tvg_decoder_copy_data(get(), bytes, size); }

  tvg_code load_index(const void* bytes, std::size_t size) {
    return tvg_decoder_load_index(get(), bytes, size);
  }
  /// The offset at which the bytes pushed from now on begin; nothing where there is no such frame.
  std::optional<std::uint64_t> seek(std::uint64_t frame) {
    std::uint64_t offset = 0;
    if (tvg_decoder_seek(get(), frame, &offset) != TVG_OK) return std::nullopt;
    return offset;
  }
  std::uint64_t skip() { return tvg_decoder_skip(get()); }

  tvg_code use_components(std::uint32_t most) { return tvg_decoder_use_components(get(), most); }

  tvg_code use_lod(std::uint32_t lod) { return tvg_decoder_use_lod(get(), lod); }

  std::string error_text() const { return tvg_decoder_error_text(get()); }
  tvg_code error_code() const { return tvg_decoder_error_code(get()); }

  /// The handle, for calls that are not here; it stays this object's.
  tvg_decoder* get() const { return handle_.get(); }

 private:
  struct Destroy {
    void operator()(tvg_decoder* handle) const { tvg_decoder_destroy(handle); }
  };

  /// Bytes of a value.
  std::size_t row_of(std::uint32_t number) const {
    const std::optional<tvg_attribute_info> info = attribute(number);
    return info ? info->components * sizeof(float) : 0;
  }

  template <class Info>
  std::optional<Info> read(tvg_code (*function)(const tvg_decoder*, std::uint32_t, Info*),
                           std::uint32_t number) const {
    Info info = {};
    info.struct_size = sizeof info;
    if (function(get(), number, &info) != TVG_OK) return std::nullopt;
    return info;
  }
  template <class Info>
  std::optional<Info> read(tvg_code (*function)(const tvg_decoder*, Info*)) const {
    Info info = {};
    info.struct_size = sizeof info;
    if (function(get(), &info) != TVG_OK) return std::nullopt;
    return info;
  }

  std::unique_ptr<tvg_decoder, Destroy> handle_;
};

}  // namespace tvg
