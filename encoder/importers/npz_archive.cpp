#include "encoder/importers/array_file.hpp"
#include "encoder/importers/bytes.hpp"
#include "encoder/importers/import_error.hpp"
#include "encoder/importers/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <zlib.h>

// ZIP as NumPy writes it: stored or deflated, also with sizes of 64 bits.
namespace tvg::cli {

namespace {

constexpr std::uint32_t kEnd = 0x06054b50;
constexpr std::uint32_t kWideEndLocator = 0x07064b50;
constexpr std::uint32_t kWideEnd = 0x06064b50;
constexpr std::uint32_t kEntry = 0x02014b50;
constexpr std::uint32_t kLocal = 0x04034b50;
constexpr std::uint32_t kWide = 0xffffffff;  // the number is in the entry's extra field
constexpr std::size_t kEndSize = 22;
constexpr std::size_t kEntrySize = 46;
constexpr std::size_t kLocalSize = 30;

template <class T>
T at(std::string_view bytes, std::size_t offset) {
  return load<T>(bytes.data() + offset, false);
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw ImportError(ErrorCode::kInvalidInput, fmt::format("{}: {}", path, what));
}

std::string read_range(InputFile& file, std::uint64_t offset, std::uint64_t size) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 24;
  if (offset > *file.size() || size > *file.size() - offset || size > kMost)
    fail(file.name(), "its directory does not lie in it: the archive is damaged");
  std::string bytes(size, '\0');
  file.seek(offset);
  if (file.read(bytes.data(), size) < size) fail(file.name(), "it ends in its directory");
  return bytes;
}

/// The archive's directory, which stands before the last record.
std::string read_directory(InputFile& file) {
  constexpr std::uint64_t kLongestComment = 0xffff;
  if (!file.size()) fail(file.name(), "an archive is read of a regular file only");
  const std::uint64_t size = *file.size();
  const std::uint64_t begin = size - std::min(size, kEndSize + kLongestComment);
  const std::string tail = read_range(file, begin, size - begin);
  std::size_t end = tail.size() < kEndSize ? std::string::npos : tail.size() - kEndSize;
  while (end != std::string::npos && at<std::uint32_t>(tail, end) != kEnd)
    end = end == 0 ? std::string::npos : end - 1;
  if (end == std::string::npos)
    fail(file.name(), "it is no archive of arrays as numpy.savez() makes it, or it is cut");
  std::uint64_t length = at<std::uint32_t>(tail, end + 12);
  std::uint64_t offset = at<std::uint32_t>(tail, end + 16);
  constexpr std::size_t kLocatorSize = 20;
  if (offset == kWide && end >= kLocatorSize &&
      at<std::uint32_t>(tail, end - kLocatorSize) == kWideEndLocator) {
    const std::string wide = read_range(file, at<std::uint64_t>(tail, end - kLocatorSize + 8), 56);
    if (at<std::uint32_t>(wide, 0) != kWideEnd) fail(file.name(), "its directory is damaged");
    length = at<std::uint64_t>(wide, 40);
    offset = at<std::uint64_t>(wide, 48);
  }
  return read_range(file, offset, length);
}

/// Puts the numbers of 64 bits in the place of those that do not fit 32.
void widen(std::string_view extra, NpzEntry& entry) {
  constexpr std::uint16_t kWideField = 1;
  while (extra.size() >= 4) {
    const std::size_t size = std::min<std::size_t>(at<std::uint16_t>(extra, 2), extra.size() - 4);
    std::string_view field = extra.substr(4, size);
    if (at<std::uint16_t>(extra, 0) == kWideField) {
      for (std::uint64_t* number : {&entry.size, &entry.stored_size, &entry.header}) {
        if (*number != kWide || field.size() < 8) continue;
        *number = at<std::uint64_t>(field, 0);
        field.remove_prefix(8);
      }
      return;
    }
    extra.remove_prefix(4 + size);
  }
}

NpzEntry read_entry(const std::string& path, std::string_view record, std::string_view name,
                    std::string_view extra) {
  NpzEntry entry;
  entry.name = name.substr(0, name.size() - 4);
  const auto flags = at<std::uint16_t>(record, 8);
  const auto method = at<std::uint16_t>(record, 10);
  constexpr std::uint16_t kDeflated = 8;
  if ((flags & 1) != 0) fail(path, fmt::format("the array '{}' is encrypted", entry.name));
  if (method != 0 && method != kDeflated)
    fail(path,
         fmt::format("the array '{}' is compressed by method {}: only stored and deflated ones are read",
                     entry.name, method));
  entry.deflated = method == kDeflated;
  entry.crc = at<std::uint32_t>(record, 16);
  entry.stored_size = at<std::uint32_t>(record, 20);
  entry.size = at<std::uint32_t>(record, 24);
  entry.header = at<std::uint32_t>(record, 42);
  widen(extra, entry);
  return entry;
}

class NpzFile final : public ArrayFile {
 public:
  NpzFile(const std::string& path, const NpzEntry& entry)
      : file_(path), name_(fmt::format("{}, array '{}'", path, entry.name)), entry_(entry) {
    const std::string local = read_range(file_, entry.header, kLocalSize);
    if (at<std::uint32_t>(local, 0) != kLocal) fail(name_, "it is not where the archive says");
    begin_ = entry.header + kLocalSize + at<std::uint16_t>(local, 26) + at<std::uint16_t>(local, 28);
    if (begin_ > *file_.size() || entry.stored_size > *file_.size() - begin_)
      throw ImportError(ErrorCode::kTruncated, name_ + ": the archive ends inside it");
    if (!entry.deflated && entry.size != entry.stored_size) fail(name_, "it says two sizes");
    restart();
  }
  ~NpzFile() override {
    if (inflating_) inflateEnd(&stream_);
  }
  NpzFile(const NpzFile&) = delete;
  NpzFile& operator=(const NpzFile&) = delete;

