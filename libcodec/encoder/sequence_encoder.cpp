#include "encoder/sequence_encoder.hpp"

#include "base/errors.hpp"
#include "container/chunk.hpp"
#include "encoder/effort.hpp"
#include "encoder/encode_checks.hpp"
#include "encoder/property_checks.hpp"
#include "modes/gop_encoder.hpp"
#include "modes/gop_mesh_encode.hpp"
#include "quantization/lattice_over_encode.hpp"
#include "source/source_checks.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

namespace tvg {

namespace {

/// What no coordinate may be off by more, in steps of the lattice, if that is asked for.
std::optional<double> half_step_of(const EncodeOptions& options) {
  return options.max_error ? std::optional(0.5) : std::nullopt;
}

/// A largest error is half a step.
EncodeOptions with_step(EncodeOptions options) {
  if (options.max_error && !options.max_error->of_diagonal && !options.step)
    options.step = 2 * options.max_error->value;
  return options;
}

Error no_memory() {
  return out_of_memory("there is not enough memory: use fewer frames per GOP or fewer threads");
}

BoundingBox around(BoundingBox box, const BoundingBox& more) {
  box.extend(more.low()[0], more.low()[1], more.low()[2]);
  box.extend(more.high()[0], more.high()[1], more.high()[2]);
  return box;
}

bool holds(const BoundingBox& outer, const BoundingBox& inner) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (inner.low()[axis] < outer.low()[axis] || inner.high()[axis] > outer.high()[axis]) return false;
  }
  return true;
}

}  // namespace

/// What the GOPs of one mesh share, until the last of them is encoded.
struct SequenceEncoder::Stretch {
  Stretch(Mesh given, Skeleton joints, MeshProperties beside,
          std::shared_ptr<const EncodeOptions> encode_options)
      : options(std::move(encode_options)),
        mesh(std::move(given)),
        skeleton(std::move(joints)),
        properties(std::move(beside)),
        measurer(mesh, skeleton, options->importance) {}
  Stretch(const Stretch&) = delete;
  Stretch& operator=(const Stretch&) = delete;

  std::shared_ptr<const EncodeOptions> options;
  Mesh mesh;
  Skeleton skeleton;
  MeshProperties properties;
  EncodedGopMesh encoded;  ///< once the mesh is written
  Measurer measurer;
  std::uint64_t shaped_by = 0;  ///< of a part, as MeshPast has it
};

/// One GOP on its way: what is to be encoded, and what marks it.
struct SequenceEncoder::Job {
  GopContent gop;
  std::shared_ptr<const Stretch> stretch;
  Lattice lattice;
  StreamLimits limits;
};

/// Algorithm 1, then the chunks.
Result<EncodedRun> SequenceEncoder::mark_and_encode(const Job& job) {
  GopInput input{.frames = job.gop.content->frames,
                 .values = job.gop.content->values,
                 .mode = job.stretch->options->mode,
                 .first_frame = job.gop.first_frame,
                 .lattice = job.lattice,
                 .flags = {},
                 .predictor = job.stretch->options->predictor,
                 .basis = {}};
  const EncodeOptions& options = *job.stretch->options;
  input.basis = {options.gop_frames, half_step_of(options), effort_of(options.effort).fit};
  if (job.lattice.hybrid()) {
    const GopFrames& seen = *job.gop.marked_by;
    Result<Measure> measured = job.stretch->measurer.measure(seen.frames, seen.joints);
    if (!measured) return measured.error();
    input.flags = std::move(measured->flags);
  }
  return encode_run(input, job.stretch->encoded.mesh, job.limits);
}

SequenceEncoder::SequenceEncoder(EncodeOptions options, ByteSink sink, EncodeProgress progress)
    : options_(std::make_shared<const EncodeOptions>(with_step(std::move(options)))),
      progress_(std::move(progress)),
      writer_(std::move(sink)),
      queue_(std::max(1u, options_->threads)),
      with_joints_(uses_skeleton(options_->importance)) {
  report_.box_of_each_gop = needs_box(*options_) && !options_->box && !options_->step;
}

