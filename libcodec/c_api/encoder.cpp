#include "c_api/comparer_handle.hpp"
#include "c_api/encoder_handle.hpp"
#include "c_api/support.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tvg/encoder.hpp>
#include <tvg/join.hpp>
#include <tvg/metrics.hpp>
#include <tvg/tvg.h>

// The C interface to encoding: tvg::Encoder, SequenceComparison and join(). Nothing throws out of here.

using tvg::c_api::code_of;
using tvg::c_api::fail;
using tvg::c_api::fits;
using tvg::c_api::give;
using tvg::c_api::guarded;
using tvg::c_api::mesh_of;
using tvg::c_api::write_text;

namespace {

tvg::ByteSink sink_of(tvg_sink sink, void* user) {
  return [sink, user](std::span<const std::uint8_t> bytes) {
    if (bytes.empty() || sink(user, bytes.data(), bytes.size()) == 0) return tvg::Status();
    return tvg::Status(tvg::Error{tvg::ErrorCode::kIo, "the sink gave up"});
  };
}

/// Numbers too large for an int are no number of bits either.
int bits_of(std::uint32_t bits) {
  return static_cast<int>(std::min(bits, 1000u));
}

int attribute_bits_of(std::uint32_t given, int usual) {
  if (given == 0) return usual;
  return given == TVG_EXACT_BITS ? tvg::Attribute::kExact : bits_of(given);
}

std::uint32_t bits_in_c(int bits) {
  return bits == tvg::Attribute::kExact ? TVG_EXACT_BITS : static_cast<std::uint32_t>(bits);
}

tvg::EncodeOptions options_of(const tvg_encoder_options& given) {
  tvg::EncodeOptions options;
  options.fine_bits = bits_of(given.fine_bits);
  options.coarse_bits = bits_of(given.coarse_bits);
  if (given.step != 0) options.step = given.step;
  options.importance.share = given.important_share;
  options.importance.low_delay = given.low_delay != 0;
  options.predictor = static_cast<tvg::Predictor>(std::min(given.predictor, 255u));
  options.gop_frames = given.gop_frames;
  options.threads = std::clamp(given.threads, 1u, 256u);
  options.keep_vertex_order = given.reorder == 0;
  options.max_vertices = given.max_vertices;
  options.max_faces = given.max_faces;
  options.max_meshes = std::max(given.max_meshes, 1u);
  options.first_frame = given.first_frame;
  options.mode = static_cast<tvg::Mode>(std::min(given.mode, 255u));
  options.period_frames = given.period_frames;
  if (given.effort != 0) options.effort = static_cast<int>(std::min(given.effort, 1000u));
  if (given.max_error != 0) options.max_error = tvg::ErrorBound{given.max_error, false};
  const tvg::AttributeBits usual;
  options.attribute_bits = {attribute_bits_of(given.texcoord_bits, usual.texcoord),
                            attribute_bits_of(given.normal_bits, usual.normal),
                            attribute_bits_of(given.colour_bits, usual.colour),
                            attribute_bits_of(given.generic_bits, usual.generic)};
  options.max_property_bytes = given.max_property_bytes;
  options.max_animated_frame_bytes = given.max_animated_frame_bytes;
  if (given.has_box != 0) {
    options.box.emplace();
    options.box->extend(given.box_low[0], given.box_low[1], given.box_low[2]);
    options.box->extend(given.box_high[0], given.box_high[1], given.box_high[2]);
  }
  return options;
}

tvg::ByteSource bytes_of(const tvg_stream_bytes& stream) {
  return [bytes = static_cast<const std::uint8_t*>(stream.bytes),
          left = stream.size](std::span<std::uint8_t> target) mutable -> tvg::Result<std::size_t> {
    const std::size_t count = std::min(left, target.size());
    if (count > 0) std::memcpy(target.data(), bytes, count);
    if (count > 0) bytes += count;
    left -= count;
    return count;
  };
}

}  // namespace

