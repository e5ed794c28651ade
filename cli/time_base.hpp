#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg::cli {

/// When the frames of a stream are.
struct TimeBase {
  std::optional<std::string> rate;  ///< frames per second, as the metadata have it
  double start = 0;                 ///< when the first frame is, in seconds
  std::vector<double> times;        ///< of all frames, where they are uneven; empty where they are even
};

/// Of a stream with this metadata. `path`: where its uneven times are read, if it has any; nothing is read of
/// standard input.
TimeBase time_base_of(const Metadata& metadata, bool has_times, const std::string& path);

/// "24 frames per second from 0.5 s on"; empty where the stream says nothing.
std::string words_for(const TimeBase& time);
nlohmann::json json_of(const TimeBase& time);

}  // namespace tvg::cli
