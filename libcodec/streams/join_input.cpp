#include "streams/join_input.hpp"

#include "container/stream_checks.hpp"

#include <algorithm>

namespace tvg {

namespace {

constexpr std::uint64_t kPieceBytes = std::uint64_t{1} << 18;
constexpr std::uint64_t kMostSmallChunkBytes = std::uint64_t{1} << 20;

std::string text(const ChunkType& type) {
  return {type.begin(), type.end()};
}

}  // namespace

Error JoinInputReader::located(Error error) const {
  if (!error.byte_offset) error.byte_offset = chunk_offset_;
  error.message = input_.name + ": " + error.message;
  return error;
}

Error JoinInputReader::fail(ErrorCode code, std::string message, const char* section) const {
  return located({code, std::move(message), {}, {}, section});
}

/// Appends the next `size` bytes. Grows as bytes come, so that a false size allocates nothing.
Status JoinInputReader::read(std::uint64_t size, std::vector<std::uint8_t>& bytes) {
  while (size > 0) {
    const std::size_t filled = bytes.size();
    bytes.resize(filled + static_cast<std::size_t>(std::min(size, kPieceBytes)));
    const Result<std::size_t> got = input_.read(std::span(bytes).subspan(filled));
    if (!got) return got.error();
    bytes.resize(filled + *got);
    offset_ += *got;
    size -= *got;
    if (*got == 0) {
      return located({ErrorCode::kTruncated, "the stream ends before it is complete", offset_, {}, "§3.4"});
    }
  }
  return {};
}

// format-spec §3.1
Status JoinInputReader::read_signature() {
  std::vector<std::uint8_t> bytes;
  Status status = read(kSignature.size(), bytes);
  if (!status.ok() && status.error().code != ErrorCode::kTruncated) return status;
  if (bytes.empty()) return fail(ErrorCode::kTruncated, "the stream is empty", "§3.1");
  if (!std::equal(bytes.begin(), bytes.end(), kSignature.begin())) {
    return fail(ErrorCode::kNotTvg, "this is not a TVG stream: the signature is missing", "§3.1");
  }
  return status;
}

// format-spec §3.2
Status JoinInputReader::read_header() {
  chunk_offset_ = offset_;
  raw_.clear();
  if (Status status = read(kChunkHeaderSize, raw_); !status.ok()) return status;
  const std::optional<ChunkHeader> header = read_chunk_header(raw_);
  if (!header) return fail(ErrorCode::kMalformed, "a chunk header is damaged", "§3.2");
  chunk_ = *header;
  has_header_ = true;
  return {};
}

// format-spec §3.3
Status JoinInputReader::read_payload(std::uint64_t most) {
  if (chunk_.length > most) {
    return fail(ErrorCode::kMalformed, "chunk '" + text(chunk_.type) + "' is too long", "§3.2");
  }
  payload_.clear();
  if (Status status = read(chunk_.length + kChunkChecksumSize, payload_); !status.ok()) return status;
  const std::uint32_t expected = ByteReader(Bytes(payload_).last(kChunkChecksumSize)).u32();
  payload_.resize(chunk_.length);
  has_header_ = false;
  if (expected == checksum(payload_)) return {};
  return fail(ErrorCode::kChecksumMismatch, "chunk '" + text(chunk_.type) + "' is damaged", "§3.3");
}

Status JoinInputReader::skip_payload() {
  Hasher hash;
  for (std::uint64_t left = chunk_.length; left > 0; left -= payload_.size()) {
    payload_.clear();
    if (Status status = read(std::min(left, kPieceBytes), payload_); !status.ok()) return status;
    hash.update(Bytes(payload_));
  }
  payload_.clear();
  if (Status status = read(kChunkChecksumSize, payload_); !status.ok()) return status;
  has_header_ = false;
  ++chunks_passed_over_;
  if (ByteReader(payload_).u32() == static_cast<std::uint32_t>(hash.value())) return {};
  return fail(ErrorCode::kChecksumMismatch, "chunk '" + text(chunk_.type) + "' is damaged", "§3.3");
}

Status JoinInputReader::begin() {
  if (Status status = read_signature(); !status.ok()) return status;
  if (Status status = read_header(); !status.ok()) return status;
  if (chunk_.type != kHeadChunk) {
    return fail(ErrorCode::kMalformed, "the stream does not begin with its head", "§3.4");
  }
  if (Status status = use_head(); !status.ok()) return status;
  for (;;) {
    if (Status status = read_header(); !status.ok()) return status;
    if (chunk_.type != kMetadataChunk) return {};
    if (Status status = read_payload(kMostSmallChunkBytes); !status.ok()) return status;
    Result<Metadata> metadata = read_metadata(payload_);
    if (!metadata) return located(metadata.error());
    metadata_ = std::move(*metadata);
  }
}

// format-spec §4.1, §8.1
Status JoinInputReader::use_head() {
  if (Status status = read_payload(kMostSmallChunkBytes); !status.ok()) return status;
  const Result<StreamHead> head = read_head(payload_);
  if (!head) return located(head.error());
  if (Status status = check_declared(head->limits, caller_limits_); !status.ok())
    return located(status.error());
  head_ = *head;
  return {};
}

Result<bool> JoinInputReader::next_gop() {
  for (;;) {
    if (!has_header_) {
      if (Status status = read_header(); !status.ok()) return status.error();
    }
    Status status;
    if (chunk_.type == kGopChunk) {
      status = begin_gop();
      if (status.ok()) return true;
    } else if (chunk_.type == kMeshChunk) {
      status = use_mesh();
    } else if (chunk_.type == kIndexChunk) {
      status = use_index();
    } else if (chunk_.type == kTailChunk) {
      status = end_stream();
      if (status.ok()) return false;
    } else if (chunk_.type == kHeadChunk) {
      status = fail(ErrorCode::kMalformed, "the stream has a second head", "§3.4");
    } else if (chunk_.ancillary) {
      status = skip_payload();
    } else {
      status = fail(ErrorCode::kUnsupportedVersion,
                    "the stream needs a program that knows chunk '" + text(chunk_.type) + "'", "§3.2");
    }
    if (!status.ok()) return status.error();
  }
}

// format-spec §4.3
Status JoinInputReader::use_mesh() {
  if (Status status = read_payload(most_mesh_bytes(head_.limits)); !status.ok()) return status;
  if (Status status = check_mesh_payload(payload_, head_.limits); !status.ok())
    return located(status.error());
  mesh_.swap(payload_);
  seen_.push_back({IndexEntry::Kind::kMesh, chunk_offset_, 0});
  return {};
}

// format-spec §4.5, §4.5.1
Status JoinInputReader::begin_gop() {
  if (mesh_.empty()) return fail(ErrorCode::kMalformed, "a GOP comes before any mesh", "§3.4");
  const Error damaged = fail(ErrorCode::kChecksumMismatch, "a packet is damaged", "§4.5");
  std::vector<std::uint8_t>& bytes = gop_start_;
  bytes = raw_;
  constexpr std::size_t kMostSizeBytes = 10;
  std::size_t size_bytes = 0;
  do {
    if (size_bytes == kMostSizeBytes || size_bytes == chunk_.length) return damaged;
    if (Status status = read(1, bytes); !status.ok()) return status;
    ++size_bytes;
  } while (bytes.back() >= 0x80);
  ByteReader size_reader(Bytes(bytes).last(size_bytes));
  const std::uint64_t size = size_reader.varint();
  if (!size_reader.ok() || size > head_.limits.packet_bytes ||
      size_bytes + size + kChunkChecksumSize > chunk_.length) {
    return damaged;
  }
  if (Status status = read(size + kChunkChecksumSize, bytes); !status.ok()) return status;
  const Bytes packet = Bytes(bytes).subspan(kChunkHeaderSize + size_bytes, static_cast<std::size_t>(size));
  if (ByteReader(Bytes(bytes).last(kChunkChecksumSize)).u32() != checksum(packet)) return damaged;
  const Result<GopHeader> header = check_gop_header(packet, head_.limits);
  if (!header) return located(header.error());
  gop_frames_ = header->frame_count;
  gop_left_ = chunk_.length - (bytes.size() - kChunkHeaderSize);
  has_header_ = false;
  seen_.push_back({IndexEntry::Kind::kGop, chunk_offset_, gop_frames_});
  return {};
}

Status JoinInputReader::pass_gop(const ByteSink* sink) {
  Hasher hash;
  hash.update(Bytes(gop_start_).subspan(kChunkHeaderSize));
  while (gop_left_ > 0) {
    payload_.clear();
    if (Status status = read(std::min(gop_left_, kPieceBytes), payload_); !status.ok()) return status;
    gop_left_ -= payload_.size();
    hash.update(Bytes(payload_));
    if (sink == nullptr) continue;
    if (Status status = (*sink)(payload_); !status.ok()) return status;
  }
  payload_.clear();
  if (Status status = read(kChunkChecksumSize, payload_); !status.ok()) return status;
  if (ByteReader(payload_).u32() != static_cast<std::uint32_t>(hash.value())) {
    return fail(ErrorCode::kChecksumMismatch, "a GOP is damaged", "§3.3");
  }
  return sink == nullptr ? Status() : (*sink)(payload_);
}

// format-spec §4.6
Status JoinInputReader::use_index() {
  if (Status status = read_payload(64 + 20 * std::uint64_t{seen_.size()}); !status.ok()) return status;
  const Result<std::vector<IndexEntry>> index = read_index(payload_);
  if (!index) return located(index.error());
  if (*index == seen_) return {};
  return fail(ErrorCode::kMalformed, "the index does not match the stream", "§4.6");
}

// format-spec §4.7
Status JoinInputReader::end_stream() {
  if (Status status = read_payload(kMostSmallChunkBytes); !status.ok()) return status;
  const Result<std::uint64_t> tail = read_tail(payload_);
  if (!tail) return located(tail.error());
  std::uint8_t beyond = 0;
  const Result<std::size_t> got = input_.read({&beyond, 1});
  if (!got) return got.error();
  if (*got == 0) return {};
  chunk_offset_ = offset_;
  return fail(ErrorCode::kMalformed, "bytes follow the stream's tail", "§4.7");
}

}  // namespace tvg