tvg_code tvg_encoder_options_init(tvg_encoder_options* options) {
  const tvg::EncodeOptions defaults;
  tvg_encoder_options values = {};
  values.struct_size = sizeof values;
  values.fine_bits = static_cast<std::uint32_t>(defaults.fine_bits);
  values.coarse_bits = static_cast<std::uint32_t>(defaults.coarse_bits);
  values.important_share = defaults.importance.share;
  values.predictor = static_cast<std::uint32_t>(defaults.predictor);
  values.gop_frames = defaults.gop_frames;
  values.threads = defaults.threads;
  values.max_meshes = defaults.max_meshes;
  values.mode = static_cast<std::uint32_t>(defaults.mode);
  values.effort = static_cast<std::uint32_t>(defaults.effort);
  values.texcoord_bits = bits_in_c(defaults.attribute_bits.texcoord);
  values.normal_bits = bits_in_c(defaults.attribute_bits.normal);
  values.colour_bits = bits_in_c(defaults.attribute_bits.colour);
  values.generic_bits = bits_in_c(defaults.attribute_bits.generic);
  return give(values, options);
}

tvg_code tvg_encoder_create(const tvg_encoder_options* options, tvg_sink sink, void* user,
                            tvg_encoder** encoder) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  *encoder = nullptr;
  if (sink == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  tvg_encoder_options known = {};
  known.struct_size = sizeof known;
  tvg_encoder_options_init(&known);
  if (options != nullptr) {
    if (options->struct_size < sizeof(std::size_t)) return TVG_ERROR_INVALID_ARGUMENT;
    std::memcpy(&known, options, std::min(options->struct_size, sizeof known));
  }
  try {
    *encoder = new tvg_encoder{options_of(known), sink_of(sink, user), {}, 0, {}, {}, {}, {}, {}};
    return TVG_OK;
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}

void tvg_encoder_destroy(tvg_encoder* encoder) {
  delete encoder;
}

tvg_code tvg_encoder_set_metadata(tvg_encoder* encoder, const char* key, const char* value) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (key == nullptr || value == nullptr)
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "there is no text at null");
  if (encoder->encoder) return fail(*encoder, TVG_ERROR_WRONG_STATE, "the head is written already");
  return guarded(*encoder, [&] {
    encoder->options.metadata.insert_or_assign(key, value);
    return tvg::Status();
  });
}

tvg_code tvg_encoder_set_mesh(tvg_encoder* encoder, uint32_t vertex_count, const uint32_t* faces,
                              uint32_t face_count) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (faces == nullptr && face_count > 0)
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "there are no faces at null");
  return guarded(*encoder, [&] {
    const tvg::Mesh mesh = mesh_of(vertex_count, faces, face_count);
    // Until the first mesh is taken, metadata and another mesh may still come.
    std::optional<tvg::Encoder> first;
    if (!encoder->encoder) first.emplace(encoder->options, encoder->sink);
    tvg::Encoder& target = first ? *first : *encoder->encoder;
    tvg::Status status = target.set_mesh(mesh, {}, encoder->properties);
    const bool refused = !status.ok() && (status.error().code == tvg::ErrorCode::kInvalidArgument ||
                                          status.error().code == tvg::ErrorCode::kInvalidInput);
    if (first && !refused) encoder->encoder = std::move(first);
    if (status.ok()) {
      encoder->vertex_count = vertex_count;
      encoder->animated_components.clear();
      for (const tvg::Attribute& attribute : encoder->properties.attributes)
        encoder->animated_components.push_back(attribute.animated ? attribute.components : 0);
      encoder->values.assign(encoder->animated_components.size(), {});
      encoder->properties = {};
    }
    return status;
  });
}

tvg_code tvg_encoder_add_frame(tvg_encoder* encoder, const void* positions, size_t size, size_t stride) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!encoder->encoder) return fail(*encoder, TVG_ERROR_WRONG_STATE, "there is no mesh yet");
  if (!fits(encoder->vertex_count, positions, size, stride)) {
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT,
                "the frame has fewer bytes than the mesh has vertices, or the stride is below 12");
  }
  return guarded(*encoder, [&] {
    encoder->positions.resize(3 * std::size_t{encoder->vertex_count});
    for (std::size_t v = 0; v < encoder->vertex_count; ++v) {
      std::memcpy(encoder->positions.data() + 3 * v, static_cast<const std::byte*>(positions) + stride * v,
                  12);
    }
    const std::vector<std::span<const float>> values(encoder->values.begin(), encoder->values.end());
    return encoder->encoder->add_frame(encoder->positions, {}, values);
  });
}