Status SequenceEncoder::set_mesh(const Mesh& mesh, const Skeleton& skeleton,
                                 const MeshProperties& properties) {
  if (Status status = check_new_mesh(mesh, skeleton, properties, !stretch_); !status.ok()) return status;
  return lasting([&] {
    MeshProperties settled = with_settled_bits(properties, options_->attribute_bits);
    std::shared_ptr<Stretch> stretch = in_force(mesh, skeleton, settled);
    const bool is_known = stretch != nullptr;
    if (!is_known) stretch = std::make_shared<Stretch>(mesh, skeleton, std::move(settled), options_);
    return begin_stretch(std::move(stretch), is_known,
                         GopCutter(frames_at_once(*options_), options_->importance.low_delay));
  });
}

Status SequenceEncoder::set_mesh(const Mesh& mesh, const Skeleton& skeleton, const MeshProperties& properties,
                                 const MeshPast& past) {
  const bool leads = past.first_frame == 0;
  if (Status status = check_new_mesh(mesh, skeleton, properties, leads); !status.ok()) return status;
  return lasting([&] {
    std::shared_ptr<Stretch> stretch = in_force(past.shaped_by);
    const bool is_known = stretch != nullptr;
    if (!is_known) {
      stretch = std::make_shared<Stretch>(mesh, skeleton,
                                          with_settled_bits(properties, options_->attribute_bits), options_);
      stretch->shaped_by = past.shaped_by;
    }
    if (!stretch_) {
      frames_before_ = past.first_frame;
      first_frame_ = past.first_frame + past.frames_before;
    }
    Status status = begin_stretch(std::move(stretch), is_known,
                                  GopCutter(frames_at_once(*options_), options_->importance.low_delay,
                                            past.frames_before, past.gop_before));
    return !status.ok() || mesh_written_ || past.shape.empty() ? status : write_mesh(past.shape);
  });
}

Status SequenceEncoder::add_frame(std::span<const float> positions, std::span<const float> joints,
                                  std::span<const std::span<const float>> values) {
  BoundingBox frame_box;
  frame_box.extend(positions);
  if (Status status = check_new_frame(positions, joints, frame_box); !status.ok()) return status;
  if (Status status = check_animated(stretch_->properties, stretch_->mesh, values, frames_added());
      !status.ok())
    return status;
  return lasting([&] {
    if (!mesh_written_) {
      if (Status status = write_mesh(positions); !status.ok()) return status;
    }
    std::vector<float> kept;
    if (with_joints_) kept.assign(joints.begin(), joints.end());
    gop_box_ = around(gop_box_, frame_box);
    report_.vertex_frames += stretch_->mesh.vertex_count;
    std::optional<GopContent> gop = cutter_->add(FramePositions(positions.begin(), positions.end()),
                                                 std::move(kept), animated_of(stretch_->properties, values));
    if (gop) {
      if (Status status = enqueue(std::move(*gop)); !status.ok()) return status;
    }
    return write_what_is_done();
  });
}

Result<EncodeReport> SequenceEncoder::finish() {
  if (Status status = check_open(); !status.ok()) return status.error();
  if (!stretch_) return Error{ErrorCode::kWrongState, "there is no mesh yet"};
  if (frames_added() == first_frame_) return invalid_input("the sequence has no frames");
  Status status = lasting([&] {
    if (Status flushed = flush(); !flushed.ok()) return flushed;
    return writer_.write_end();
  });
  if (!status.ok()) return status.error();
  finished_ = true;
  report_.bytes = writer_.offset();
  report_.meshes = writer_.meshes();
  return report_;
}

Status SequenceEncoder::check_open() const {
  if (lost_) return *lost_;
  if (finished_) return Error{ErrorCode::kWrongState, "the stream is finished"};
  return {};
}

