#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <tvg/tvg.h>

namespace tvg {

/// The encoder of the C interface (tvg.h) with an owner: needs that header and the shared library only, and
/// C++17. What each function does, when it may be called and what is left after it fails, tvg.h says. Nothing
/// throws, but for want of memory for the sink and for std::string.
class StreamEncoder {
 public:
  /// Takes the next bytes of the stream, which are valid during the call; to return false gives up. It must
  /// neither throw nor call the encoder that calls it.
  using Sink = std::function<bool(const void* bytes, std::size_t size)>;

  /// With options other than the usual: tvg_encoder_options_init() first, then set what differs.
  explicit StreamEncoder(Sink sink, const tvg_encoder_options* options = nullptr)
      : sink_(std::make_unique<Sink>(std::move(sink))) {
    tvg_encoder* made = nullptr;
    tvg_encoder_create(options, take, sink_.get(), &made);
    handle_.reset(made);
  }

  /// False where memory was too short to make an encoder.
  explicit operator bool() const { return handle_ != nullptr; }

  tvg_code set_metadata(const char* key, const char* value) {
    return tvg_encoder_set_metadata(get(), key, value);
  }
  /// What the mesh that comes next has beside its connectivity (tvg_properties.h).
  tvg_code add_attribute(const tvg_attribute& attribute) {
    return tvg_encoder_add_attribute(get(), &attribute);
  }
  /// [value][component], `count` floats, for the frame that comes next.
  tvg_code set_values(std::uint32_t attribute, const float* values, std::size_t count,
                      std::uint32_t components) {
    const std::size_t values_given = components == 0 ? 0 : count / components;
    return tvg_encoder_set_values(get(), attribute, values, static_cast<std::uint32_t>(values_given),
                                  components * sizeof(float));
  }
  tvg_code add_part(const char* object, const char* group, const char* material) {
    const tvg_part_info part = {sizeof part, object, group, material};
    return tvg_encoder_add_part(get(), &part);
  }
  tvg_code set_face_parts(const std::uint32_t* parts, std::size_t face_count) {
    return tvg_encoder_set_face_parts(get(), parts, face_count);
  }
  tvg_code set_polygons(const tvg_polygon* polygons, std::size_t count) {
    return tvg_encoder_set_polygons(get(), polygons, count);
  }
  tvg_code clear_properties() { return tvg_encoder_clear_properties(get()); }
  /// Before the first mesh.
  tvg_code add_data(const char* name, const void* bytes, std::size_t size) {
    return tvg_encoder_add_data(get(), name, bytes, size);
  }
  /// `faces`: [face][corner].
  tvg_code set_mesh(std::uint32_t vertex_count, const std::uint32_t* faces, std::uint32_t face_count) {
    return tvg_encoder_set_mesh(get(), vertex_count, faces, face_count);
  }
  /// The next frame, [vertex][xyz], of `count` floats, at least 3 * vertex_count.
  tvg_code add_frame(const float* positions, std::size_t count) {
    return tvg_encoder_add_frame(get(), positions, count * sizeof(float), 3 * sizeof(float));
  }
  /// Ends the stream: what was encoded; nothing where that fails.
  std::optional<tvg_encode_report> finish() {
    tvg_encode_report report = {};
    report.struct_size = sizeof report;
    if (tvg_encoder_finish(get(), &report) != TVG_OK) return std::nullopt;
    return report;
  }

  std::string error_text() const { return tvg_encoder_error_text(get()); }

  /// The handle, for calls that are not here; it stays this object's.
  tvg_encoder* get() const { return handle_.get(); }

 private:
  struct Destroy {
    void operator()(tvg_encoder* handle) const { tvg_encoder_destroy(handle); }
  };

  static int take(void* user, const void* bytes, std::size_t size) {
    return (*static_cast<Sink*>(user))(bytes, size) ? 0 : 1;
  }

  std::unique_ptr<Sink> sink_;  ///< stays where it is when this object moves
  std::unique_ptr<tvg_encoder, Destroy> handle_;
};

}  // namespace tvg
