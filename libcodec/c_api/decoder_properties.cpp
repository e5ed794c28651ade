#include "c_api/decoder_handle.hpp"
#include "c_api/support.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include <tvg/decoder.hpp>
#include <tvg/render_view.hpp>
#include <tvg/tvg.h>

// The C interface to what a mesh has beside its connectivity, and to the mesh as hardware draws it.

namespace {

using tvg::c_api::fail;
using tvg::c_api::fits;
using tvg::c_api::give;
using tvg::c_api::guarded;

static_assert(TVG_NO_VALUE == tvg::RenderView::kNoValue);

std::uint32_t count_of(std::size_t count) {
  return static_cast<std::uint32_t>(count);
}

/// Null where there is none.
const tvg::Attribute* find_attribute(const tvg_decoder& decoder, std::uint32_t attribute) {
  const std::vector<tvg::Attribute>& attributes = decoder.decoder.properties().attributes;
  return attribute < attributes.size() ? &attributes[attribute] : nullptr;
}

/// The values of an attribute, which check_values() found to be there.
std::span<const float> values_of(const tvg_decoder& decoder, std::uint32_t attribute) {
  const tvg::Attribute& found = *find_attribute(decoder, attribute);
  return found.animated ? decoder.decoder.animated_values(attribute) : std::span<const float>(found.values);
}

/// What every call about the mesh begins with.
tvg_code check_mesh(const tvg_decoder* decoder) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  return decoder->has_mesh ? TVG_OK : TVG_ERROR_WRONG_STATE;
}

/// The same where `attribute` must be there too, and its values.
tvg_code check_values(const tvg_decoder* decoder, std::uint32_t attribute) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const tvg::Attribute* const found = find_attribute(*decoder, attribute);
  if (found == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  return found->animated && !decoder->has_frame ? TVG_ERROR_WRONG_STATE : TVG_OK;
}

tvg_code check_view(const tvg_decoder* decoder) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  return decoder->view ? TVG_OK : TVG_ERROR_WRONG_STATE;
}

/// The bytes of the caller's.
std::span<std::byte> bytes_at(void* target, std::size_t size) {
  return {static_cast<std::byte*>(target), size};
}

}  // namespace

tvg_code tvg_decoder_get_properties(const tvg_decoder* decoder, tvg_properties_info* properties) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const tvg::MeshProperties& found = decoder->decoder.properties();
  return give<tvg_properties_info>({sizeof(tvg_properties_info), count_of(found.attributes.size()),
                                    count_of(found.parts.size()), count_of(found.polygons.size())},
                                   properties);
}

tvg_code tvg_decoder_get_attribute(const tvg_decoder* decoder, uint32_t attribute, tvg_attribute_info* info) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const tvg::Attribute* const found = find_attribute(*decoder, attribute);
  if (found == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  return give<tvg_attribute_info>(
      {sizeof(tvg_attribute_info), found->name.c_str(), static_cast<std::uint32_t>(found->kind),
       static_cast<std::uint32_t>(found->domain), found->components,
       found->bits == tvg::Attribute::kExact ? TVG_EXACT_BITS : static_cast<std::uint32_t>(found->bits),
       found->animated ? 1u : 0u, count_of(found->value_count())},
      info);
}

tvg_code tvg_decoder_copy_attribute(const tvg_decoder* decoder, uint32_t attribute, void* values, size_t size,
                                    size_t stride) {
  if (const tvg_code code = check_values(decoder, attribute); code != TVG_OK) return code;
  const tvg::Attribute& found = *find_attribute(*decoder, attribute);
  const std::size_t count = found.value_count(), row = found.components * sizeof(float);
  if (!fits(count, values, size, stride, found.components)) return TVG_ERROR_INVALID_ARGUMENT;
  const std::span<const float> given = values_of(*decoder, attribute);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(static_cast<std::byte*>(values) + stride * i, given.data() + found.components * i, row);
  return TVG_OK;
}

