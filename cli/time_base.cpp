#include "cli/time_base.hpp"

#include "tool/frame_times.hpp"
#include "tool/stream_reader.hpp"

#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include <tvg/data.hpp>

namespace tvg::cli {

namespace {

std::vector<double> read_times(const std::string& path) {
  StreamReader reader(path);
  for (;;) {
    switch (reader.next()) {
      case Decoder::Event::kData: {
        if (reader.decoder().data().name != "times") break;
        const Result<NamedData> data = unpack_data(reader.decoder().data());
        return data ? times_from(data->bytes) : std::vector<double>();
      }
      case Decoder::Event::kError:
      case Decoder::Event::kEnd:
        return {};
      default:
        break;
    }
  }
}

}  // namespace

TimeBase time_base_of(const Metadata& metadata, bool has_times, const std::string& path) {
  TimeBase time;
  if (const auto fps = metadata.find("fps"); fps != metadata.end()) time.rate = fps->second;
  if (const auto start = metadata.find("start"); start != metadata.end()) {
    const std::string& text = start->second;
    std::from_chars(text.data(), text.data() + text.size(), time.start);
  }
  if (has_times && path != "-") time.times = read_times(path);
  if (!time.times.empty()) time.start = time.times.front();
  return time;
}

std::string words_for(const TimeBase& time) {
  if (!time.times.empty()) {
    return fmt::format("frames at {} uneven times, from {:.6g} to {:.6g} s", time.times.size(),
                       time.times.front(), time.times.back());
  }
  const std::string from = time.start != 0 ? fmt::format("from {:.6g} s on", time.start) : std::string();
  if (!time.rate) return from;
  return *time.rate + " frames per second" + (from.empty() ? "" : " " + from);
}

nlohmann::json json_of(const TimeBase& time) {
  nlohmann::json json = {{"start", time.start}, {"uneven", !time.times.empty()}};
  if (time.rate) json["fps"] = *time.rate;
  if (!time.times.empty()) json["times"] = time.times;
  return json;
}

}  // namespace tvg::cli