/// `leads`: this is the first mesh of the whole sequence.
Status SequenceEncoder::check_new_mesh(const Mesh& mesh, const Skeleton& skeleton,
                                       const MeshProperties& properties, bool leads) const {
  if (Status status = check_open(); !status.ok()) return status;
  if (stretch_ && cutter_->frames() == 0)
    return Error{ErrorCode::kWrongState, "the mesh before this one has no frames"};
  if (!stretch_) {
    if (Status status = check_pushed(*options_); !status.ok()) return status;
  }
  if (Status status = check_mesh(mesh); !status.ok()) return status;
  if (Status status = leads ? check_levels(options_->levels.get(), mesh) : Status(); !status.ok())
    return status;
  if (stretch_ && (mesh.vertex_count > limits_.vertices || mesh.faces.size() > limits_.faces)) {
    return Error{ErrorCode::kLimitExceeded,
                 "from frame " + std::to_string(frames_added()) + " on the mesh has " +
                     std::to_string(mesh.vertex_count) + " vertices and " +
                     std::to_string(mesh.faces.size()) + " faces, the head declares " +
                     std::to_string(limits_.vertices) + " and " + std::to_string(limits_.faces) +
                     ": say before what the largest will have (--max-vertices and --max-faces of the tool)"};
  }
  if (Status status = check_properties(properties, mesh, options_->attribute_bits); !status.ok())
    return status;
  if (stretch_) {
    Status status = check_property_bounds(properties, mesh, limits_.property_bytes, frame_bytes_);
    if (!status.ok()) return status;
  }
  return check_importance(options_->importance, mesh, skeleton);
}

Status SequenceEncoder::check_new_frame(std::span<const float> positions, std::span<const float> joints,
                                        const BoundingBox& frame_box) const {
  if (Status status = check_open(); !status.ok()) return status;
  if (!stretch_) return Error{ErrorCode::kWrongState, "there is no mesh yet"};
  const std::uint64_t number = frames_added();
  if (positions.size() != 3 * std::size_t{stretch_->mesh.vertex_count}) {
    return at_frame(number,
                    invalid_argument("the frame has " + std::to_string(positions.size() / 3) +
                                     " vertices, the mesh " + std::to_string(stretch_->mesh.vertex_count)));
  }
  if (Status status = check_frame(positions, number); !status.ok()) return status;
  if (options_->box && !holds(*options_->box, frame_box))
    return at_frame(number, invalid_input("the frame leaves the box that was declared"));
  if (options_->step && !options_->box) {
    const Result<Lattice> lattice = lattice_for(around(gop_box_, frame_box));
    if (!lattice) return at_frame(number, lattice.error());
  }
  return with_joints_ ? check_joints(joints, stretch_->skeleton, number) : Status();
}

template <class Work>
Status SequenceEncoder::lasting(Work work) {
  Status status;
  try {
    lost_ = Error{ErrorCode::kIo, "the stream is lost: the sink did not come back"};
    status = work();
  } catch (const std::bad_alloc&) {
    status = no_memory();
  }
  lost_.reset();
  if (!status.ok()) lost_ = status.error();
  return status;
}

Status SequenceEncoder::write_start(const Stretch& first) {
  frame_bytes_ = std::max<std::uint64_t>(animated_frame_bytes_of(first.properties, first.mesh),
                                         options_->max_animated_frame_bytes);
  limits_ = limits_for(first.mesh, *options_, property_bytes_of(first.properties, first.mesh), frame_bytes_);
  report_.vertices = first.mesh.vertex_count;
  return writer_.write_start(limits_, options_->metadata, options_->data);
}

Status SequenceEncoder::begin_stretch(std::shared_ptr<Stretch> stretch, bool is_known, GopCutter cutter) {
  if (Status status = stretch_ ? flush() : write_start(*stretch); !status.ok()) return status;
  frames_before_ = frames_added();
  stretch_ = std::move(stretch);
  cutter_.emplace(std::move(cutter));
  mesh_written_ = is_known;
  return is_known || needs_shape(*options_) ? Status() : write_mesh({});
}

std::shared_ptr<SequenceEncoder::Stretch> SequenceEncoder::in_force(const Mesh& mesh,
                                                                    const Skeleton& skeleton,
                                                                    const MeshProperties& properties) const {
  const auto same = [&](const std::shared_ptr<Stretch>& known) {
    return known->mesh == mesh && known->skeleton == skeleton && known->properties == properties &&
           writer_.mesh_in_force(known->encoded.mesh.coded.id);
  };
  const auto known = std::find_if(known_.begin(), known_.end(), same);
  return known == known_.end() ? nullptr : *known;
}

