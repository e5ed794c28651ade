#include "c_api/decoder_handle.hpp"
#include "c_api/support.hpp"

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/normals.hpp>
#include <tvg/tvg.h>

// The C interface: tvg::Decoder, with every call checked for whether it means anything now. Nothing throws
// out of here.

namespace {

using tvg::Decoder;
using tvg::c_api::code_of;
using tvg::c_api::fail;
using tvg::c_api::fits;
using tvg::c_api::give;
using tvg::c_api::guarded;

static_assert(TVG_TAIL_BYTES == tvg::kTailBytes);

tvg_event event_of(tvg_decoder& handle, Decoder::Event event) {
  const Decoder& decoder = handle.decoder;
  switch (event) {
    case Decoder::Event::kHead:
      handle.has_head = true;
      return TVG_EVENT_HEAD;
    case Decoder::Event::kMetadata:
      return TVG_EVENT_METADATA;
    case Decoder::Event::kData:
      handle.data_name = decoder.data().name;
      handle.has_data = true;
      return TVG_EVENT_DATA;
    case Decoder::Event::kMesh:
      handle.has_mesh = true;
      handle.has_gop = false;
      handle.view.reset();
      return TVG_EVENT_MESH;
    case Decoder::Event::kGop:
      handle.has_gop = true;
      return TVG_EVENT_GOP;
    case Decoder::Event::kFrame:
      handle.has_gop = true;
      handle.has_frame = true;
      return TVG_EVENT_FRAME;
    case Decoder::Event::kDamage:
      handle.has_damage = true;
      handle.has_gop = false;  // the one that is lost may have been begun, and is not told of
      handle.damage_text = decoder.damage().error.describe();
      return TVG_EVENT_DAMAGE;
    case Decoder::Event::kEnd:
      return TVG_EVENT_END;
    case Decoder::Event::kError:
      handle.has_gop = false;  // it may have been cut short
      fail(handle, decoder.error());
      return TVG_EVENT_ERROR;
    default:
      return TVG_EVENT_NEED_BYTES;
  }
}

}  // namespace

uint32_t tvg_version(void) {
  return TVG_VERSION;
}

const char* tvg_code_name(int code) {
  if (code == TVG_OK) return "ok";
  return tvg::error_name(static_cast<tvg::ErrorCode>(code));
}

tvg_code tvg_limits_init(tvg_limits* limits) {
  const tvg::DecoderLimits defaults;
  return give<tvg_limits>({sizeof(tvg_limits), defaults.vertices, defaults.faces, defaults.frames_per_gop,
                           defaults.packet_bytes, defaults.memory, defaults.meshes, defaults.mesh_bytes,
                           defaults.plan_bytes, defaults.components, defaults.plans, defaults.property_bytes},
                          limits);
}

tvg_decoder* tvg_decoder_create(const tvg_limits* limits) {
  tvg_limits known = {};
  known.struct_size = sizeof known;
  tvg_limits_init(&known);
  if (limits != nullptr) {
    if (limits->struct_size < sizeof(std::size_t)) return nullptr;
    std::memcpy(&known, limits, std::min(limits->struct_size, sizeof known));
  }
  try {
    return new tvg_decoder(tvg::DecoderLimits{
        known.vertices, known.faces, known.frames_per_gop, known.packet_bytes, known.meshes, known.mesh_bytes,
        known.memory_bytes, known.plan_bytes, known.components, known.plans, known.property_bytes});
  } catch (const std::exception&) {
    return nullptr;
  }
}

void tvg_decoder_destroy(tvg_decoder* decoder) {
  delete decoder;
}

tvg_code tvg_decoder_push(tvg_decoder* decoder, const void* bytes, size_t size) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (bytes == nullptr && size > 0)
    return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT, "there are no bytes at null");
  decoder->has_data = false;
  if (size > 0) decoder->decoder.push({static_cast<const std::uint8_t*>(bytes), size});
  return TVG_OK;
}

tvg_code tvg_decoder_finish(tvg_decoder* decoder) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.finish();
  return TVG_OK;
}