tvg_code tvg_decoder_copy_corners(const tvg_decoder* decoder, uint32_t attribute, uint32_t* corners,
                                  size_t count) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const tvg::Attribute* const found = find_attribute(*decoder, attribute);
  const std::vector<tvg::Face>& faces = decoder->decoder.mesh().faces;
  if (found == nullptr || count / 3 < faces.size() || (corners == nullptr && !faces.empty()))
    return TVG_ERROR_INVALID_ARGUMENT;
  const std::vector<std::uint32_t>& parts = decoder->decoder.properties().face_parts;
  for (std::size_t i = 0; i < 3 * faces.size(); ++i) {
    switch (found->domain) {
      case tvg::AttributeDomain::kVertex:
        corners[i] = faces[i / 3][i % 3];
        break;
      case tvg::AttributeDomain::kPart:
        corners[i] = parts.empty() ? 0 : parts[i / 3];
        break;
      default:
        corners[i] = found->corners[i];
    }
  }
  return TVG_OK;
}

tvg_code tvg_decoder_get_part(const tvg_decoder* decoder, uint32_t part, tvg_part_info* info) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const std::vector<tvg::Part>& parts = decoder->decoder.properties().parts;
  if (part >= parts.size()) return TVG_ERROR_INVALID_ARGUMENT;
  return give<tvg_part_info>({sizeof(tvg_part_info), parts[part].object.c_str(), parts[part].group.c_str(),
                              parts[part].material.c_str()},
                             info);
}

tvg_code tvg_decoder_copy_face_parts(const tvg_decoder* decoder, uint32_t* parts, size_t count) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const std::size_t faces = decoder->decoder.mesh().faces.size();
  if (count < faces || (parts == nullptr && faces > 0)) return TVG_ERROR_INVALID_ARGUMENT;
  const std::vector<std::uint32_t>& found = decoder->decoder.properties().face_parts;
  if (found.empty()) {
    std::fill_n(parts, faces, 0u);
  } else {
    std::copy(found.begin(), found.end(), parts);
  }
  return TVG_OK;
}

tvg_code tvg_decoder_copy_polygons(const tvg_decoder* decoder, tvg_polygon* polygons, size_t count) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  const std::vector<tvg::Polygon>& found = decoder->decoder.properties().polygons;
  if (count < found.size() || (polygons == nullptr && !found.empty())) return TVG_ERROR_INVALID_ARGUMENT;
  for (std::size_t i = 0; i < found.size(); ++i)
    polygons[i] = {count_of(found[i].first_triangle), found[i].corners};
  return TVG_OK;
}

tvg_code tvg_decoder_get_view(tvg_decoder* decoder, tvg_view_info* info) {
  if (const tvg_code code = check_mesh(decoder); code != TVG_OK) return code;
  if (!decoder->view) {
    const tvg_code made = guarded(*decoder, [&] {
      tvg::Result<tvg::RenderView> view =
          tvg::RenderView::of(decoder->decoder.mesh(), decoder->decoder.properties());
      if (!view) return fail(*decoder, view.error());
      decoder->view = std::move(*view);
      return TVG_OK;
    });
    if (made != TVG_OK) return made;
  }
  const tvg::RenderView& view = *decoder->view;
  return give<tvg_view_info>(
      {sizeof(tvg_view_info), count_of(view.vertex_count()), count_of(view.indices().size()),
       count_of(view.ranges().size()), view.indices().data(), view.source_vertices().data(),
       view.source_faces().data()},
      info);
}

tvg_code tvg_decoder_get_view_range(const tvg_decoder* decoder, uint32_t part, tvg_view_range* range) {
  if (const tvg_code code = check_view(decoder); code != TVG_OK) return code;
  const std::span<const tvg::RenderView::Range> ranges = decoder->view->ranges();
  if (part >= ranges.size()) return TVG_ERROR_INVALID_ARGUMENT;
  return give<tvg_view_range>(
      {sizeof(tvg_view_range), count_of(ranges[part].first_index), count_of(ranges[part].index_count)},
      range);
}