std::shared_ptr<SequenceEncoder::Stretch> SequenceEncoder::in_force(std::uint64_t shaped_by) const {
  const auto same = [&](const std::shared_ptr<Stretch>& known) {
    return known->shaped_by == shaped_by && writer_.mesh_in_force(known->encoded.mesh.coded.id);
  };
  const auto known = std::find_if(known_.begin(), known_.end(), same);
  return known == known_.end() ? nullptr : *known;
}

Status SequenceEncoder::write_mesh(std::span<const float> first_frame) {
  EncodedMesh connectivity = encode_mesh(stretch_->mesh, options_->keep_vertex_order,
                                         frames_before_ == 0 ? options_->levels.get() : nullptr);
  if (needs_shape(*options_)) {
    const bool is_frame = options_->predictor == Predictor::kShape;
    BoundingBox box;
    box.extend(first_frame);
    const Result<Lattice> lattice = is_frame ? lattice_for(options_->box.value_or(box)) : Lattice();
    if (!lattice) return lattice.error();
    Result<EncodedGopMesh> encoded =
        finish_mesh(std::move(connectivity), first_frame, shape_cell(*options_, first_frame),
                    is_frame ? kMinPyramidNeighbours : effort_of(options_->effort).neighbours,
                    stretch_->properties, is_frame ? &*lattice : nullptr);
    if (!encoded) return encoded.error();
    stretch_->encoded = std::move(*encoded);
  } else {
    stretch_->encoded = finish_mesh(std::move(connectivity), stretch_->properties);
  }
  const std::vector<std::uint8_t> payload = std::move(stretch_->encoded.payload);
  if (payload.size() > limits_.mesh_bytes)
    return Error{ErrorCode::kLimitExceeded, "the mesh is coded in more bytes than the head declares"};
  report_.polygons_left_out += stretch_->encoded.polygons_left_out;
  mesh_written_ = true;
  known_.push_back(stretch_);
  if (known_.size() > limits_.meshes) known_.pop_front();
  return writer_.write_mesh_chunk(write_chunk(kMeshChunk, false, payload));
}

Status SequenceEncoder::enqueue(GopContent gop) {
  const BoundingBox gop_box = std::exchange(gop_box_, BoundingBox());
  const Result<Lattice> lattice =
      options_->mode == Mode::kLossless ? Lattice() : lattice_for(options_->box.value_or(gop_box));
  if (!lattice) return lattice.error();
  while (queue_.full()) {
    if (Status status = write(queue_.take_or_make_room()); !status.ok()) return status;
  }
  gop.first_frame += options_->first_frame + frames_before_;
  queue_.add([job = Job{std::move(gop), stretch_, *lattice, limits_}] { return mark_and_encode(job); });
  return {};
}

Status SequenceEncoder::flush() {
  if (std::optional<GopContent> gop = cutter_->flush()) {
    if (Status status = enqueue(std::move(*gop)); !status.ok()) return status;
  }
  while (std::optional<Result<EncodedRun>> done = queue_.take_next()) {
    if (Status status = write(std::move(done)); !status.ok()) return status;
  }
  return {};
}

Status SequenceEncoder::write_what_is_done() {
  while (std::optional<Result<EncodedRun>> done = queue_.take()) {
    if (Status status = write(std::move(done)); !status.ok()) return status;
  }
  return {};
}

Status SequenceEncoder::write(std::optional<Result<EncodedRun>> done) {
  if (!done) return {};
  if (!*done) return done->error();
  const EncodedRun& run = **done;
  for (const std::vector<std::uint8_t>& plan : run.plans) {
    if (Status status = writer_.write_plan_chunk(plan); !status.ok()) return status;
  }
  report_.largest_error = std::max(report_.largest_error, run.largest_error);
  for (const EncodedGop& gop : run.gops) {
    if (Status status = writer_.write_gop_chunk(gop.chunk, gop.frame_count); !status.ok()) return status;
    report_.frames += gop.frame_count;
    ++report_.gops;
    if (progress_) progress_(report_.frames, std::nullopt);
  }
  return {};
}

Result<Lattice> SequenceEncoder::lattice_for(const BoundingBox& box) const {
  return lattice_over(box, options_->fine_bits, options_->coarse_bits, options_->step);
}

}  // namespace tvg
