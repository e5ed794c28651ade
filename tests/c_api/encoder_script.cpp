#include "c_api/encoder_script.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <tvg/stream_decoder.hpp>

namespace tvg::test {

namespace {

constexpr std::size_t kMostCalls = 64;
constexpr std::size_t kMostFrames = 100;
constexpr std::size_t kMostStreams = 3;
constexpr std::uint32_t kMostVertices = 40;
constexpr std::uint32_t kMostFaces = 60;

bool finite(const std::vector<float>& frame) {
  return std::all_of(frame.begin(), frame.end(), [](float x) { return std::isfinite(x); });
}

/// Codes after which others may follow as if nothing had been called.
bool changes_nothing(tvg_code code) {
  return code == TVG_ERROR_WRONG_STATE || code == TVG_ERROR_INVALID_ARGUMENT ||
         code == TVG_ERROR_INVALID_INPUT || code == TVG_ERROR_LIMIT_EXCEEDED;
}

/// Whether a decoded frame is where it should be, but for rounding to float32: within half a step or, of a
/// basis, within the largest error that was reported.
bool within_bounds(const std::vector<float>& original, const std::vector<float>& decoded,
                   const std::vector<std::uint8_t>& flags, const tvg_gop_info& gop, double largest_error) {
  for (std::size_t i = 0; i < original.size(); ++i) {
    const double half = (flags[i / 3] != 0 ? gop.fine_step : gop.coarse_step) / 2;
    const double bound = gop.mode == TVG_MODE_BASIS ? largest_error : half;
    const double rounding = (std::abs(double{original[i]}) + bound) * 0x1p-22 + bound * 1e-6 + 0x1p-149;
    if (!(std::abs(double{decoded[i]} - double{original[i]}) <= bound + rounding)) return false;
  }
  return true;
}

}  // namespace

std::string EncoderScript::run() {
  for (std::size_t call = 0; call < kMostCalls && at_ < bytes_.size() && broken_.empty(); ++call) {
    const std::uint8_t what = byte();
    const unsigned how = what >> 3;
    // The order of the cases is part of the corpus's meaning.
    switch (what & 7) {
      case 0:
        create(how);
        break;
      case 1:
        set_metadata(how);
        break;
      case 2:
        set_mesh(how);
        break;
      case 3:
        add_frame(wild_frame());
        break;
      case 4:
        add_frames(how);
        break;
      case 5:
        add_odd_frame(how);
        break;
      case 6:
        finish();
        break;
      default:
        (how & 1) != 0 ? join(how >> 1) : compare(how >> 1);
    }
  }
  finish();
  return broken_;
}

void EncoderScript::create(unsigned how) {
  const tvg_encoder_options options = read_options(how);
  writes_left_ = (how & 16) != 0 ? byte() : ~0u;
  stream_.clear();
  frames_.clear();
  faces_.clear();
  vertex_count_ = 0;
  lost_ = ended_ = false;
  reordered_ = options.reorder != 0;
  max_error_ = options.mode == TVG_MODE_BASIS ? options.max_error : 0;
  tvg_encoder* made = nullptr;
  promise(tvg_encoder_create(&options, take, this, &made) == TVG_OK && made != nullptr, "create makes one");
  encoder_.reset(made);
}

tvg_encoder_options EncoderScript::read_options(unsigned how) {
  tvg_encoder_options options = {};
  options.struct_size = sizeof options;
  promise(tvg_encoder_options_init(&options) == TVG_OK, "options have their usual values");
  options.gop_frames = 4;
  if ((how & 1) != 0) {
    options.fine_bits = byte() % 27u;
    options.coarse_bits = byte() % 27u;
  }
  if ((how & 2) != 0) options.step = number();
  if ((how & 4) != 0) {
    options.important_share = number();
    options.predictor = byte() % 5u;
    options.gop_frames = byte() % 12u;
    options.low_delay = byte() & 1u;
    options.reorder = byte() & 1u;
    options.first_frame = std::uint64_t{word()} << (byte() % 33u);
  }
  if ((how & 8) != 0) {
    options.threads = byte() % 4u;
    options.max_vertices = byte();
    options.max_faces = byte();
    options.has_box = byte() & 1u;
    for (double& side : options.box_low) side = number();
    for (double& side : options.box_high) side = number();
    options.max_meshes = byte() % 4u;
    if ((how & 4) == 0) options.mode = byte() % 4u;
  }
  if (options.mode == TVG_MODE_BASIS) {
    options.period_frames = byte() % 12u;
    options.effort = byte() % 11u;
    if ((byte() & 1u) != 0) options.max_error = number();
  }
  return options;
}

void EncoderScript::set_metadata(unsigned how) {
  const std::string key(how & 7, static_cast<char>(byte())), value(how >> 3, static_cast<char>(byte()));
  answered(tvg_encoder_set_metadata(encoder_.get(), key.c_str(), (how & 31) == 31 ? nullptr : value.c_str()));
}

void EncoderScript::add_properties(std::uint32_t vertices, std::uint32_t faces) {
  std::vector<float> values(256);
  for (float& value : values) value = static_cast<float>(static_cast<std::int8_t>(byte())) / 8;
  std::vector<std::uint32_t> numbers(3 * faces);
  for (std::uint32_t& value : numbers) value = byte() % 8u;
  tvg_attribute attribute = {};
  attribute.struct_size = sizeof attribute;
  attribute.kind = byte() % 5u;
  attribute.domain = byte() % 4u;
  attribute.components = byte() % 6u;
  attribute.bits = byte() % 34u;
  attribute.values = values.data();
  attribute.value_count = attribute.domain == TVG_DOMAIN_VERTEX ? vertices : byte() % 9u;
  attribute.corners = attribute.domain == TVG_DOMAIN_CORNER ? numbers.data() : nullptr;
  attribute.corner_count = attribute.domain == TVG_DOMAIN_CORNER ? numbers.size() : 0;
  if (const tvg_code code = tvg_encoder_add_attribute(encoder_.get(), &attribute); code != TVG_OK)
    answered(code);
  if ((byte() & 1u) == 0) return;
  const tvg_part_info part = {sizeof part, "object", nullptr, "material"};
  for (unsigned i = 0; i < 8; ++i) tvg_encoder_add_part(encoder_.get(), &part);
  tvg_encoder_set_face_parts(encoder_.get(), numbers.data(), faces);
  const tvg_polygon polygon = {byte() % 8u, byte() % 8u};
  if ((byte() & 1u) != 0) tvg_encoder_set_polygons(encoder_.get(), &polygon, 1);
}

void EncoderScript::set_mesh(unsigned how) {
  const std::uint32_t vertices = byte() % kMostVertices, face_count = byte() % kMostFaces;
  std::vector<std::uint32_t> faces(3 * face_count);
  bool inside = vertices > 0;
  for (std::uint32_t& corner : faces) {
    corner = (how & 3) == 3 ? byte() : byte() % std::max(vertices, 1u);
    inside = inside && corner < vertices;
  }
  const bool null = (how & 28) == 28;
  if ((how & 28) == 24) add_properties(vertices, face_count);
  const tvg_code code =
      tvg_encoder_set_mesh(encoder_.get(), vertices, null ? nullptr : faces.data(), face_count);
  if (code != TVG_OK) {
    tvg_encoder_clear_properties(encoder_.get());
    return answered(code);
  }
  promise(encoder_ && !lost_ && !ended_ && inside && (!null || face_count == 0),
          "no mesh is taken that makes no sense or comes out of turn");
  vertex_count_ = vertices;
  faces_ = std::move(faces);
}

void EncoderScript::add_frame(const std::vector<float>& frame) {
  if (frames_.size() == kMostFrames) return;
  const tvg_code code =
      tvg_encoder_add_frame(encoder_.get(), frame.data(), frame.size() * sizeof(float), 3 * sizeof(float));
  if (code != TVG_OK) return answered(code);
  promise(encoder_ && !lost_ && !ended_ && vertex_count_ > 0 && finite(frame),
          "no frame is taken that makes no sense or comes out of turn");
  frames_.push_back(frame);
}

void EncoderScript::add_frames(unsigned how) {
  const std::uint8_t seed = byte();
  for (unsigned number = 0; number <= how; ++number) add_frame(quiet_frame(seed, number));
}

/// A frame of a wrong size, of nothing, or with a stride.
void EncoderScript::add_odd_frame(unsigned how) {
  const std::vector<float> frame = quiet_frame(byte(), how);
  const std::size_t stride = how;
  std::vector<std::uint8_t> room(stride * vertex_count_ + 12);
  for (std::size_t v = 0; stride >= 12 && v < vertex_count_; ++v)
    std::memcpy(room.data() + v * stride, frame.data() + 3 * v, 12);
  // An exact copy, so that a read behind its end is seen.
  const std::size_t needed = vertex_count_ > 0 ? (vertex_count_ - 1) * stride + 12 : 0;
  const std::size_t size =
      std::min<std::size_t>(room.size(), needed - std::min<std::size_t>(needed, how & 1));
  const std::vector<std::uint8_t> exact(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(size));
  if (frames_.size() == kMostFrames) return;
  const tvg_code code =
      tvg_encoder_add_frame(encoder_.get(), (how & 30) == 30 ? nullptr : exact.data(), size, stride);
  if (code != TVG_OK) return answered(code);
  promise(size == needed && stride >= 12 && (how & 30) != 30, "no frame is taken that is not there");
  frames_.push_back(frame);
}

void EncoderScript::finish() {
  tvg_encode_report report = {};
  report.struct_size = sizeof report;
  const tvg_code code = tvg_encoder_finish(encoder_.get(), &report);
  if (code != TVG_OK) return answered(code);
  promise(!lost_ && !ended_ && !frames_.empty(), "only a stream with frames is finished, and once");
  promise(report.frames == frames_.size() && report.bytes == stream_.size(), "the report is true");
  promise(max_error_ == 0 || report.largest_error <= max_error_ * (1 + 1e-9),
          "no coordinate is off by more than was asked for");
  ended_ = true;
  largest_error_ = report.largest_error;
  auto decoded = decode(stream_, reordered_ ? nullptr : &frames_);
  if (!decoded) return;
  promise(decoded->size() == frames_.size(), "every frame comes back");
  if (finished_.size() == kMostStreams) finished_.erase(finished_.begin());
  finished_.push_back({stream_, std::move(*decoded)});
}

std::optional<std::vector<std::vector<float>>> EncoderScript::decode(
    const std::vector<std::uint8_t>& stream, const std::vector<std::vector<float>>* originals) {
  StreamDecoder decoder;
  decoder.push(stream.data(), stream.size());
  decoder.finish();
  std::vector<std::vector<float>> frames;
  for (tvg_event event = decoder.poll(); event != TVG_EVENT_END; event = decoder.poll()) {
    const bool whole = event != TVG_EVENT_ERROR && event != TVG_EVENT_DAMAGE && event != TVG_EVENT_NEED_BYTES;
    promise(whole, "a finished stream decodes: " + decoder.error_text() +
                       (event == TVG_EVENT_DAMAGE ? decoder.damage()->text : ""));
    if (!whole) return std::nullopt;
    if (event != TVG_EVENT_FRAME) continue;
    std::vector<float> positions(3 * std::size_t{decoder.mesh()->vertex_count});
    std::vector<std::uint8_t> flags(decoder.mesh()->vertex_count);
    promise(decoder.copy_positions(positions.data(), positions.size()) == TVG_OK &&
                decoder.copy_flags(flags.data(), flags.size()) == TVG_OK,
            "a frame can be had");
    if (originals != nullptr && frames.size() < originals->size()) {
      const std::vector<float>& original = (*originals)[frames.size()];
      promise(original.size() == positions.size() &&
                  within_bounds(original, positions, flags, *decoder.gop(), largest_error_),
              "no coordinate is off by more than is said");
    }
    frames.push_back(std::move(positions));
  }
  return frames;
}

void EncoderScript::compare(unsigned how) {
  tvg_comparer* made = nullptr;
  const auto face_count = static_cast<std::uint32_t>(faces_.size() / 3);
  const tvg_code code = tvg_comparer_create(vertex_count_, faces_.data(), face_count, &made);
  promise((code == TVG_OK) == (vertex_count_ > 0) && (made != nullptr) == (code == TVG_OK),
          "a mesh that can be encoded can be compared");
  std::uint64_t taken = 0;
  for (const Finished& stream : finished_) {
    for (std::size_t f = 0; f < std::min(frames_.size(), stream.decoded.size()); ++f) {
      // Frames of another size than the mesh's are refused.
      const std::size_t count = std::min(frames_[f].size(), stream.decoded[f].size());
      if (tvg_comparer_add_frame(made, frames_[f].data(), stream.decoded[f].data(),
                                 (how & 1) != 0 ? count / 2 : count) == TVG_OK)
        ++taken;
    }
  }
  tvg_comparison figures = {};
  figures.struct_size = (how & 2) != 0 ? byte() : sizeof figures;
  const std::size_t known = figures.struct_size;
  if (made != nullptr && tvg_comparer_get(made, &figures) == TVG_OK && known == sizeof figures)
    promise(figures.frames == taken && figures.max_distance >= 0, "the figures are those of the frames");
  tvg_comparer_destroy(made);
}

void EncoderScript::join(unsigned how) {
  std::vector<std::vector<std::uint8_t>> inputs;
  std::size_t frames = 0;
  for (const Finished& stream : finished_) {
    inputs.push_back(stream.bytes);
    frames += stream.decoded.size();
  }
  const bool cut = (how & 1) != 0 && !inputs.empty();
  if (cut) inputs.back().resize(inputs.back().size() * byte() / 256);
  std::vector<tvg_stream_bytes> streams;
  streams.reserve(inputs.size());
  for (const auto& input : inputs) streams.push_back({input.data(), input.size()});
  stream_.clear();
  if (!ended_) encoder_.reset();  // its bytes would go to the same place
  writes_left_ = ~0u;
  std::array<char, 64> text{};
  const tvg_code code =
      tvg_join(streams.data(), streams.size(), take, this, nullptr, text.data(), text.size());
  promise(std::memchr(text.data(), 0, text.size()) != nullptr, "a text ends");
  if (code != TVG_OK) {
    promise(inputs.empty() || cut, std::string("finished streams join: ") + text.data());
    return;
  }
  promise(!cut, "what is cut does not join");
  const auto decoded = decode(stream_, nullptr);
  if (!decoded || !broken_.empty()) return;
  promise(decoded->size() == frames, "every frame of every stream is there");
  auto frame = decoded->begin();
  for (const Finished& stream : finished_) {
    promise(std::equal(stream.decoded.begin(), stream.decoded.end(), frame), "joining changes no frame");
    frame += static_cast<std::ptrdiff_t>(stream.decoded.size());
  }
}

/// Vertices in a row of steps that sway a little from frame to frame.
std::vector<float> EncoderScript::quiet_frame(std::uint8_t seed, unsigned number) const {
  std::vector<float> frame(3 * std::size_t{vertex_count_});
  std::uint32_t noise = 1 + seed;
  for (float& x : frame) {
    noise = noise * 1664525 + 1013904223;
    const float place = static_cast<float>(noise >> 24), pace = static_cast<float>(noise >> 16 & 255);
    x = place - 128 + pace * static_cast<float>(number) / 64;
  }
  return frame;
}

/// A quiet frame with a few coordinates that may be anything at all.
std::vector<float> EncoderScript::wild_frame() {
  std::vector<float> frame = quiet_frame(byte(), 0);
  for (unsigned count = byte() % 4u; count > 0 && !frame.empty(); --count) {
    const std::size_t place = byte() % frame.size();
    const std::uint8_t kind = byte();
    frame[place] = kind < 128 ? static_cast<float>(number()) : std::bit_cast<float>(word());
  }
  return frame;
}

std::uint8_t EncoderScript::byte() {
  return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0};
}

