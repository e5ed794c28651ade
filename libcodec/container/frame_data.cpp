#include "container/frame_data.hpp"

#include "base/byte_io.hpp"

#include <algorithm>
#include <bit>

#include <tvg/data.hpp>

namespace tvg {

namespace {

constexpr std::string_view kTimes = "times";
constexpr std::string_view kJoints = "skeleton/positions";
constexpr std::size_t kTimeBytes = sizeof(double);

double time_at(Bytes bytes) {
  return std::bit_cast<double>(ByteReader(bytes).u64());
}

}  // namespace

bool is_frame_data(std::string_view name) {
  return name == kTimes || name == kJoints;
}

NamedData cut_frame_data(const NamedData& data, std::uint64_t frames, const FrameRange& part) {
  const std::uint64_t size = data.bytes.size();
  const std::uint64_t stride = data.name == kTimes ? kTimeBytes : size / frames;
  const auto offset_of = [&](std::uint64_t frame) {
    return static_cast<std::ptrdiff_t>(frame >= frames ? size : std::min(size, frame * stride));
  };
  return {data.name,
          {data.bytes.begin() + offset_of(part.first), data.bytes.begin() + offset_of(part.last + 1)}};
}

bool join_frame_data(NamedData& data, const NamedData& next) {
  if (data.bytes.size() + next.bytes.size() > kMaxDataBytes) return false;
  if (data.name == kTimes && data.bytes.size() >= kTimeBytes && next.bytes.size() >= kTimeBytes) {
    const double last = time_at(Bytes(data.bytes).last(kTimeBytes));
    if (!(time_at(next.bytes) > last)) return false;
  }
  data.bytes.insert(data.bytes.end(), next.bytes.begin(), next.bytes.end());
  return true;
}

}  // namespace tvg
