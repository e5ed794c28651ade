#include "cli/bench_settings.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace tvg::cli {

namespace {

constexpr std::array<std::pair<const char*, Mode>, 3> kModes = {
    {{"elp", Mode::kElp}, {"basis", Mode::kBasis}, {"lossless", Mode::kLossless}}};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> items;
  std::size_t begin = 0;
  for (std::size_t comma = text.find(','); comma != std::string::npos; comma = text.find(',', begin)) {
    items.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  items.push_back(text.substr(begin));
  return items;
}

[[noreturn]] void fail_bits(const std::string& text) {
  fail_option("--bits", text,
              "write a range as 7..13, a list as 7,9,11, or both; a number for all vertices, or those of "
              "important and of other vertices as 13:11 (a range 9:7..13:11); 1 to 24, the first at least "
              "the second");
}

BitPair bits_of(const std::string& item, const std::string& text) {
  try {
    return parse_bits(item);
  } catch (const ToolError&) {
    fail_bits(text);  // names what else would be right here
  }
}

}  // namespace

std::vector<BitPair> parse_bit_list(const std::string& text) {
  std::vector<BitPair> list;
  for (const std::string& item : split(text)) {
    const std::size_t dots = item.find("..");
    const BitPair first = bits_of(item.substr(0, dots), text);
    const BitPair last = dots == std::string::npos ? first : bits_of(item.substr(dots + 2), text);
    if (last.fine < first.fine || last.fine - last.coarse != first.fine - first.coarse) fail_bits(text);
    for (int up = 0; up <= last.fine - first.fine; ++up) {
      const BitPair bits{first.fine + up, first.coarse + up};
      const bool known = std::any_of(list.begin(), list.end(), [&bits](const BitPair& other) {
        return other.fine == bits.fine && other.coarse == bits.coarse;
      });
      if (!known) list.push_back(bits);
    }
  }
  return list;
}

std::vector<Mode> parse_mode_list(const std::string& text) {
  std::vector<Mode> modes;
  for (const std::string& item : split(text)) {
    const auto found =
        std::find_if(kModes.begin(), kModes.end(), [&item](const auto& mode) { return item == mode.first; });
    if (found == kModes.end())
      fail_option("--mode", text, "write elp, basis or lossless, or several of them as elp,basis");
    if (std::find(modes.begin(), modes.end(), found->second) == modes.end()) modes.push_back(found->second);
  }
  return modes;
}

std::string name_of(Mode mode) {
  for (const auto& [name, value] : kModes) {
    if (value == mode) return name;
  }
  return "";
}

BenchCodecs parse_codec_list(const std::string& text) {
  BenchCodecs codecs;
  for (const std::string& item : split(text)) {
    if (item == "tvg") {
      codecs.tvg = true;
      continue;
    }
    const auto known = bench::other_codecs();
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&item](const bench::OtherCodec& codec) { return codec.name == item; });
    if (found == known.end())
      fail_option("--codecs", text, fmt::format("write some of {} as tvg,meshopt", codec_names()));
    if (found->run == nullptr)
      fail_option("--codecs", text, fmt::format("this tvg was built without {}: leave that out", item));
    const bool twice = std::any_of(codecs.others.begin(), codecs.others.end(),
                                   [&item](const bench::OtherCodec& codec) { return codec.name == item; });
    if (!twice) codecs.others.push_back(*found);
  }
  return codecs;
}

BenchCodecs usual_codecs() {
  BenchCodecs codecs{true, {}, {}};
  for (const bench::OtherCodec& codec : bench::other_codecs()) {
    if (codec.name != "draco" && codec.name != "meshopt") continue;
    if (codec.run != nullptr) {
      codecs.others.push_back(codec);
    } else {
      codecs.missing.emplace_back(codec.name);
    }
  }
  return codecs;
}

std::string codec_names() {
  std::string names = "tvg";
  for (const bench::OtherCodec& codec : bench::other_codecs()) names += fmt::format(", {}", codec.name);
  return names;
}

}  // namespace tvg::cli
