#include "modes/gop_decoder.hpp"

#include "base/byte_io.hpp"
#include "base/stream_error.hpp"

namespace tvg {

// format-spec §7.6
Status GopDecoder::check_digest(Bytes packet) const {
  ByteReader reader(packet);
  const std::uint64_t expected = reader.u64();
  if (!reader.finished()) return malformed("§4.5", "the GOP's digest has a wrong size");
  if (expected == mode().digest()) return {};
  return stream_error(ErrorCode::kDigestMismatch, "§7.6",
                      {"the GOP decoded to other values than were encoded"});
}

}  // namespace tvg
