#include "encoder/importers/npy_source.hpp"

#include "encoder/importers/array_file.hpp"
#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace tvg::cli {

namespace {

class NpySource final : public FrameSource {
 public:
  NpySource(std::unique_ptr<ArrayFile> file, Mesh mesh, Metadata metadata, std::string mesh_file)
      : file_(std::move(file)),
        mesh_(std::move(mesh)),
        metadata_(std::move(metadata)),
        mesh_file_(std::move(mesh_file)) {
    read_header();
  }

  const Mesh& mesh() const override { return mesh_; }
  Metadata metadata() const override { return metadata_; }
  std::optional<std::uint64_t> frame_count() const override { return frames_; }
  Result<bool> read_frame(std::span<float> positions) override {
    try {
      return read(positions);
    } catch (const ImportError& error) {
      return error.as_value();
    }
  }
  Status skip_frames(std::uint64_t count) override {
    try {
      next_ += count;
      file_->seek(data_offset_ + next_ * frame_size());
      return {};
    } catch (const ImportError& error) {
      return error.as_value();
    }
  }
  bool rewind() override {
    next_ = 0;
    return skip_frames(0).ok();
  }

 private:
  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::kInvalidInput) const {
    throw ImportError(code, fmt::format("{}: {}", file_->name(), what));
  }
  std::uint64_t frame_size() const { return 3 * std::uint64_t{mesh_.vertex_count} * number_size_; }

  void read_header();
  void take_type(std::string_view type);
  void take_shape(std::string_view shape);
  bool read(std::span<float> positions);
  float number_at(const char* bytes) const;

  std::unique_ptr<ArrayFile> file_;
  Mesh mesh_;
  Metadata metadata_;
  std::string mesh_file_;
  bool big_endian_ = false;
  std::size_t number_size_ = 4;
  std::uint64_t frames_ = 0;
  std::uint64_t data_offset_ = 0;
  std::uint64_t next_ = 0;
  std::vector<char> bytes_;  // of one frame
};

/// What stands behind a key in the header, a Python dictionary: of a text or a tuple what is in it.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(fmt::format("'{}'", key));
  if (at == header.npos) return {};
  const std::size_t begin = header.find_first_not_of(": ", at + key.size() + 2);
  if (begin == header.npos) return {};
  const std::string_view value = header.substr(begin);
  if (value[0] == '(') return value.substr(1, value.find(')') - 1);
  if (value[0] == '\'') return value.substr(1, value.find('\'', 1) - 1);
  return value.substr(0, value.find_first_of(",} "));
}

void NpySource::read_header() {
  constexpr std::string_view kMagic("\x93NUMPY", 6);
  constexpr std::size_t kLongestHeader = 10000;  // NumPy itself refuses longer ones
  std::array<char, 12> start{};
  std::size_t got = file_->read(start.data(), 10);
  if (std::string_view(start.data(), got).substr(0, 6) != kMagic || got < 10) {
    fail("it does not begin with NumPy's signature");
  }
  const int version = start[6];
  if (version < 1 || version > 3) fail(fmt::format("version {} of NumPy's format is not read", version));
  if (version > 1) got += file_->read(start.data() + 10, 2);
  const std::size_t length = version == 1 ? load<std::uint16_t>(start.data() + 8, false)
                                          : load<std::uint32_t>(start.data() + 8, false);
  if (length > kLongestHeader) fail(fmt::format("its header claims {} bytes", length));
  std::string header(length, ' ');
  if (file_->read(header.data(), length) < length) fail("it ends in its header", ErrorCode::kTruncated);
  data_offset_ = got + length;
  if (!is_plain_text(std::string_view(header).substr(0, header.find('\n')))) fail("its header is no text");
  take_type(value_of(header, "descr"));
  if (value_of(header, "fortran_order") != "False") {
    fail("it is in Fortran's order: save it in C's order, numpy.ascontiguousarray(a)");
  }
  take_shape(value_of(header, "shape"));
  const std::uint64_t held = (file_->size() - std::min(file_->size(), data_offset_)) / frame_size();
  const std::uint64_t whole = data_offset_ + std::min(frames_, held + 1) * frame_size();
  if (held < frames_) {
    fail(fmt::format("it ends at byte {} inside frame {}; its header promises {} frames", file_->size(), held,
                     frames_),
         ErrorCode::kTruncated);
  }
  if (file_->size() > whole)
    fail(fmt::format("{} bytes follow its {} frames", file_->size() - whole, frames_));
}

