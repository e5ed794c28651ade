#include "encoder/importers/cache_source.hpp"

#include "encoder/importers/bytes.hpp"
#include "encoder/importers/frame_times.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/input_file.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/npy_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <vector>

namespace tvg::cli {

namespace {

constexpr std::size_t kPc2HeaderSize = 32;
constexpr std::size_t kMddHeaderSize = 8;  // without the times
constexpr char kPc2Signature[12] = {'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', '\0'};
constexpr std::size_t kPositionSize = 3 * sizeof(float);
constexpr std::uint64_t kUnknownCount = 0xffffffff;  // -1

struct CacheLayout {
  bool is_pc2 = false;  // else MDD, all of it big-endian
  bool half = false;    // positions are float16
  std::uint64_t points = 0;
  std::uint64_t frames = 0;
  std::uint64_t data_offset = 0;  // of the first frame

  std::uint64_t frame_size() const { return points * (half ? kPositionSize / 2 : kPositionSize); }
  std::uint64_t file_size() const { return data_offset + frames * frame_size(); }
};

class CacheSource final : public FrameSource {
 public:
  CacheSource(const std::string& path, Mesh mesh, Metadata metadata, std::string mesh_file,
              std::vector<std::string>& notes, const CacheOptions& options)
      : file_(path),
        mesh_(std::move(mesh)),
        metadata_(std::move(metadata)),
        mesh_file_(std::move(mesh_file)),
        named_pc2_(has_suffix(path, ".pc2") || has_suffix(path, ".pc16")),
        open_ended_(options.open_ended && !file_.size()),
        given_rate_(options.frame_rate) {
    layout_.half = has_suffix(path, ".pc16");
    read_header(notes);
  }

  const Mesh& mesh() const override { return mesh_; }
  Metadata metadata() const override { return metadata_; }
  std::span<const NamedData> data() const override { return data_; }
  std::optional<std::uint64_t> frame_count() const override {
    if (open_ended_) return std::nullopt;
    return layout_.frames;
  }
  Result<bool> read_frame(std::span<float> positions) override;
  Status skip_frames(std::uint64_t count) override;
  bool rewind() override;

 private:
  void read_header(std::vector<std::string>& notes);
  void read_pc2_header(std::span<char> header);
  void take_pc2_start(float frame, std::vector<std::string>& notes);
  void read_mdd_times(std::vector<std::string>& notes);
  void count_unfinished(std::vector<std::string>& notes);
  void check_counts(std::int64_t points, std::int64_t frames) const;
  void check_size(std::vector<std::string>& notes) const;
  bool read_positions(std::span<float> positions);
  [[noreturn]] void fail(const std::string& what) const {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", file_.name(), what));
  }
  [[noreturn]] void fail_at_end(std::uint64_t size, const std::string& place) const {
    throw ImportError(ErrorCode::kTruncated,
                      fmt::format("{} ends at byte {} inside {}", file_.name(), size, place));
  }
  std::string promise() const {
    if (open_ended_) return fmt::format("a frame has {} bytes", layout_.frame_size());
    return fmt::format("its header promises {} frames = {} bytes", layout_.frames, layout_.file_size());
  }

