#include "base/stream_error.hpp"
#include "connectivity/mesh_coder.hpp"
#include "container/chunk_reader.hpp"
#include "container/stream_writer.hpp"
#include "modes/basis_plan.hpp"
#include "modes/elp_header.hpp"
#include "modes/lossless_header.hpp"
#include "streams/surveyed_properties.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include <tvg/survey.hpp>

namespace tvg {

namespace {

/// Small: most of what is read of a GOP is passed over.
constexpr std::size_t kPieceBytes = std::size_t{1} << 13;

class Surveyor {
 public:
  Surveyor(const StreamBytes& read, std::optional<std::uint64_t> size, const DecoderLimits& limits)
      : read_(read), size_(size), reader_(limits), piece_(kPieceBytes) {}

  Result<StreamSurvey> run() {
    using Event = ChunkReader::Event;
    result_.bytes = kSignature.size();
    for (;;) {
      const Event event = reader_.next();
      if (event == Event::kEnd) return std::move(result_);
      if (event == Event::kFailed) return reader_.error();
      if (event == Event::kNeedBytes) {
        if (Status status = read_on(); !status.ok()) return status.error();
      } else {
        take(event);
      }
    }
  }

 private:
  Status read_on() {
    if (size_) {
      reader_.skip();
      if (reader_.input_offset() > *size_) return truncated();
    }
    const Result<std::size_t> got = read_(reader_.input_offset(), piece_);
    if (!got) return got.error();
    if (*got == 0) reader_.finish();
    reader_.push(Bytes(piece_).first(*got));
    return {};
  }

  /// A chunk says that it goes on behind the last byte.
  Error truncated() const {
    Error error = stream_error(ErrorCode::kTruncated, "§3.4", {"the stream ends before it is complete"});
    error.byte_offset = size_;
    return error;
  }

  void take(ChunkReader::Event event) {
    switch (event) {
      case ChunkReader::Event::kChunk: {
        const ChunkHeader& chunk = reader_.chunk();
        result_.chunks.push_back({std::string(text(chunk.type)), reader_.chunk_offset(), chunk.total_size()});
        result_.bytes += chunk.total_size();
        break;
      }
      case ChunkReader::Event::kHead:
        result_.head = reader_.head();
        break;
      case ChunkReader::Event::kMetadata:
        result_.metadata = reader_.take_metadata();
        break;
      case ChunkReader::Event::kData: {
        const CodedData& data = reader_.data();
        result_.data.push_back(
            {std::string(data.name), data.encoding, data.decoded_size, reader_.chunk().total_size()});
        break;
      }
      case ChunkReader::Event::kMesh:
        take_mesh();
        break;
      case ChunkReader::Event::kPlan:
        take_plan();
        break;
      case ChunkReader::Event::kGop:
        take_gop();
        reader_.pass_over();
        break;
      case ChunkReader::Event::kGopLost:
        frames_ += reader_.gop().frame_count;
        find(std::move(reader_.problem().error));
        break;
      case ChunkReader::Event::kIndex:
        if (!reader_.index_matches()) find(malformed("§4.6", "the index does not match the stream"));
        break;
      case ChunkReader::Event::kProblem:
        find(std::move(reader_.problem().error));
        break;
      default:
        break;
    }
  }

  void take_mesh() {
    const MeshLayout& mesh = reader_.mesh();
    SurveyedMesh& surveyed = result_.meshes.emplace_back();
    surveyed.vertices = mesh.vertex_count;
    surveyed.faces = mesh.face_count;
    surveyed.parts = sizes_of(mesh);
    mesh_ids_.push_back(reader_.mesh_id());
    if (Status status = survey_properties(mesh, reader_.head().limits, surveyed); !status.ok())
      find(status.error());
    CoarseLayouts lods;
    if (mesh.lods.empty()) return;
    if (const Fault fault = read_coarse_layouts(mesh.lods, mesh.face_count, lods)) {
      find(error_of(fault));
    } else if (!list_lods(lods, surveyed.parts.lods)) {
      throw std::bad_alloc();
    }
  }