std::uint32_t EncoderScript::word() {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | byte();
  return value;
}

/// Any binary64 at all, or more often one of those that people use.
double EncoderScript::number() {
  const std::uint8_t kind = byte();
  if (kind >= 224) return std::bit_cast<double>(std::uint64_t{word()} << 32 | word());
  return std::ldexp(static_cast<std::int8_t>(byte()), kind / 4 - 28);
}

void EncoderScript::answered(tvg_code code) {
  if (code == TVG_OK) {
    promise(encoder_ && !lost_ && !ended_,
            "nothing is taken without an encoder, after the end, or once lost");
    return;
  }
  promise(encoder_ != nullptr || code == TVG_ERROR_INVALID_ARGUMENT, "no encoder is an invalid argument");
  promise(std::strlen(tvg_encoder_error_text(encoder_.get())) > 0, "an error has a text");
  if (!changes_nothing(code)) {
    promise(lost_ || writes_left_ == 0, "a stream is lost only where its sink gave up");
    lost_ = true;
  }
}

void EncoderScript::promise(bool kept, const std::string& what) {
  if (!kept && broken_.empty()) broken_ = what;
}

int EncoderScript::take(void* user, const void* bytes, std::size_t size) {
  auto& script = *static_cast<EncoderScript*>(user);
  if (script.writes_left_ == 0) return 1;
  --script.writes_left_;
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  script.stream_.insert(script.stream_.end(), first, first + size);
  return 0;
}

}  // namespace tvg::test
