#pragma once
#include <optional>
#include <string>

#include <tvg/encoder.hpp>
#include <tvg/source.hpp>

namespace tvg::cli {

/// How the frames of a live stream come.
struct LiveInput {
  /// Frames per second at which a source that has all its frames already gives them out; absent for one whose
  /// frames come when they come.
  std::optional<double> pace = {};
  bool loop = false;        ///< begin again at the end, for ever, where the source can be rewound
  bool open_ended = false;  ///< ends where it ends: a frame cut short is no error
};

struct LiveReport : EncodeReport {
  /// Where an open-ended input ended inside a frame: what it said about that.
  std::optional<std::string> cut_short;
};

/// Pushes the frames of a source through an encoder, each at its time, so that the sink gets a GOP as soon as
/// it is complete. No frame is looked at twice: without a step, each GOP has a bounding box of its own. Fails
/// as the source and the encoder do.
Result<LiveReport> encode_live(FrameSource& source, EncodeOptions options, const LiveInput& input,
                               const ByteSink& sink, const EncodeProgress& progress = {});

}  // namespace tvg::cli