  InputFile file_;
  Mesh mesh_;
  Metadata metadata_;
  std::string mesh_file_;
  bool named_pc2_;
  bool open_ended_;  // of a PC2 cache: frames come until the input ends
  double given_rate_;
  std::vector<NamedData> data_;
  CacheLayout layout_;
  std::uint64_t next_ = 0;  // frame
};

void CacheSource::read_header(std::vector<std::string>& notes) {
  std::array<char, kPc2HeaderSize> header{};
  std::size_t got = file_.read(header.data(), kMddHeaderSize);
  if (got == 0) fail("the file is empty");
  layout_.is_pc2 = std::memcmp(header.data(), kPc2Signature, got) == 0;
  if (got == kMddHeaderSize && layout_.is_pc2) {
    got += file_.read(header.data() + got, kPc2HeaderSize - got);
  }
  const std::size_t needed = layout_.is_pc2 ? kPc2HeaderSize : kMddHeaderSize;
  if (got < needed) fail_at_end(got, fmt::format("its header of {} bytes", needed));
  if (const auto content = recognize_content({header.data(), got}); content && !layout_.is_pc2) {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{} is {}, not a cache", file_.name(), *content));
  }
  if (!layout_.is_pc2 && named_pc2_) fail("a PC2 cache begins with POINTCACHE2 and a zero byte");
  if (layout_.is_pc2) {
    read_pc2_header(header);
    count_unfinished(notes);
    check_counts(static_cast<std::int32_t>(layout_.points), static_cast<std::int32_t>(layout_.frames));
    check_size(notes);
    take_pc2_start(load<float>(header.data() + 20, false), notes);
  } else {
    open_ended_ = false;  // the table of times has an end
    layout_.frames = load<std::uint32_t>(header.data(), true);
    layout_.points = load<std::uint32_t>(header.data() + 4, true);
    check_counts(load<std::int32_t>(header.data() + 4, true), load<std::int32_t>(header.data(), true));
    layout_.data_offset = kMddHeaderSize + sizeof(float) * layout_.frames;
    check_size(notes);
    read_mdd_times(notes);
  }
}

void CacheSource::read_pc2_header(std::span<char> header) {
  if (std::memcmp(header.data(), kPc2Signature, sizeof kPc2Signature) != 0) {
    fail("a PC2 cache begins with POINTCACHE2 and a zero byte");
  }
  const auto version = load<std::int32_t>(header.data() + 12, false);
  if (version != 1) fail(fmt::format("PC2 version {}, but only version 1 is known", version));
  layout_.points = load<std::uint32_t>(header.data() + 16, false);
  layout_.frames = load<std::uint32_t>(header.data() + 28, false);
  layout_.data_offset = kPc2HeaderSize;
}

/// Programs begin with frame 0 or 1, so of these nothing is said.
void CacheSource::take_pc2_start(float frame, std::vector<std::string>& notes) {
  if (!std::isfinite(frame) || frame == 0) return;
  if (given_rate_ > 0) {
    metadata_.emplace("start", fmt::format("{:.9g}", double{frame} / given_rate_));
  } else if (frame != 1) {
    notes.push_back(fmt::format("{}: it begins with frame {:.6g}, and when that is, is kept with --fps only",
                                file_.name(), frame));
  }
}

/// A program that writes a PC2 front to back fills in the number of frames at the end; where it did not get
/// there, the header has 0 or -1, and the size of the file tells.
void CacheSource::count_unfinished(std::vector<std::string>& notes) {
  if (open_ended_ || !file_.size() || (layout_.frames != 0 && layout_.frames != kUnknownCount)) return;
  if (layout_.points != mesh_.vertex_count || layout_.points == 0) return;
  const std::string said = layout_.frames == 0 ? "0" : "-1";
  const std::uint64_t held =
      (std::max(*file_.size(), layout_.data_offset) - layout_.data_offset) / layout_.frame_size();
  if (held == 0) return;
  layout_.frames = held;
  notes.push_back(
      fmt::format("{}: its header says {} frames, which was never put right: {} follow and are taken",
                  file_.name(), said, held));
}

void CacheSource::check_counts(std::int64_t points, std::int64_t frames) const {
  const char* format = layout_.is_pc2 ? "PC2" : "MDD";
  if (points != static_cast<std::int64_t>(mesh_.vertex_count)) {
    fail(fmt::format(
        "read as {}, its header says {} points per frame and {} frames, but {} has {} vertices: a cache "
        "needs the mesh it was made with",
        format, points, frames, mesh_file_, mesh_.vertex_count));
  }
  if (open_ended_) return;
  if (frames < 0) fail(fmt::format("read as {}, its header says {} frames", format, frames));
  if (frames == 0) fail("it holds no frames");
}

void CacheSource::check_size(std::vector<std::string>& notes) const {
  if (!file_.size()) return;
  const std::uint64_t size = *file_.size();
  if (size < layout_.data_offset) fail_at_end(size, "its table of times; " + promise());
  if (size < layout_.file_size()) {
    const std::uint64_t frame = (size - layout_.data_offset) / layout_.frame_size();
    fail_at_end(size, fmt::format("frame {}; {}", frame, promise()));
  }
  if (size > layout_.file_size()) {
    notes.push_back(
        fmt::format("{}: {} bytes follow byte {}, where the file should end, and are left out: {}",
                    file_.name(), size - layout_.file_size(), layout_.file_size(), promise()));
  }
}

void CacheSource::read_mdd_times(std::vector<std::string>& notes) {
  std::array<char, 4096> block;
  FrameTimes times;
  for (std::uint64_t done = 0; done < layout_.frames;) {
    const auto wanted = std::min<std::uint64_t>(block.size() / sizeof(float), layout_.frames - done);
    const std::size_t got = file_.read(block.data(), wanted * sizeof(float));
    if (got < wanted * sizeof(float)) {
      fail_at_end(kMddHeaderSize + done * sizeof(float) + got, "its table of times; " + promise());
    }
    for (std::size_t i = 0; i < wanted; ++i) times.add(load<float>(block.data() + sizeof(float) * i, true));
    done += wanted;
  }
  if (const std::string fps = times.rate(); !fps.empty()) metadata_.emplace("fps", fps);
  if (const std::string start = times.start(given_rate_); !start.empty()) metadata_.emplace("start", start);
  const std::size_t uneven = times.first_uneven();
  if (uneven == layout_.frames) return;
  if (given_rate_ > 0) {
    notes.push_back(fmt::format("{}: its times, {}, are uneven from frame {} on, and give way to --fps",
                                file_.name(), times.span(), uneven));
  } else if (!times.rise()) {
    notes.push_back(fmt::format(
        "{}: its times, {}, do not rise from frame to frame, and are left out: --fps says the rate",
        file_.name(), times.span()));
  } else {
    data_.push_back(times.data());
    notes.push_back(
        fmt::format("{}: its times, {}, are uneven from frame {} on: the time of each frame is kept",
                    file_.name(), times.span(), uneven));
  }
}

Result<bool> CacheSource::read_frame(std::span<float> positions) {
  try {
    return read_positions(positions);
  } catch (const ImportError& error) {
    return error.as_value();
  }
}

bool CacheSource::read_positions(std::span<float> positions) {
  if (next_ == layout_.frames && !open_ended_) {
    char extra = 0;
    if (!file_.size() && file_.read(&extra, 1) != 0) {
      fail(
          fmt::format("bytes follow byte {}, where the data should end: {}", layout_.file_size(), promise()));
    }
    return false;
  }
  const std::size_t bytes = layout_.half ? positions.size_bytes() / 2 : positions.size_bytes();
  // Of float16 the bytes go to the second half, so that widening them front to back runs over none unread.
  char* const raw = reinterpret_cast<char*>(positions.data()) + (positions.size_bytes() - bytes);
  const std::size_t got = file_.read(raw, bytes);
  if (got == 0 && open_ended_) return false;
  if (got < bytes) {
    fail_at_end(layout_.data_offset + next_ * layout_.frame_size() + got,
                fmt::format("frame {}; {}", next_, promise()));
  }
  const bool big_endian = !layout_.is_pc2;
  if (layout_.half) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] = widened(load<std::uint16_t>(raw + 2 * i, false));
  } else if (big_endian != (std::endian::native == std::endian::big)) {
    for (float& value : positions) value = byte_swapped(value);
  }
  const std::size_t bad = find_non_finite(positions);
  if (bad < positions.size()) {
    fail(fmt::format(
        "frame {}, vertex {} has a coordinate that is NaN or infinite (byte {})", next_, bad / 3,
        layout_.data_offset + next_ * layout_.frame_size() + bad * (layout_.half ? 2 : sizeof(float))));
  }
  ++next_;
  return true;
}

