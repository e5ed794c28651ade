#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tvg::cli {

/// An output file that appears under its name only when it is complete: bytes go to a temporary name in the
/// same folder, finish() renames it, and the destructor removes it where finish() was not reached. A file of
/// that name that exists stays untouched until then. "-" is standard output; it, pipes and devices are
/// written straight through. A user at a terminal is asked before a file is replaced
/// (confirm_overwriting()). Every failure is a ToolError (kIo) that names the file.
class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The name the file will have.
  const std::string& path() const { return path_; }
  /// Whether overwrite() and move_tail() can be called: false for standard output, pipes and devices.
  bool seekable() const { return !temporary_.empty(); }
  /// Where the bytes are until finish(), for another program that writes them in place of write(); empty
  /// where seekable() is false.
  const std::string& temporary_path() const { return temporary_; }
  /// Bytes written so far.
  std::uint64_t size() const { return flushed_ + buffer_.size(); }

  /// Appends.
  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Hands what is buffered to the system, for a reader at the other end of a pipe.
  void flush();

  /// Replaces bytes [offset, offset + size), which have been written before.
  void overwrite(std::uint64_t offset, const void* data, std::size_t size);

  /// Moves the bytes from `from` to the end so that they start at `to`; the file grows or shrinks by the
  /// difference.
  void move_tail(std::uint64_t from, std::uint64_t to);

  /// Writes what is buffered and gives the file its name. Nothing may be written afterwards.
  void finish();

  /// finish() under another name in the same folder; only for a seekable() file.
  void finish_as(const std::string& path);

 private:
  void open_temporary(const std::string& target);
  void write_at(std::uint64_t offset, const char* data, std::size_t size);
  [[noreturn]] void fail(const std::string& what, int error_number) const;

  std::string path_;
  std::string target_;     // path_ with symbolic links resolved
  std::string temporary_;  // empty where bytes go straight to the output
  int descriptor_ = -1;
  std::uint64_t flushed_ = 0;
  std::vector<char> buffer_;
};

/// Lets SIGINT, SIGTERM and SIGHUP remove the temporary files of this process before they end it.
void remove_temporary_files_on_signals();

}  // namespace tvg::cli