void NpySource::take_type(std::string_view type) {
  for (const auto& [name, size] : {std::pair<std::string_view, std::size_t>{"f2", 2}, {"f4", 4}, {"f8", 8}}) {
    if (type.size() != 3 || type.substr(1) != name || (type[0] != '<' && type[0] != '>')) continue;
    number_size_ = size;
    big_endian_ = type[0] == '>';
    return;
  }
  fail(fmt::format("it holds numbers of type '{}': save them as float32, a.astype('<f4')",
                   type.substr(0, 20)));
}

void NpySource::take_shape(std::string_view shape) {
  std::vector<std::uint64_t> sizes;
  for (std::string_view left = shape; !left.empty() && sizes.size() < 4;) {
    left.remove_prefix(std::min(left.find_first_not_of(" ,"), left.size()));
    if (left.empty()) break;
    const auto [end, error] = std::from_chars(left.data(), left.data() + left.size(), sizes.emplace_back());
    if (error != std::errc{}) {
      sizes.clear();
      break;
    }
    left.remove_prefix(static_cast<std::size_t>(end - left.data()));
  }
  if (sizes.size() == 2) sizes.insert(sizes.begin(), 1);
  if (sizes.size() != 3 || sizes[2] != 3)
    fail(fmt::format("its shape is ({}), not [frame][vertex][xyz]", shape.substr(0, 60)));
  if (sizes[1] != mesh_.vertex_count || sizes[1] == 0) {
    fail(fmt::format(
        "its shape ({}) says {} vertices, but {} has {}: an array needs the mesh it was made with",
        shape.substr(0, 60), sizes[1], mesh_file_, mesh_.vertex_count));
  }
  if (sizes[0] == 0) fail("it holds no frames");
  frames_ = sizes[0];
}

float NpySource::number_at(const char* bytes) const {
  if (number_size_ == 2) return widened(load<std::uint16_t>(bytes, big_endian_));
  if (number_size_ == 4) return load<float>(bytes, big_endian_);
  const double value = load<double>(bytes, big_endian_);
  constexpr double kLargest = std::numeric_limits<float>::max();
  return std::abs(value) > kLargest ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
}

bool NpySource::read(std::span<float> positions) {
  if (next_ == frames_) return false;
  bytes_.resize(frame_size());
  if (file_->read(bytes_.data(), bytes_.size()) < bytes_.size())
    fail(fmt::format("it ends inside frame {}", next_), ErrorCode::kTruncated);
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] = number_at(bytes_.data() + i * number_size_);
  const std::size_t bad = find_non_finite(positions);
  if (bad < positions.size())
    fail(fmt::format("frame {}, vertex {} has a coordinate that is NaN or infinite", next_, bad / 3));
  ++next_;
  return true;
}

/// Which of several arrays that fit is the positions.
std::optional<std::size_t> usual_name(const std::vector<std::string>& names) {
  for (const char* usual : {"vertices", "verts", "positions", "points"}) {
    const auto found = std::find(names.begin(), names.end(), usual);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<FrameSource> open_npy(const std::string& path, Mesh mesh, Metadata metadata,
                                      const std::string& mesh_file) {
  return std::make_unique<NpySource>(open_array_file(path), std::move(mesh), std::move(metadata), mesh_file);
}

std::unique_ptr<FrameSource> open_npz(const std::string& path, const Mesh& mesh, const Metadata& metadata,
                                      const std::string& mesh_file, const std::string& array) {
  std::vector<std::string> names, reasons;
  std::vector<std::unique_ptr<FrameSource>> fitting;
  for (const NpzEntry& entry : list_npz(path)) {
    if (!array.empty() && entry.name != array) {
      reasons.push_back(fmt::format("'{}'", entry.name));
      continue;
    }
    try {
      fitting.push_back(std::make_unique<NpySource>(open_npz_entry(path, entry), mesh, metadata, mesh_file));
      names.push_back(entry.name);
    } catch (const ImportError& error) {
      if (!array.empty()) throw;
      reasons.emplace_back(error.what());
    }
  }
  const auto fail = [&](const std::string& what) {
    throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", path, what));
  };
  if (fitting.empty() && !array.empty())
    fail(fmt::format("it has no array '{}', but {}", array, fmt::join(reasons, ", ")));
  if (fitting.empty())
    fail(fmt::format("none of its arrays has the mesh's positions ({})", fmt::join(reasons, "; ")));
  if (fitting.size() == 1) return std::move(fitting[0]);
  const std::optional<std::size_t> usual = usual_name(names);
  if (!usual)
    fail(
        fmt::format("the arrays '{}' may all be positions: choose one by --array", fmt::join(names, "', '")));
  return std::move(fitting[*usual]);
}

}  // namespace tvg::cli
