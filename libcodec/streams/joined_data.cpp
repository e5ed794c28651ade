#include "streams/joined_data.hpp"

#include "base/errors.hpp"
#include "container/chunk.hpp"
#include "container/data_payload.hpp"
#include "container/frame_data.hpp"

#include <algorithm>
#include <utility>

#include <tvg/parts.hpp>

namespace tvg {

namespace {

std::string part_text(const PartMark& mark) {
  return "part " + std::to_string(mark.number) + " of " + std::to_string(mark.count);
}

/// "part 3 of 8 is missing", "parts 3 to 5 of 8 are missing".
std::string text_of_missing(std::uint32_t first, std::uint32_t last, std::uint32_t count) {
  const std::string of = " of " + std::to_string(count);
  return first == last
             ? "part " + std::to_string(first) + of + " is missing"
             : "parts " + std::to_string(first) + " to " + std::to_string(last) + of + " are missing";
}

}  // namespace

const JoinInputReader::DataChunk* JoinedData::Start::find(const std::string& data_name) const {
  const auto found =
      std::find_if(data.begin(), data.end(), [&](const auto& chunk) { return chunk.name == data_name; });
  return found == data.end() ? nullptr : &*found;
}

void JoinedData::add_start(std::string name, std::vector<JoinInputReader::DataChunk> data) {
  starts_.push_back({std::move(name), std::move(data)});
}

Status JoinedData::check_parts() const {
  std::optional<PartMark> before;
  std::uint32_t due = 1;
  for (const Start& start : starts_) {
    const JoinInputReader::DataChunk* const chunk = start.find(kPartData);
    const std::optional<PartMark> mark =
        chunk != nullptr && chunk->unpacked ? part_mark(*chunk->unpacked) : std::nullopt;
    if (!mark) {
      // What stands between whole streams may be anything; what stands between parts is a mistake.
      if (before && due <= before->count)
        return invalid_argument(text_of_missing(due, due, before->count) + ": " + start.name +
                                " is no part of that whole");
      continue;
    }
    if (before && due <= before->count && mark->plan != before->plan)
      return invalid_argument(start.name + " is " + part_text(*mark) +
                              " by another plan than the parts before it");
    if (before && due > before->count) due = 1;  // another whole begins
    if (mark->number > due)
      return invalid_argument(text_of_missing(due, mark->number - 1, mark->count) + ": " + start.name +
                              " is " + part_text(*mark));
    if (mark->number < due)
      return invalid_argument(start.name + " is " + part_text(*mark) + ", where part " + std::to_string(due) +
                              " is due: name the parts in their order, each once");
    before = mark;
    ++due;
  }
  if (before && due <= before->count)
    return invalid_argument(text_of_missing(due, before->count, before->count) +
                            " (for some of a whole, say which frames)");
  return {};
}

std::optional<NamedData> JoinedData::of_all_frames(const std::string& data_name) const {
  if (!keeps_all_) return std::nullopt;
  std::optional<NamedData> whole;
  for (const Start& start : starts_) {
    const JoinInputReader::DataChunk* const chunk = start.find(data_name);
    if (chunk == nullptr || !chunk->unpacked) return std::nullopt;
    if (!whole) {
      whole = chunk->unpacked;
      continue;
    }
    // Places of joints are those of one skeleton.
    const JoinInputReader::DataChunk* const skeleton = start.find("skeleton");
    const JoinInputReader::DataChunk* const first = starts_.front().find("skeleton");
    const bool is_alike =
        (skeleton == nullptr) == (first == nullptr) && (skeleton == nullptr || skeleton->id == first->id);
    if (!is_alike || !join_frame_data(*whole, *chunk->unpacked)) return std::nullopt;
  }
  return whole;
}

void JoinedData::take(const std::string& input, JoinInputReader::DataChunk chunk,
                      std::vector<std::vector<std::uint8_t>>& chunks) {
  const auto [known, is_new] = ids_.emplace(chunk.name, chunk.id);
  if (!is_new && known->second != chunk.id) {
    notes_.push_back(input + ": its data \"" + chunk.name +
                     "\" are left out; those of an earlier input are kept");
  }
  if (is_new) chunks.push_back(std::move(chunk.bytes));
}

std::vector<std::vector<std::uint8_t>> JoinedData::start_chunks() {
  std::vector<std::vector<std::uint8_t>> chunks;
  std::map<std::string, std::optional<NamedData>> wholes;  // of the data of frames, by name
  for (Start& start : starts_) {
    for (const JoinInputReader::DataChunk& chunk : start.data) {
      if (is_frame_data(chunk.name)) wholes.try_emplace(chunk.name, of_all_frames(chunk.name));
    }
  }
  for (Start& start : starts_) {
    for (JoinInputReader::DataChunk& chunk : start.data) {
      if (chunk.name == kPartData) continue;
      if (!is_frame_data(chunk.name) || (inputs_ == 1 && keeps_all_)) {
        take(start.name, std::move(chunk), chunks);
      } else if (const std::optional<NamedData>& whole = wholes.at(chunk.name); !whole) {
        notes_.push_back(start.name + ": data \"" + chunk.name +
                         "\" are left out: they belong to all frames of one input");
      } else if (ids_.emplace(chunk.name, chunk.id).second) {
        chunks.push_back(write_chunk(kDataChunk, true, write_data(*whole)));
      }
    }
  }
  starts_.clear();
  return chunks;
}

std::vector<std::vector<std::uint8_t>> JoinedData::later_chunks(
    const std::string& name, std::vector<JoinInputReader::DataChunk> data) {
  std::vector<std::vector<std::uint8_t>> chunks;
  for (JoinInputReader::DataChunk& chunk : data) {
    if (is_frame_data(chunk.name) && !(inputs_ == 1 && keeps_all_)) {
      notes_.push_back(name + ": data \"" + chunk.name +
                       "\" are left out: they belong to all frames of one input");
      continue;
    }
    take(name, std::move(chunk), chunks);
  }
  return chunks;
}

}  // namespace tvg
