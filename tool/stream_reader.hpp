#pragma once
#include "tool/remote_stream.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::cli {

/// Feeds a decoder from a file, from an http or https URL or from standard input ("-"), a piece at a time.
/// Failures to open or read are ToolErrors (kIo) that name it.
class StreamReader {
 public:
  explicit StreamReader(const std::string& path);
  ~StreamReader();
  StreamReader(const StreamReader&) = delete;
  StreamReader& operator=(const StreamReader&) = delete;

  /// The next event other than kNeedBytes.
  Decoder::Event next();

  Decoder& decoder() { return decoder_; }
  const Decoder& decoder() const { return decoder_; }
  /// As Decoder::use_lod(); reads in small pieces, so that what is not needed stays unread where the input is
  /// a file or can be had in ranges. Before the first event.
  void use_lod(std::uint32_t lod);
  /// What is to be said of a coarser mesh that was asked for: "lod 1 of 2: 4000 vertices, 203 kB of 305 kB
  /// read"; empty where none was.
  std::string lod_note() const;
  /// The path, the URL, or "standard input".
  const std::string& name() const { return name_; }
  /// Bytes of the input; nothing where it can be read only once: pipes and live streams.
  std::optional<std::uint64_t> size() const { return size_; }
  /// The index at the file's end, where the input has a size and an index that can be read; the decoder then
  /// seeks by it.
  std::optional<StreamMap> read_index();
  /// Bytes from `offset` on, as many as come at once; 0 at the end. Where the input has no size, these are
  /// the next bytes, whatever the offset. Not together with next().
  std::size_t read_from(std::uint64_t offset, std::span<std::uint8_t> target);
  /// Goes to a frame: the next kFrame is this one, or the first good one after it. The input has a size, and
  /// its head has been read.
  void seek(std::uint64_t frame);

 private:
  void move_to(std::uint64_t offset, int whence);
  std::size_t read_some(void* target, std::size_t size);
  std::vector<std::uint8_t> read_at(std::uint64_t offset, std::size_t size);

  std::string name_;
  std::unique_ptr<RemoteStream> remote_;  ///< null where the input is no URL
  std::uint64_t remote_position_ = 0;
  int descriptor_;
  std::optional<std::uint64_t> size_;
  std::vector<std::uint8_t> piece_;
  std::uint64_t bytes_read_ = 0;  ///< given to the decoder
  std::uint32_t lod_ = 0;
  Decoder decoder_;
};

/// "50-99" or "50": a run of frames for people.
std::string frame_run(std::uint64_t first, std::uint64_t count);

}  // namespace tvg::cli