  void take_gop() {
    const GopHeader& header = reader_.gop();
    Result<GopInfo> read = info_of(header);
    frames_ += header.frame_count;
    if (!read) {
      find(std::move(read.error()));
      return;
    }
    GopInfo& gop = *read;
    gop.first_frame = frames_ - header.frame_count;
    gop.bytes = reader_.chunk().total_size();
    gop.header_bytes = reader_.content().size() - gop.flag_bytes;
    note_plan_use(header, gop);
    result_.gops.push_back(gop);
    const auto mesh = std::find(mesh_ids_.rbegin(), mesh_ids_.rend(), header.mesh);
    result_.gop_meshes.push_back(static_cast<std::uint32_t>(mesh_ids_.rend() - mesh - 1));
  }

  /// Keeps what the plan says of the GOPs that name it.
  void take_plan() {
    const ChunkWindow::Entry& entry = *reader_.plans().find(reader_.plan_id());
    BasisHeader basis;
    ByteReader fields(reader_.plan().fields);
    if (entry.part > 0) {
      const auto first = header_of(static_cast<std::uint32_t>(entry.adds_to - 1));
      if (first == nullptr) return;  // gone as this came: no GOP can name both
      basis = *first;
    } else if (const Fault fault = read_basis_header(fields, result_.head.limits, basis)) {
      reader_.reject(fault.code);
      find(error_of(fault));
      return;
    }
    basis.scales = basis.flags = {};
    result_.plans.push_back(
        {.components = basis.components, .bytes = reader_.chunk().total_size(), .part = entry.part});
    plan_ids_.push_back(reader_.plan_id());
    reader_.keep(std::make_shared<const BasisHeader>(basis));
  }

  /// GOPs of a basis may lie apart where the chunk of its planes came again: each chunk has its own.
  void note_plan_use(const GopHeader& header, const GopInfo& gop) {
    if (gop.mode != Mode::kBasis) return;
    for (const std::uint32_t id : plane_ids(header)) {
      const auto found = std::find(plan_ids_.rbegin(), plan_ids_.rend(), id);
      if (found == plan_ids_.rend()) continue;
      SurveyedPlan& plan = result_.plans[static_cast<std::size_t>(plan_ids_.rend() - found - 1)];
      if (plan.frame_count == 0) plan.first_frame = gop.first_frame;
      plan.frame_count += gop.frame_count;
    }
  }

  /// What the plan of this name says; null where nothing is known of it.
  std::shared_ptr<const BasisHeader> header_of(std::uint32_t plan) const {
    const ChunkWindow::Entry* const entry = reader_.plans().find(plan);
    return entry == nullptr ? nullptr : std::static_pointer_cast<const BasisHeader>(entry->content);
  }

  Result<GopInfo> info_of(const GopHeader& header) const {
    if (header.mode == kModeBasis) {
      if (header.plane_count() == 0) return malformed("§7.8.1", "a GOP in mode basis names no planes");
      const auto basis = header_of(ByteReader(header.planes).u32());
      if (basis == nullptr) return malformed("§4.5.1", "a GOP in mode basis names other planes than a basis");
      return basis_gop_info(header, *basis);
    }
    if (header.mode == kModeLossless) {
      LosslessHeader lossless;
      if (Status status = read_lossless_header(header, lossless); !status.ok()) return status.error();
      return lossless_gop_info(header);
    }
    ElpHeader elp;
    if (Status status = read_elp_header(header, elp); !status.ok()) return status.error();
    return gop_info(header, elp);
  }

  void find(Error error) {
    if (!error.byte_offset) error.byte_offset = reader_.chunk_offset();
    result_.findings.push_back(std::move(error));
  }

  const StreamBytes& read_;
  const std::optional<std::uint64_t> size_;
  ChunkReader reader_;
  std::vector<std::uint8_t> piece_;
  StreamSurvey result_;
  std::vector<std::uint32_t> mesh_ids_;  ///< of the meshes of the result
  std::vector<std::uint32_t> plan_ids_;  ///< of the plans of the result
  std::uint64_t frames_ = 0;
};

}  // namespace

std::uint64_t StreamSurvey::frames() const {
  return gops.empty() ? 0 : gops.back().first_frame + gops.back().frame_count;
}

Result<StreamSurvey> survey(const StreamBytes& read, std::optional<std::uint64_t> size,
                            const DecoderLimits& limits) {
  try {
    return Surveyor(read, size, limits).run();
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace tvg
