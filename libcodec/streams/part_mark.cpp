#include "base/errors.hpp"
#include "streams/join_input.hpp"

#include <algorithm>
#include <charconv>
#include <new>
#include <string_view>
#include <utility>

#include <tvg/parts.hpp>

// The text "PLAN NUMBER COUNT".
namespace tvg {

namespace {

constexpr std::size_t kMostPlanLetters = 64;

bool is_letter_or_digit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The number that the text begins with, behind a space; 0 where there is none.
std::uint32_t take_number(std::string_view& text) {
  std::uint32_t number = 0;
  if (text.empty() || text.front() != ' ') return 0;
  const char* const end = text.data() + text.size();
  const auto [behind, error] = std::from_chars(text.data() + 1, end, number);
  if (error != std::errc()) return 0;
  text = {behind, static_cast<std::size_t>(end - behind)};
  return number;
}

}  // namespace

NamedData part_data(const PartMark& mark) {
  const std::string text = mark.plan + " " + std::to_string(mark.number) + " " + std::to_string(mark.count);
  return {kPartData, {text.begin(), text.end()}};
}

std::optional<PartMark> part_mark(const NamedData& data) {
  if (data.name != kPartData) return std::nullopt;
  const std::string text(data.bytes.begin(), data.bytes.end());
  const auto plan_end = std::find_if_not(text.begin(), text.end(), is_letter_or_digit);
  PartMark mark{std::string(text.begin(), plan_end)};
  std::string_view rest = std::string_view(text).substr(mark.plan.size());
  mark.number = take_number(rest);
  mark.count = take_number(rest);
  const bool holds = !mark.plan.empty() && mark.plan.size() <= kMostPlanLetters && mark.number > 0 &&
                     mark.number <= mark.count && rest.empty();
  return holds ? std::optional(std::move(mark)) : std::nullopt;
}

Result<std::optional<PartMark>> check_part(JoinInput stream) {
  try {
    JoinInputReader reader(std::move(stream), DecoderLimits());
    if (Status status = reader.begin(); !status.ok()) return status.error();
    std::optional<PartMark> mark;
    for (const JoinInputReader::DataChunk& chunk : reader.take_data()) {
      if (chunk.unpacked && !mark) mark = part_mark(*chunk.unpacked);
    }
    for (;;) {
      const Result<bool> more = reader.next_gop();
      if (!more) return more.error();
      if (!*more) return mark;
      if (Status status = reader.pass_gop(nullptr); !status.ok()) return status.error();
    }
  } catch (const std::bad_alloc&) {
    return out_of_memory("there is not enough memory for the stream's meshes");
  }
}

}  // namespace tvg
