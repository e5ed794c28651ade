#pragma once
#include "streams/join_input.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <tvg/join.hpp>

namespace tvg {

/// What becomes of the free-form data of the inputs of join().
class JoinedData {
 public:
  /// `keeps_all`: the result has all frames of all inputs.
  JoinedData(std::size_t inputs, bool keeps_all) : inputs_(inputs), keeps_all_(keeps_all) {}

  /// Takes the data that stand before the first frame of an input; all inputs in their order.
  void add_start(std::string name, std::vector<JoinInputReader::DataChunk> data);
  /// Whether inputs that are parts of a whole are all of its parts, in order: kInvalidArgument with what is
  /// missing or where it belongs.
  Status check_parts() const;
  /// The chunks that begin the result.
  std::vector<std::vector<std::uint8_t>> start_chunks();
  /// Of data that an input has behind its first frame, those that are passed on.
  std::vector<std::vector<std::uint8_t>> later_chunks(const std::string& name,
                                                      std::vector<JoinInputReader::DataChunk> data);

  /// What the result does not keep, for people; hands them out.
  std::vector<std::string> take_notes() { return std::exchange(notes_, {}); }

 private:
  struct Start {
    std::string name;
    std::vector<JoinInputReader::DataChunk> data;

    const JoinInputReader::DataChunk* find(const std::string& data_name) const;
  };

  /// The data of each frame of all inputs, one after the other; nothing where that makes no whole.
  std::optional<NamedData> of_all_frames(const std::string& data_name) const;
  void take(const std::string& input, JoinInputReader::DataChunk chunk,
            std::vector<std::vector<std::uint8_t>>& chunks);

  const std::size_t inputs_;
  const bool keeps_all_;
  std::vector<Start> starts_;
  std::map<std::string, std::uint32_t> ids_;  ///< of the data passed on, by name
  std::vector<std::string> notes_;
};

}  // namespace tvg