tvg_code tvg_encoder_finish(tvg_encoder* encoder, tvg_encode_report* report) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (report != nullptr && report->struct_size < sizeof(std::size_t))
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "the report's struct_size is not set");
  if (!encoder->encoder) return fail(*encoder, TVG_ERROR_WRONG_STATE, "there is no mesh yet");
  return guarded(*encoder, [&]() -> tvg::Status {
    const tvg::Result<tvg::EncodeReport> made = encoder->encoder->finish();
    if (!made) return made.error();
    if (report != nullptr)
      give<tvg_encode_report>(
          {sizeof(tvg_encode_report), made->frames, made->gops, made->bytes, made->largest_error}, report);
    return {};
  });
}

const char* tvg_encoder_error_text(const tvg_encoder* encoder) {
  return encoder == nullptr ? "there is no encoder at null" : encoder->error_text.c_str();
}

tvg_code tvg_comparer_create(uint32_t vertex_count, const uint32_t* faces, uint32_t face_count,
                             tvg_comparer** comparer) {
  if (comparer == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  *comparer = nullptr;
  if (vertex_count == 0 || vertex_count > tvg::kMaxVertexCount || face_count > tvg::kMaxFaceCount ||
      (faces == nullptr && face_count > 0)) {
    return TVG_ERROR_INVALID_ARGUMENT;
  }
  for (std::size_t i = 0; i < 3 * std::size_t{face_count}; ++i) {
    if (faces[i] >= vertex_count) return TVG_ERROR_INVALID_INPUT;
  }
  try {
    *comparer = new tvg_comparer(mesh_of(vertex_count, faces, face_count));
    return TVG_OK;
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}

void tvg_comparer_destroy(tvg_comparer* comparer) {
  delete comparer;
}

tvg_code tvg_comparer_add_frame(tvg_comparer* comparer, const float* original, const float* decoded,
                                size_t count) {
  if (comparer == nullptr || original == nullptr || decoded == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  try {
    const tvg::Status status = comparer->comparison.add_frame({original, count}, {decoded, count});
    return status.ok() ? TVG_OK : code_of(status.error());
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}

tvg_code tvg_comparer_get(const tvg_comparer* comparer, tvg_comparison* comparison) {
  if (comparer == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  try {
    const tvg::ComparisonReport report = comparer->comparison.report();
    return give<tvg_comparison>(
        {sizeof(tvg_comparison), report.frames, report.diagonal, report.max_vertex_distance,
         report.rms_vertex_distance, report.kg_percent, report.sted},
        comparison);
  } catch (const std::exception&) {
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}

tvg_code tvg_join(const tvg_stream_bytes* streams, size_t count, tvg_sink sink, void* user,
                  tvg_encode_report* report, char* error_text, size_t error_size) {
  write_text("", error_text, error_size);
  if (streams == nullptr || count == 0 || sink == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (report != nullptr && report->struct_size < sizeof(std::size_t)) return TVG_ERROR_INVALID_ARGUMENT;
  try {
    std::vector<tvg::JoinInput> inputs;
    for (const tvg_stream_bytes& stream : std::span(streams, count)) {
      if (stream.bytes == nullptr && stream.size > 0) return TVG_ERROR_INVALID_ARGUMENT;
      inputs.push_back({"stream " + std::to_string(inputs.size()), bytes_of(stream)});
    }
    const tvg::Result<tvg::JoinReport> made = tvg::join(std::move(inputs), {}, sink_of(sink, user));
    if (!made) {
      write_text(made.error().describe(), error_text, error_size);
      return code_of(made.error());
    }
    if (report == nullptr) return TVG_OK;
    return give<tvg_encode_report>({sizeof(tvg_encode_report), made->frames, made->gops, made->bytes, 0},
                                   report);
  } catch (const std::exception&) {
    write_text("out of memory", error_text, error_size);
    return TVG_ERROR_OUT_OF_MEMORY;
  }
}