  const std::string& name() const override { return name_; }
  std::uint64_t size() const override { return entry_.size; }
  std::size_t read(void* data, std::size_t size) override {
    const std::size_t wanted = std::min<std::uint64_t>(size, entry_.size - place_);
    const std::size_t got = entry_.deflated ? inflate_some(data, wanted) : file_.read(data, wanted);
    check(data, got);
    place_ += got;
    return got;
  }
  void seek(std::uint64_t offset) override {
    offset = std::min(offset, entry_.size);
    if (!entry_.deflated) {
      file_.seek(begin_ + offset);
      place_ = offset;
      return;
    }
    if (offset < place_) restart();
    std::array<char, std::size_t{1} << 14> passed;
    while (place_ < offset) {
      if (read(passed.data(), std::min<std::uint64_t>(passed.size(), offset - place_)) == 0) return;
    }
  }

 private:
  /// Goes on with the checksum where these bytes follow those that it was made of.
  void check(const void* data, std::size_t size) {
    if (place_ != checked_) return;
    checked_ += size;
    crc_ = crc32_z(crc_, static_cast<const Bytef*>(data), size);
    if (checked_ == entry_.size && crc_ != entry_.crc)
      fail(name_, "its checksum does not fit its bytes: the archive is damaged");
  }

  void restart() {
    file_.seek(begin_);
    place_ = 0;
    left_ = entry_.stored_size;
    if (!entry_.deflated) return;
    if (inflating_) inflateEnd(&stream_);
    stream_ = {};
    constexpr int kRawDeflate = -15;
    inflating_ = inflateInit2(&stream_, kRawDeflate) == Z_OK;
    if (!inflating_) throw ImportError(ErrorCode::kIo, "no memory to read " + name_);
  }

  std::size_t inflate_some(void* data, std::size_t size) {
    constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;
    std::size_t filled = 0;
    while (filled < size) {
      if (stream_.avail_in == 0 && left_ > 0) {
        const std::size_t got = file_.read(input_.data(), std::min<std::uint64_t>(input_.size(), left_));
        if (got == 0) break;
        left_ -= got;
        stream_.next_in = input_.data();
        stream_.avail_in = static_cast<uInt>(got);
      }
      const std::size_t room = std::min(size - filled, kMostAtOnce);
      stream_.next_out = static_cast<Bytef*>(data) + filled;
      stream_.avail_out = static_cast<uInt>(room);
      const int result = inflate(&stream_, Z_NO_FLUSH);
      filled += room - stream_.avail_out;
      if (result == Z_STREAM_END || (result == Z_BUF_ERROR && left_ == 0)) break;
      if (result != Z_OK && result != Z_BUF_ERROR) fail(name_, "its compressed bytes are damaged");
    }
    return filled;
  }

  InputFile file_;
  std::string name_;
  NpzEntry entry_;
  std::uint64_t begin_ = 0;    // of its bytes in the archive
  std::uint64_t place_ = 0;    // in the array
  std::uint64_t left_ = 0;     // compressed bytes not read yet
  std::uint64_t checked_ = 0;  // bytes of the array, from its beginning, that crc_ is of
  uLong crc_ = 0;
  bool inflating_ = false;
  z_stream stream_{};
  std::array<Bytef, std::size_t{1} << 15> input_;
};

}  // namespace

std::vector<NpzEntry> list_npz(const std::string& path) {
  InputFile file(path);
  const std::string directory = read_directory(file);
  std::string_view left = directory;
  std::vector<NpzEntry> entries;
  while (left.size() >= kEntrySize && at<std::uint32_t>(left, 0) == kEntry) {
    const std::size_t name_size = at<std::uint16_t>(left, 28);
    const std::size_t extra_size = at<std::uint16_t>(left, 30);
    const std::size_t size = kEntrySize + name_size + extra_size + at<std::uint16_t>(left, 32);
    if (size > left.size()) fail(path, "its directory is damaged");
    const std::string_view name = left.substr(kEntrySize, name_size);
    if (name.ends_with(".npy") && is_plain_text(name))
      entries.push_back(read_entry(path, left, name, left.substr(kEntrySize + name_size, extra_size)));
    left.remove_prefix(size);
  }
  if (entries.empty()) fail(path, "it holds no arrays");
  return entries;
}

std::unique_ptr<ArrayFile> open_npz_entry(const std::string& path, const NpzEntry& entry) {
  return std::make_unique<NpzFile>(path, entry);
}

}  // namespace tvg::cli