Status CacheSource::skip_frames(std::uint64_t count) {
  try {
    if (file_.size()) {
      next_ += count;
      file_.seek(layout_.data_offset + next_ * layout_.frame_size());
      return {};
    }
    std::array<char, std::size_t{1} << 14> block;
    const std::uint64_t start = layout_.data_offset + next_ * layout_.frame_size();
    const std::uint64_t length = count * layout_.frame_size();
    for (std::uint64_t done = 0; done < length;) {
      const auto wanted = std::min<std::uint64_t>(block.size(), length - done);
      const std::size_t got = file_.read(block.data(), wanted);
      done += got;
      if (got < wanted) {
        fail_at_end(start + done,
                    fmt::format("frame {}; {}", next_ + done / layout_.frame_size(), promise()));
      }
    }
    next_ += count;
    return {};
  } catch (const ImportError& error) {
    return error.as_value();
  }
}

bool CacheSource::rewind() {
  if (!file_.size()) return false;
  next_ = 0;
  return skip_frames(0).ok();
}

}  // namespace

std::unique_ptr<FrameSource> open_cache(const std::string& path, Mesh mesh, Metadata metadata,
                                        const std::string& mesh_file, std::vector<std::string>& notes,
                                        const CacheOptions& options) {
  if (has_suffix(path, ".npy")) return open_npy(path, std::move(mesh), std::move(metadata), mesh_file);
  if (has_suffix(path, ".npz")) return open_npz(path, mesh, metadata, mesh_file, options.array);
  return std::make_unique<CacheSource>(path, std::move(mesh), std::move(metadata), mesh_file, notes, options);
}

}  // namespace tvg::cli