tvg_event tvg_decoder_poll(tvg_decoder* decoder) {
  if (decoder == nullptr) return TVG_EVENT_ERROR;
  decoder->has_frame = false;
  decoder->has_damage = false;
  decoder->has_data = false;
  try {
    for (;;) {
      const Decoder::Event event = decoder->decoder.poll();
      if (event != Decoder::Event::kChunk) return event_of(*decoder, event);
    }
  } catch (const std::exception&) {
    fail(*decoder, TVG_ERROR_OUT_OF_MEMORY, "out of memory");
    return TVG_EVENT_ERROR;
  }
}

tvg_code tvg_decoder_get_stream(const tvg_decoder* decoder, tvg_stream_info* stream) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_head) return TVG_ERROR_WRONG_STATE;
  const tvg::StreamHead& head = decoder->decoder.head();
  return give<tvg_stream_info>(
      {sizeof(tvg_stream_info), head.major, head.minor, head.limits.vertices, head.limits.faces,
       head.limits.frames_per_gop, head.limits.decoder_memory, decoder->frame_count, head.limits.meshes},
      stream);
}

const char* tvg_decoder_metadata(const tvg_decoder* decoder, const char* key) {
  if (decoder == nullptr || key == nullptr) return nullptr;
  const tvg::Metadata& metadata = decoder->decoder.metadata();
  const auto entry = std::find_if(metadata.begin(), metadata.end(),
                                  [key](const auto& candidate) { return candidate.first == key; });
  return entry == metadata.end() ? nullptr : entry->second.c_str();
}

const char* tvg_decoder_metadata_key(const tvg_decoder* decoder, size_t index) {
  if (decoder == nullptr || index >= decoder->decoder.metadata().size()) return nullptr;
  return std::next(decoder->decoder.metadata().begin(), static_cast<std::ptrdiff_t>(index))->first.c_str();
}

tvg_code tvg_decoder_get_mesh(const tvg_decoder* decoder, tvg_mesh_info* mesh) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_mesh) return TVG_ERROR_WRONG_STATE;
  const tvg::Mesh& decoded = decoder->decoder.mesh();
  return give<tvg_mesh_info>(
      {sizeof(tvg_mesh_info), decoded.vertex_count, static_cast<std::uint32_t>(decoded.faces.size()),
       decoded.faces.empty() ? nullptr : decoded.faces.front().data(), decoder->decoder.lod_count(),
       decoder->decoder.mesh_info().lod},
      mesh);
}

tvg_code tvg_decoder_get_gop(const tvg_decoder* decoder, tvg_gop_info* gop) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_gop) return TVG_ERROR_WRONG_STATE;
  const tvg::GopInfo& info = decoder->decoder.gop();
  const double ratio = static_cast<double>(std::uint32_t{1} << (info.fine_bits - info.coarse_bits));
  return give<tvg_gop_info>(
      {sizeof(tvg_gop_info), info.first_frame, info.source_frame, info.frame_count, info.flagged, info.step,
       info.step * ratio, static_cast<std::uint32_t>(info.mode), info.components},
      gop);
}

tvg_code tvg_decoder_copy_flags(const tvg_decoder* decoder, uint8_t* flags, size_t size) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_gop) return TVG_ERROR_WRONG_STATE;
  const std::size_t vertex_count = decoder->decoder.mesh().vertex_count;
  if (flags == nullptr || size < vertex_count) return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.copy_flags({flags, vertex_count});
  return TVG_OK;
}

tvg_code tvg_decoder_get_frame(const tvg_decoder* decoder, tvg_frame_info* frame) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_frame) return TVG_ERROR_WRONG_STATE;
  return give<tvg_frame_info>(
      {sizeof(tvg_frame_info), decoder->decoder.frame_number(), decoder->decoder.frame_bytes(),
       static_cast<std::uint32_t>(decoder->decoder.frame_predictor())},
      frame);
}

tvg_code tvg_decoder_copy_positions(const tvg_decoder* decoder, void* positions, size_t size, size_t stride) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_frame) return TVG_ERROR_WRONG_STATE;
  if (!fits(decoder->decoder.mesh().vertex_count, positions, size, stride)) return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.copy_positions(positions, stride);
  return TVG_OK;
}

