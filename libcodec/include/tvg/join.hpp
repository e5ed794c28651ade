#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/types.hpp>

namespace tvg {

struct JoinInput {
  std::string name;  ///< what messages call it
  ByteSource read;
};

struct JoinOptions {
  /// Frames of the inputs one after the other, counted from 0 over all of them; must begin and end at GOP
  /// borders. All where absent.
  std::optional<FrameRange> frames;
  DecoderLimits limits;  ///< what the inputs may declare
};

/// What joining made.
struct JoinReport {
  std::uint64_t frames = 0;
  std::uint64_t gops = 0;
  std::uint64_t meshes = 0;        ///< mesh chunks written
  std::uint64_t bytes = 0;         ///< of the whole stream
  std::vector<std::string> notes;  ///< what the result does not keep of the inputs, for people
};

/// Makes one stream of several, at GOP borders and without decoding: GOPs are copied byte for byte. The head
/// declares the larger of the inputs' limits; meshes and planes that are in force already are not repeated;
/// metadata are those of the first input and, where it lacks a key, of the next that has it; free-form data
/// too, by their names. Data of frames ("times", "skeleton/positions") are put one after the other where each
/// input has them and the result all frames of all inputs, unless times would go back; otherwise they are
/// left out. Index and tail are made anew. The number of its
/// first frame in the sequence it was encoded from, which each GOP carries, stays.
///
/// Each input is read once, front to back, and no further than the last frame asked for; all are begun before
/// the first is read on. Memory is in proportion to the meshes and planes of the inputs, their data
/// and one packet, whatever the inputs claim. Errors name the input and the place: kInvalidArgument for
/// frames that are not there or not at GOP borders, and, where all frames are asked for, for parts of a whole
/// (tvg/parts.hpp) that are not in their order or not all there; kNotTvg, kTruncated, kChecksumMismatch,
/// kMalformed, kUnsupportedVersion and kLimitExceeded for inputs that are no whole streams (GOPs are checked
/// by their checksums, not decoded: `Decoder` does that); and what inputs and sink return. After an error
/// what went to the sink is no stream.
Result<JoinReport> join(std::vector<JoinInput> inputs, const JoinOptions& options, const ByteSink& sink,
                        const EncodeProgress& progress = {});

}  // namespace tvg
