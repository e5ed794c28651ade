#pragma once
#include "c_api/support.hpp"

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/normals.hpp>
#include <tvg/render_view.hpp>

/// What a handle stands for.
struct tvg_decoder {
  explicit tvg_decoder(const tvg::DecoderLimits& limits) : decoder(limits) {}

  /// The frame's positions and normals; may throw for want of memory.
  void find_positions() {
    positions.resize(3 * std::size_t{decoder.mesh().vertex_count});
    decoder.copy_positions(positions.data());
  }
  void find_normals() {
    find_positions();
    normals.resize(positions.size());
    tvg::vertex_normals(decoder.mesh().faces, positions, normals);
  }

  tvg::Decoder decoder;
  bool has_head = false;
  bool has_mesh = false;
  bool has_gop = false;
  bool has_frame = false;
  bool has_damage = false;
  bool has_data = false;
  std::uint64_t frame_count = TVG_UNKNOWN;
  std::string damage_text;
  std::string data_name;
  tvg_code error_code = TVG_OK;
  std::string error_text;
  std::vector<float> positions, normals;  ///< [vertex][xyz], once they were asked for
  std::optional<tvg::RenderView> view;    ///< of the mesh, once it was asked for
};

namespace tvg::c_api {

/// Remembers what went wrong and gives its code back.
inline tvg_code fail(tvg_decoder& decoder, tvg_code code, const char* text) {
  decoder.error_code = code;
  try {
    decoder.error_text = text;
  } catch (const std::exception&) {
    decoder.error_text.clear();
  }
  return code;
}

inline tvg_code fail(tvg_decoder& decoder, const Error& error) {
  return fail(decoder, code_of(error), error.describe().c_str());
}

/// Runs what may throw for want of memory.
template <class Work>
tvg_code guarded(tvg_decoder& decoder, Work work) {
  try {
    return work();
  } catch (const std::exception&) {
    return fail(decoder, TVG_ERROR_OUT_OF_MEMORY, "out of memory");
  }
}

}  // namespace tvg::c_api
