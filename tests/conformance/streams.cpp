#include "streams.hpp"

#include "container/chunk.hpp"
#include "container/gop_header.hpp"
#include "container/head.hpp"
#include "container/stream_writer.hpp"
#include "property_streams.hpp"
#include "stream_toolbox.hpp"
#include "tests/codec/levels_toolbox.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include <tvg/encoder.hpp>

namespace tvg::conformance {

namespace {

/// A source that stands for a pipe: no length, no way back.
class PipeSource final : public SourceDecorator {
 public:
  explicit PipeSource(const Sequence& sequence)
      : SourceDecorator(std::make_unique<SequenceSource>(sequence)) {}

  std::optional<std::uint64_t> frame_count() const override { return std::nullopt; }
  bool rewind() override { return false; }
};

/// Limits that hold for all of these streams.
StreamLimits joint_limits(const std::vector<Stream>& streams) {
  StreamLimits limits;
  for (const Stream& stream : streams) {
    const Bytes bytes = Bytes(stream).subspan(kSignature.size());
    const auto header = read_chunk_header(bytes);
    if (!header || header->type != kHeadChunk) stop("a stream does not begin with its head");
    const auto head = read_head(bytes.subspan(kChunkHeaderSize, header->length));
    if (!head) stop(head.error().describe());
    limits = larger_limits(limits, head->limits);
  }
  return limits;
}

Status copy_meshes_and_gops(Bytes stream, StreamWriter& writer) {
  Status status;
  for (Bytes rest = stream.subspan(kSignature.size()); status.ok() && !rest.empty();) {
    const auto header = read_chunk_header(rest);
    if (!header) stop("a stream to be joined is damaged");
    const Bytes chunk = rest.first(static_cast<std::size_t>(header->total_size()));
    if (header->type == kMeshChunk) status = writer.write_mesh_chunk(chunk);
    if (header->type == kPlanChunk) status = writer.write_plan_chunk(chunk);
    if (header->type == kGopChunk) {
      ByteReader packet(chunk.subspan(kChunkHeaderSize + 1));
      const auto gop = read_gop_header(packet.bytes(packet.varint()));
      if (!gop) stop(gop.error().describe());
      status = writer.write_gop_chunk(chunk, gop->frame_count);
    }
    rest = rest.subspan(chunk.size());
  }
  return status;
}

/// The meshes and GOPs of several streams under one head, with `between` in front of each stream's.
Stream join(const std::vector<Stream>& streams, Bytes between = {}) {
  Stream joined;
  joined.reserve(4096);
  StreamWriter writer([&joined](Bytes bytes) {
    joined.insert(joined.end(), bytes.begin(), bytes.end());
    return Status();
  });
  Status status = writer.write_start(joint_limits(streams), {});
  for (const Stream& stream : streams) {
    if (status.ok()) status = writer.write(between);
    if (status.ok()) status = copy_meshes_and_gops(stream, writer);
  }
  if (status.ok()) status = writer.write_end();
  if (!status.ok()) stop(status.error().describe());
  return joined;
}

Stream make_uniform(std::string_view name, std::uint32_t frames, int bits, Predictor predictor) {
  return encode_sequence(corpus_sequence(name, frames), options_of(bits, bits, predictor, 50));
}

Stream make_pipe() {
  const Sequence sequence = corpus_sequence("cloth", 6);
  PipeSource source(sequence);
  return encode_source(source, options_of(6, 6, Predictor::kElp, 2));
}

Stream make_metadata() {
  EncodeOptions options = options_of(6, 6, Predictor::kElp, 2);
  options.metadata = {
      {"fps", "30000/1001"}, {"name", "dreieck \xC3\xA4"}, {"note", ""}, {"units", "cm"}, {"up", "y"}};
  options.first_frame = 1000;
  return encode_sequence(triangle(5), options);
}

Stream make_reordered() {
  EncodeOptions options = options_of(7, 7, Predictor::kElp, 50);
  options.keep_vertex_order = false;
  return encode_sequence(corpus_sequence("soup", 3), options);
}

Stream make_pyramid_soup() {
  EncodeOptions options = options_of(6, 6, Predictor::kPyramid, 50);
  options.keep_vertex_order = false;
  return encode_sequence(corpus_sequence("soup", 3), options);
}

/// Still for a while, then shaken, so that now one predictor is the better and now the other.
Stream make_auto() {
  Sequence sequence = corpus_sequence("cloth", 12);
  for (std::size_t f = 1; f < sequence.frames.size(); ++f) {
    if (f % 4 == 1) sequence.frames[f] = sequence.frames[f - 1];
  }
  return encode_sequence(sequence, options_of(5, 5, Predictor::kAuto, 12));
}

Stream make_step() {
  EncodeOptions options = options_of(4, 2, Predictor::kElp, 3);
  options.step = 0.125;
  return encode_sequence(triangle(7), options);
}

Stream make_points() {
  Sequence points = triangle(4);
  points.mesh.faces.clear();
  return encode_sequence(points, options_of(10, 8, Predictor::kTime, 50));
}

/// Meshes that come again: of the last two a decoder keeps, and the first of three after it has gone.
Stream make_meshes_again() {
  Stream stream;
  EncodeOptions options = options_of(6, 4, Predictor::kElp, 2);
  options.max_meshes = 2;
  options.max_vertices = 231;
  options.max_faces = 355;
  Encoder encoder(options, [&stream](Bytes bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  Sequence points = triangle(6);
  points.mesh.faces.clear();
  const Sequence sequences[] = {triangle(6), corpus_sequence("soup", 6), points};
  std::size_t frame = 0;
  for (const std::size_t which : {0, 1, 0, 2, 0, 1}) {
    const Sequence& sequence = sequences[which];
    Status status = encoder.set_mesh(sequence.mesh);
    if (status.ok()) status = encoder.add_frame(sequence.frames[frame++]);
    if (!status.ok()) stop(status.error().describe());
  }
  const auto report = encoder.finish();
  if (!report) stop(report.error().describe());
  return stream;
}

EncodeOptions lossless_options(std::uint32_t gop_frames) {
  EncodeOptions options;
  options.mode = Mode::kLossless;
  options.gop_frames = gop_frames;
  return options;
}

/// The first frames of a cloth that is coarse enough for several bases in a small stream.
Stream make_basis(int fine_bits, int coarse_bits, std::uint32_t frames, std::uint32_t period) {
  EncodeOptions options = options_of(fine_bits, coarse_bits, Predictor::kAuto, 4);
  options.mode = Mode::kBasis;
  options.period_frames = period;
  return encode_sequence(corpus_sequence("cloth", frames), options);
}

Stream make_basis_error() {
  EncodeOptions options;
  options.mode = Mode::kBasis;
  options.period_frames = 6;
  options.gop_frames = 3;
  options.max_error = ErrorBound{0.01};
  return encode_sequence(triangle(12), options);
}

/// Numbers of all sizes: zeros of both signs, denormal ones, the largest, and what changes its sign.
Stream make_lossless_numbers() {
  constexpr float kLeast = 0x1p-149F, kNormal = 0x1p-126F, kLargest = 0x1.FFFFFEp127F;
  Sequence sequence = triangle(4);
  sequence.frames[0] = {0, -0.0F, kLeast, -kLeast, kNormal, -kNormal, kLargest, -kLargest, 1, 1.5F, -2, 3};
  sequence.frames[1] = {-0.0F, 0, -kLeast, kNormal, 3 * kLeast, kLargest, -1, -kLargest, 1e-20F, 0.1F, -2, 3};
  sequence.frames[2] = sequence.frames[1];
  return encode_sequence(sequence, lossless_options(3));
}

/// As a format of half the precision has them: the low bits of all numbers are zero.
Stream make_lossless_half() {
  Sequence sequence = corpus_sequence("cloth", 3);
  for (FramePositions& frame : sequence.frames) {
    for (float& x : frame) x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0xFFFFE000u);
  }
  return encode_sequence(sequence, lossless_options(50));
}

/// Levels that have nothing to do with the mesh, so that some vertices are far from any that stays.
Stream make_levels() {
  const Sequence sequence = corpus_sequence("soup", 2);
  auto levels = std::make_shared<MeshLevels>();
  for (std::uint32_t v = 0; v < sequence.mesh.vertex_count; ++v)
    levels->level.push_back(v == 77 ? 0 : static_cast<std::uint8_t>(1 + v / 40 + (v * 0x9E3779B1u >> 30)));
  EncodeOptions options = options_of(5, 5, Predictor::kPyramid, 50);
  options.levels = levels;
  return encode_sequence(sequence, options);
}

/// `rounds` of vertices removed, with coarse meshes after the second and the last.
Stream make_lods(std::string_view name, std::uint32_t rounds, EncodeOptions options) {
  const Sequence sequence = corpus_sequence(name, options.mode == Mode::kBasis ? 10 : 3);
  options.levels = test::greedy_levels(sequence.mesh, rounds, {2, rounds});
  return encode_sequence(sequence, options);
}

Stream make_lods_basis() {
  EncodeOptions options = options_of(6, 4, Predictor::kElp, 3);
  options.mode = Mode::kBasis;
  options.period_frames = 6;
  return make_lods("cloth", 5, options);
}

Stream make_lods_lossless() {
  EncodeOptions options = lossless_options(50);
  options.keep_vertex_order = false;
  return make_lods("cloth", 4, options);
}

}  // namespace

const std::vector<ConformanceStream>& conformance_streams() {
  static const std::vector<ConformanceStream> streams = {
      {"triangle", "the least there can be: one face, one frame",
       [] { return encode_sequence(triangle(1), options_of(8, 8, Predictor::kElp, 50)); }},
      {"points", "vertices without a face, on two lattices", make_points},
      {"metadata", "metadata; frames cut out of a longer sequence; GOPs of two frames, the last of one",
       make_metadata},
      {"step", "a lattice given by its step, hybrid", make_step},
      {"elp", "predictor elp, one lattice", [] { return make_uniform("face", 6, 7, Predictor::kElp); }},
      {"space", "predictor space", [] { return make_uniform("face", 3, 7, Predictor::kSpace); }},
      {"time", "predictor time", [] { return make_uniform("face", 6, 7, Predictor::kTime); }},
      {"hybrid", "predictor elp, two lattices",
       [] { return encode_sequence(corpus_sequence("hand", 4), options_of(8, 6, Predictor::kElp, 50)); }},
      {"hybrid_space", "predictor space, two lattices far apart",
       [] { return encode_sequence(corpus_sequence("cloth", 3), options_of(9, 1, Predictor::kSpace, 50)); }},
      {"hybrid_time", "predictor time, two lattices, several GOPs",
       [] { return encode_sequence(corpus_sequence("cloth", 5), options_of(7, 6, Predictor::kTime, 2)); }},
      {"gops", "several GOPs, the last of one frame",
       [] { return encode_sequence(corpus_sequence("cloth", 7), options_of(6, 6, Predictor::kElp, 2)); }},
      {"pipe", "a lattice of its own for each GOP", make_pipe},
      {"toy", "many closed components", [] { return make_uniform("toy", 2, 5, Predictor::kElp); }},
      {"soup", "all that a mesh can do wrong, its order kept",
       [] { return make_uniform("soup", 3, 6, Predictor::kElp); }},
      {"reordered", "the same mesh with its vertex order given up", make_reordered},
      {"one_bit", "the coarsest lattice", [] { return make_uniform("hand", 4, 1, Predictor::kElp); }},
      {"finest", "the finest lattice, 24 bits", [] { return make_uniform("cloth", 2, 24, Predictor::kElp); }},
      {"finest_hybrid", "the two lattices furthest apart, 24 and 1 bits",
       [] { return encode_sequence(corpus_sequence("cloth", 3), options_of(24, 1, Predictor::kElp, 50)); }},
      {"two_meshes", "connectivity that changes",
       [] {
         return join({make_uniform("cloth", 2, 6, Predictor::kElp), make_step()});
       }},
      {"pyramid", "predictor pyramid from the first frame on, several GOPs",
       [] { return encode_sequence(corpus_sequence("cloth", 5), options_of(7, 7, Predictor::kPyramid, 3)); }},
      {"pyramid_hybrid", "predictor pyramid, two lattices",
       [] {
         return encode_sequence(corpus_sequence("cloth", 3), options_of(8, 6, Predictor::kPyramid, 50));
       }},
      {"pyramid_finest", "the pyramid on the finest lattice, 24 bits",
       [] {
         return encode_sequence(corpus_sequence("cloth", 2), options_of(24, 24, Predictor::kPyramid, 50));
       }},
      {"pyramid_soup", "the pyramid of all that a mesh can do wrong, its order given up", make_pyramid_soup},
      {"auto", "frames predicted by elp and by the pyramid by turns", make_auto},
      {"lossless", "mode lossless, several GOPs",
       [] { return encode_sequence(corpus_sequence("cloth", 4), lossless_options(3)); }},
      {"lossless_half", "mode lossless, numbers whose low bits are zero", make_lossless_half},
      {"lossless_multiples", "mode lossless, multiples of a power of two, and a vertex of no face",
       [] { return encode_sequence(triangle(9), lossless_options(50)); }},
      {"lossless_numbers", "mode lossless, numbers of all sizes and both signs", make_lossless_numbers},
      {"levels", "the pyramid of levels that know nothing of the mesh", make_levels},
      {"lods", "coarse meshes without a reference shape, two lattices",
       [] { return make_lods("soup", 6, options_of(6, 4, Predictor::kElp, 2)); }, true, 2},
      {"lods_lossless", "coarse meshes in mode lossless, the vertex order given up", make_lods_lossless, true,
       2},
      {"lods_basis", "mode basis in three parts, two lattices, several periods", make_lods_basis, false, 2},
      {"basis", "mode basis, several periods of several GOPs", [] { return make_basis(5, 5, 14, 7); }, false},
      {"basis_hybrid", "mode basis, two lattices", [] { return make_basis(7, 4, 6, 6); }, false},
      {"basis_error", "mode basis, a bound of the error, and a vertex of no face", make_basis_error, false},
      {"basis_and_elp", "a part in mode basis between others of the same mesh and of another",
       [] {
         return join({make_uniform("cloth", 2, 5, Predictor::kElp), make_basis(4, 4, 5, 5), make_step()});
       },
       false},
      {"attributes", "all kinds of attributes, with seams; parts and polygons; several frames and no shape",
       make_attributes},
      {"attributes_shape", "the same with a reference shape", make_attributes_shape},
      {"attributes_exact", "attributes of which every bit comes back, in mode lossless",
       make_attributes_exact},
      {"attributes_soup",
       "attributes, parts and polygons of all that a mesh can do wrong, its order given up",
       make_attributes_soup},
      {"animated",
       "attributes of vertices, corners and parts that change from frame to frame, and GOPs of them",
       make_animated},
      {"animated_shape", "animated attributes of a mesh with a reference shape", make_animated_shape},
      {"animated_exact", "exact animated attributes, lossless", make_animated_exact},
      {"shape", "frames by the shape, each of a mesh of its own, with polygons", make_shape},
      {"meshes_again", "two meshes in force, meshes that come again", make_meshes_again},
      {"unknown_chunk", "an ancillary chunk of a type that nobody knows",
       [] {
         constexpr std::array<std::uint8_t, 2> kNote = {'h', 'i'};
         return join({make_step()}, write_chunk({'n', 'o', 't', 'e'}, true, kNote));
       }},
  };
  return streams;
}

std::vector<std::uint8_t> make_stream(std::string_view name) {
  for (const ConformanceStream& stream : conformance_streams()) {
    if (stream.name == name) return stream.make();
  }
  stop("no stream " + std::string(name));
}

}  // namespace tvg::conformance