tvg_code tvg_decoder_compute_normals(tvg_decoder* decoder, void* normals, size_t size, size_t stride) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_frame) return fail(*decoder, TVG_ERROR_WRONG_STATE, "there is no frame now");
  const tvg::Mesh& mesh = decoder->decoder.mesh();
  if (!fits(mesh.vertex_count, normals, size, stride)) {
    return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT,
                "the buffer for normals is too small, or the stride below 12");
  }
  return guarded(*decoder, [&] {
    decoder->find_normals();
    auto* const target = static_cast<std::byte*>(normals);
    for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
      std::memcpy(target + stride * v, decoder->normals.data() + 3 * v, 12);
    }
    return TVG_OK;
  });
}

tvg_code tvg_decoder_get_damage(const tvg_decoder* decoder, tvg_damage_info* damage) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_damage) return TVG_ERROR_WRONG_STATE;
  const tvg::Damage& info = decoder->decoder.damage();
  return give<tvg_damage_info>(
      {sizeof(tvg_damage_info), info.first_frame, info.frame_count, code_of(info.error),
       info.error.byte_offset.value_or(TVG_UNKNOWN), decoder->damage_text.c_str()},
      damage);
}

tvg_code tvg_locate_index(const void* tail, size_t tail_size, uint64_t stream_bytes, uint64_t* index_offset,
                          uint64_t* index_bytes) {
  if (tail == nullptr || tail_size != TVG_TAIL_BYTES || index_offset == nullptr || index_bytes == nullptr) {
    return TVG_ERROR_INVALID_ARGUMENT;
  }
  try {
    const tvg::Result<tvg::ByteRange> range =
        tvg::locate_index({static_cast<const std::uint8_t*>(tail), tail_size}, stream_bytes);
    if (!range) return code_of(range.error());
    *index_offset = range->offset;
    *index_bytes = range->size;
    return TVG_OK;
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}

tvg_code tvg_decoder_load_index(tvg_decoder* decoder, const void* bytes, size_t size) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (bytes == nullptr) return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT, "there are no bytes at null");
  return guarded(*decoder, [&] {
    const tvg::Result<std::vector<tvg::IndexEntry>> index =
        tvg::parse_index({static_cast<const std::uint8_t*>(bytes), size});
    if (!index) return fail(*decoder, index.error());
    decoder->decoder.set_index(*index);
    decoder->frame_count = tvg::count_frames(*index);
    return TVG_OK;
  });
}

tvg_code tvg_decoder_seek(tvg_decoder* decoder, uint64_t frame, uint64_t* offset) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (offset == nullptr) return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT, "there is no room for the offset");
  if (!decoder->has_head) {
    return fail(*decoder, TVG_ERROR_WRONG_STATE, "the head of the stream has not been read yet");
  }
  return guarded(*decoder, [&] {
    const tvg::Result<std::uint64_t> result = decoder->decoder.seek(frame);
    if (!result) return fail(*decoder, result.error());
    decoder->has_frame = false;
    decoder->has_gop = false;
    decoder->has_data = false;
    *offset = *result;
    return TVG_OK;
  });
}

uint64_t tvg_decoder_skip(tvg_decoder* decoder) {
  return decoder == nullptr ? 0 : decoder->decoder.skip();
}

tvg_code tvg_decoder_use_components(tvg_decoder* decoder, uint32_t most) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.use_components(most);
  return TVG_OK;
}

tvg_code tvg_decoder_use_lod(tvg_decoder* decoder, uint32_t lod) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.use_lod(lod);
  return TVG_OK;
}

const char* tvg_decoder_error_text(const tvg_decoder* decoder) {
  return decoder == nullptr ? "there is no decoder at null" : decoder->error_text.c_str();
}

tvg_code tvg_decoder_error_code(const tvg_decoder* decoder) {
  return decoder == nullptr ? TVG_ERROR_INVALID_ARGUMENT : decoder->error_code;
}
