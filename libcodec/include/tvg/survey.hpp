#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg {

/// An attribute of a mesh, without its values.
struct SurveyedAttribute {
  std::string name;
  AttributeKind kind = AttributeKind::kGeneric;
  AttributeDomain domain = AttributeDomain::kVertex;
  std::uint32_t components = 1;
  int bits = Attribute::kExact;
  bool animated = false;
  std::uint64_t values = 0;
};

/// A part of a mesh, with the number of its faces.
struct SurveyedPart {
  Part part;
  std::uint64_t faces = 0;
};

/// A mesh chunk, by its counts.
struct SurveyedMesh {
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
  MeshInfo parts;
  std::vector<SurveyedAttribute> attributes = {};
  std::vector<SurveyedPart> face_parts = {};
  std::uint64_t polygons = 0;
};

/// Planes that GOPs in mode basis share, or a part of them.
struct SurveyedPlan {
  std::uint64_t first_frame = 0;  ///< of those GOPs, position in the stream
  std::uint64_t frame_count = 0;  ///< of all of them
  std::uint32_t components = 0;
  std::uint64_t bytes = 0;  ///< of the whole chunk
  std::uint32_t part = 0;   ///< 0, or how many parts there are that this one adds to
};

/// Free-form data, by what is said of them.
struct SurveyedData {
  std::string name;
  DataEncoding encoding = DataEncoding::kStored;
  std::uint64_t decoded_size = 0;
  std::uint64_t bytes = 0;  ///< of the whole chunk
};

/// What a stream's structures say without its frames being decoded.
struct StreamSurvey {
  StreamHead head;
  Metadata metadata;
  std::vector<SurveyedData> data;  ///< in the order of the stream
  std::vector<ChunkInfo> chunks;
  std::vector<SurveyedMesh> meshes;
  std::vector<GopInfo> gops;              ///< `flagged` is not known: it takes decoding
  std::vector<std::uint32_t> gop_meshes;  ///< [GOP], number in `meshes` of the mesh it belongs to
  std::vector<SurveyedPlan> plans;        ///< that can be read, in the order of the stream
  std::vector<Error> findings;            ///< what is wrong as far as that can be seen
  std::uint64_t bytes = 0;                ///< of the signature and all chunks

  std::uint64_t frames() const;
};

/// Reads bytes of a stream from `offset` on into the span: how many there were, 0 only at the end. Offsets
/// ascend; those between need not be read, and there are none between where the stream's size is not known.
using StreamBytes = std::function<Result<std::size_t>(std::uint64_t offset, std::span<std::uint8_t> bytes)>;

/// Goes over a stream by its chunk headers: reads heads, metadata, meshes and index whole, of GOPs the header
/// packet, and passes over what is left, unread where `size`, the bytes of the stream, is known. Errors are
/// those of `read` and those that make a stream unreadable: kNotTvg, kUnsupportedVersion, kTruncated,
/// kMalformed, kLimitExceeded, kOutOfMemory; what can be read on behind is a finding.
Result<StreamSurvey> survey(const StreamBytes& read, std::optional<std::uint64_t> size = {},
                            const DecoderLimits& limits = {});

}  // namespace tvg
