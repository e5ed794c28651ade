#pragma once
#include "cli/encode_options.hpp"

#include <string>

namespace tvg::cli {

/// What inputs may be: those of `tvg encode`, or a .tvg as well.
enum class InputKinds { kNoStreams, kStreamsToo };

/// Opens the inputs and completes the options by them: first frame and coarser meshes. Prints notes unless it
/// is to be quiet. Throws ToolError as open_input(), check_measure() and simplified_levels() do.
OpenedInput open_for_encoding(const EncodeArguments& arguments, EncodeOptions& options,
                              InputKinds kinds = InputKinds::kNoStreams);

/// Encodes all frames behind a progress bar. Throws ToolError, and what the sink throws.
EncodeReport encode_frames(FrameSource& source, const EncodeOptions& options, const ByteSink& sink,
                           const EncodeArguments& arguments);

/// Prints what became of the frames to standard output as JSON, with what a caller would be told in words.
/// `seconds`: what it took.
void print_encode_json(const std::string& output, const EncodeReport& report, double seconds);

/// Prints what became of the frames to standard error. `output`: its name.
void print_encode_report(const std::string& output, const EncodeReport& report);

}  // namespace tvg::cli
