#include "modes/gop_decoder.hpp"

#include "base/byte_io.hpp"

namespace tvg {

// format-spec §7.6
Status GopDecoder::check_digest(Bytes packet) const {
  ByteReader reader(packet);
  const std::uint64_t expected = reader.u64();
  if (!reader.finished())
    return Error{ErrorCode::kMalformed, "the GOP's digest has a wrong size", {}, {}, "§4.5"};
  if (expected == mode().digest()) return {};
  return Error{
      ErrorCode::kDigestMismatch, "the GOP decoded to other values than were encoded", {}, {}, "§7.6"};
}

}  // namespace tvg
