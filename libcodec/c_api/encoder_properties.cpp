#include "c_api/encoder_handle.hpp"
#include "c_api/support.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <tvg/data.hpp>
#include <tvg/encoder.hpp>
#include <tvg/tvg.h>

// The C interface to what goes into a stream beside positions.

namespace {

using tvg::c_api::fail;
using tvg::c_api::fits;
using tvg::c_api::guarded;

const char* text_of(const char* text) {
  return text == nullptr ? "" : text;
}

/// What the caller's structure has, as far as he knows it; nothing where its size is not set.
template <class Given>
std::optional<Given> known_part(const Given* given) {
  if (given == nullptr || given->struct_size < sizeof(std::size_t)) return std::nullopt;
  Given known = {};
  std::memcpy(static_cast<void*>(&known), given, std::min(given->struct_size, sizeof known));
  return known;
}

/// Whether the numbers are those of kinds and domains, and what is pointed at is there.
const char* fault_of(const tvg_attribute& given) {
  if (given.kind > TVG_ATTRIBUTE_GENERIC) return "there is no such kind of attribute";
  if (given.domain > TVG_DOMAIN_PART) return "there is no such domain of attributes";
  if (given.components < 1 || given.components > tvg::kMaxAttributeComponents)
    return "an attribute has one to four components";
  if (given.value_count > 0 && given.values == nullptr && given.animated == 0)
    return "there are no values at null";
  if (given.stride != 0 && given.stride < given.components * sizeof(float))
    return "the stride is smaller than a value";
  if (given.corner_count > 0 && given.corners == nullptr) return "there are no corners at null";
  return nullptr;
}

int bits_of(std::uint32_t bits) {
  if (bits == 0) return tvg::Attribute::kBitsOfKind;
  return bits == TVG_EXACT_BITS ? tvg::Attribute::kExact : static_cast<int>(std::min(bits, 1000u));
}

/// So many values that are `stride` bytes apart.
std::vector<float> rows_of(const void* values, std::size_t count, std::size_t components,
                           std::size_t stride) {
  std::vector<float> rows(count * components);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(rows.data() + components * i, static_cast<const std::byte*>(values) + stride * i,
                components * sizeof(float));
  return rows;
}

tvg::Attribute attribute_of(const tvg_attribute& given) {
  tvg::Attribute attribute;
  attribute.name = text_of(given.name);
  attribute.kind = static_cast<tvg::AttributeKind>(given.kind);
  attribute.domain = static_cast<tvg::AttributeDomain>(given.domain);
  attribute.components = given.components;
  attribute.bits = bits_of(given.bits);
  attribute.animated = given.animated != 0;
  const std::size_t row = given.components * sizeof(float);
  if (!attribute.animated)
    attribute.values =
        rows_of(given.values, given.value_count, given.components, given.stride == 0 ? row : given.stride);
  if (given.corner_count > 0) attribute.corners.assign(given.corners, given.corners + given.corner_count);
  return attribute;
}

}  // namespace

tvg_code tvg_encoder_add_attribute(tvg_encoder* encoder, const tvg_attribute* attribute) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  const std::optional<tvg_attribute> given = known_part(attribute);
  if (!given) return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "the attribute's struct_size is not set");
  if (const char* const fault = fault_of(*given)) return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, fault);
  return guarded(*encoder, [&] {
    encoder->properties.attributes.push_back(attribute_of(*given));
    return tvg::Status();
  });
}

tvg_code tvg_encoder_set_values(tvg_encoder* encoder, uint32_t attribute, const void* values, uint32_t count,
                                size_t stride) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (!encoder->encoder) return fail(*encoder, TVG_ERROR_WRONG_STATE, "there is no mesh yet");
  if (attribute >= encoder->values.size() || encoder->animated_components[attribute] == 0)
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "the mesh has no animated attribute of this number");
  const std::size_t components = encoder->animated_components[attribute];
  if ((values == nullptr && count > 0) || stride < components * sizeof(float))
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT,
                "there are no values at null, or the stride is smaller than a value");
  return guarded(*encoder, [&] {
    encoder->values[attribute] = rows_of(values, count, components, stride);
    return tvg::Status();
  });
}

tvg_code tvg_encoder_add_part(tvg_encoder* encoder, const tvg_part_info* part) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  const std::optional<tvg_part_info> given = known_part(part);
  if (!given) return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "the part's struct_size is not set");
  return guarded(*encoder, [&] {
    encoder->properties.parts.push_back(
        {text_of(given->object), text_of(given->group), text_of(given->material)});
    return tvg::Status();
  });
}

tvg_code tvg_encoder_set_face_parts(tvg_encoder* encoder, const uint32_t* parts, size_t face_count) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (parts == nullptr && face_count > 0)
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "there are no parts at null");
  return guarded(*encoder, [&] {
    std::vector<std::uint32_t> taken;
    if (face_count > 0) taken.assign(parts, parts + face_count);
    encoder->properties.face_parts = std::move(taken);
    return tvg::Status();
  });
}

tvg_code tvg_encoder_set_polygons(tvg_encoder* encoder, const tvg_polygon* polygons, size_t count) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (polygons == nullptr && count > 0)
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "there are no polygons at null");
  return guarded(*encoder, [&] {
    std::vector<tvg::Polygon> taken;
    taken.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      taken.push_back({polygons[i].first_face, polygons[i].corner_count});
    encoder->properties.polygons = std::move(taken);
    return tvg::Status();
  });
}

tvg_code tvg_encoder_clear_properties(tvg_encoder* encoder) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  encoder->properties = {};
  return TVG_OK;
}

tvg_code tvg_encoder_add_data(tvg_encoder* encoder, const char* name, const void* bytes, size_t size) {
  if (encoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  if (name == nullptr || (bytes == nullptr && size > 0))
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "there is nothing at null");
  if (encoder->encoder) return fail(*encoder, TVG_ERROR_WRONG_STATE, "the head is written already");
  if (size > tvg::kMaxDataBytes)
    return fail(*encoder, TVG_ERROR_INVALID_ARGUMENT, "data have at most 64 MiB");
  return guarded(*encoder, [&]() -> tvg::Status {
    std::vector<tvg::NamedData>& data = encoder->options.data;
    for (const tvg::NamedData& one : data) {
      if (one.name == name)
        return tvg::Error{tvg::ErrorCode::kInvalidArgument, "there are data of this name already"};
    }
    tvg::NamedData added{name, {}};
    if (size > 0)
      added.bytes.assign(static_cast<const std::uint8_t*>(bytes),
                         static_cast<const std::uint8_t*>(bytes) + size);
    data.push_back(std::move(added));
    return {};
  });
}