tvg_code tvg_decoder_copy_view_values(const tvg_decoder* decoder, uint32_t attribute, uint32_t* values,
                                      size_t count) {
  if (const tvg_code code = check_view(decoder); code != TVG_OK) return code;
  if (attribute >= decoder->view->attribute_count() || values == nullptr ||
      count < decoder->view->vertex_count())
    return TVG_ERROR_INVALID_ARGUMENT;
  const std::span<const std::uint32_t> chosen = decoder->view->value_indices(attribute);
  std::copy(chosen.begin(), chosen.end(), values);
  return TVG_OK;
}

tvg_code tvg_decoder_copy_view_positions(tvg_decoder* decoder, void* positions, size_t size, size_t stride) {
  if (const tvg_code code = check_view(decoder); code != TVG_OK) return code;
  if (!decoder->has_frame) return fail(*decoder, TVG_ERROR_WRONG_STATE, "there is no frame now");
  if (!fits(decoder->view->vertex_count(), positions, size, stride))
    return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT, "the buffer is too small, or the stride below 12");
  return guarded(*decoder, [&] {
    decoder->find_positions();
    const tvg::Status copied =
        decoder->view->copy_vertices(decoder->positions, bytes_at(positions, size), stride);
    return copied.ok() ? TVG_OK : fail(*decoder, copied.error());
  });
}

tvg_code tvg_decoder_compute_view_normals(tvg_decoder* decoder, void* normals, size_t size, size_t stride) {
  if (const tvg_code code = check_view(decoder); code != TVG_OK) return code;
  if (!decoder->has_frame) return fail(*decoder, TVG_ERROR_WRONG_STATE, "there is no frame now");
  if (!fits(decoder->view->vertex_count(), normals, size, stride))
    return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT, "the buffer is too small, or the stride below 12");
  return guarded(*decoder, [&] {
    decoder->find_normals();
    const tvg::Status copied =
        decoder->view->copy_vertices(decoder->normals, bytes_at(normals, size), stride);
    return copied.ok() ? TVG_OK : fail(*decoder, copied.error());
  });
}

tvg_code tvg_decoder_copy_view_attribute(const tvg_decoder* decoder, uint32_t attribute, void* values,
                                         size_t size, size_t stride) {
  if (const tvg_code code = check_view(decoder); code != TVG_OK) return code;
  if (const tvg_code code = check_values(decoder, attribute); code != TVG_OK) return code;
  const tvg::Attribute& found = *find_attribute(*decoder, attribute);
  if (!fits(decoder->view->vertex_count(), values, size, stride, found.components))
    return TVG_ERROR_INVALID_ARGUMENT;
  const tvg::Status copied = decoder->view->copy_attribute(attribute, values_of(*decoder, attribute),
                                                           bytes_at(values, size), stride);
  return copied.ok() ? TVG_OK : tvg::c_api::code_of(copied.error());
}

tvg_code tvg_decoder_get_data(const tvg_decoder* decoder, tvg_data_info* info) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_data) return TVG_ERROR_WRONG_STATE;
  const tvg::CodedData& data = decoder->decoder.data();
  return give<tvg_data_info>(
      {sizeof(tvg_data_info), decoder->data_name.c_str(), data.decoded_size,
       static_cast<std::uint32_t>(data.encoding), data.bytes.data(), data.bytes.size()},
      info);
}

tvg_code tvg_decoder_copy_data(tvg_decoder* decoder, void* bytes, size_t size) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!decoder->has_data) return fail(*decoder, TVG_ERROR_WRONG_STATE, "there are no data now");
  const tvg::CodedData& data = decoder->decoder.data();
  if (size < data.decoded_size || (bytes == nullptr && data.decoded_size > 0))
    return fail(*decoder, TVG_ERROR_INVALID_ARGUMENT, "the buffer is too small for the data");
  return guarded(*decoder, [&] {
    const tvg_code code = tvg::c_api::unpack_into(
        data, {static_cast<std::uint8_t*>(bytes), static_cast<std::size_t>(data.decoded_size)});
    return code == TVG_OK ? code : fail(*decoder, code, "the data cannot be unpacked");
  });
}
