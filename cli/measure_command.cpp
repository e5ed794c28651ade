#include "cli/commands.hpp"
#include "cli/input_options.hpp"
#include "cli/measure_options.hpp"
#include "cli/measure_report.hpp"
#include "cli/measured_ply.hpp"
#include "cli/number_option.hpp"
#include "tool/frame_pattern.hpp"
#include "tool/measured_frame.hpp"
#include "tool/mesh_format.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"
#ifdef TVG_HAS_PLAYER
#include "cli/look_options.hpp"
#include "player/render/measure_picture.hpp"
#endif

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include <tvg/encoder.hpp>

namespace tvg::cli {

namespace {

struct MeasureCommandArguments {
  InputArguments input;
  MeasureArguments measure;
  std::uint32_t gop = EncodeOptions().gop_frames;
  std::optional<std::uint64_t> frame;
  std::string ply;
  std::string colour = "cost";
  bool json = false;
  bool quiet = false;
#ifdef TVG_HAS_PLAYER
  std::string picture;
  player::LookArguments look;
#endif

  /// Whether one frame is to be shown.
  bool shows_one() const {
#ifdef TVG_HAS_PLAYER
    if (!picture.empty()) return true;
#endif
    return !ply.empty() && !parse_frame_pattern(ply);
  }
};

/// Measures GOP after GOP, and shows the frames that are asked for as they pass.
class MeasureJob {
 public:
  explicit MeasureJob(const MeasureCommandArguments& arguments)
      : arguments_(arguments),
        importance_(importance_of(arguments.measure)),
        pattern_(parse_frame_pattern(arguments.ply)),
#ifdef TVG_HAS_PLAYER
        look_(player::parse_look(arguments.look)),
#endif
        bar_("measuring", arguments.quiet) {
    check_outputs();
    opened_ = open_input_or_stream(arguments.input);
    check_measure(arguments.measure, importance_, *opened_.source, arguments.input.inputs);
    if (!arguments.quiet) print_notes(opened_);
    choose_frame();
  }

  void run() {
    MeasureReport report = empty_report();
    std::vector<std::uint8_t> flags;  // of the GOP before
    const Status status =
        measure_gops(*opened_.source, arguments_.gop, importance_, [&](const GopMeasure& gop) {
          report.gops.push_back(statistics_of(gop, flags));
          flags = gop.measure.flags;
          show(gop);
          bar_.update(gop.first_frame + gop.frames.size(), opened_.source->frame_count());
          return Status();
        });
    if (!status.ok()) throw tool_error(input_names(arguments_.input), status.error());
    bar_.clear();
    if (shown_frame_ && !shown_) throw no_such_frame(report);
    arguments_.json ? print_report_json(report) : print_report(report);
  }

 private:
  void check_outputs() const {
    if (!arguments_.ply.empty() && !has_suffix(arguments_.ply, ".ply")) {
      fail_option("--ply", arguments_.ply, "write cost.ply, or cost_%04d.ply for every frame");
    }
    if (arguments_.frame && !arguments_.shows_one()) {
      throw ToolError(ExitStatus::kUsage,
                      "--frame: say how the frame is to be shown, with --ply cost.ply"
#ifdef TVG_HAS_PLAYER
                      " or --picture cost.png"
#endif
      );
    }
    const InputFiles inputs = files_of(arguments_.input, arguments_.measure.weights());
    inputs.check_output(arguments_.ply);
#ifdef TVG_HAS_PLAYER
    if (!arguments_.picture.empty() && !has_suffix(arguments_.picture, ".png")) {
      fail_option("--picture", arguments_.picture, "write cost.png");
    }
    inputs.check_output(arguments_.picture);
#endif
  }

  /// The frame that is shown: the one asked for, or the middle one, or where their number is not known the
  /// first.
  void choose_frame() {
    if (!arguments_.shows_one()) return;
    shown_frame_ =
        arguments_.frame.value_or(opened_.first_frame + opened_.source->frame_count().value_or(0) / 2);
    if (*shown_frame_ < opened_.first_frame) {
      throw ToolError(ExitStatus::kUsage, fmt::format("--frame {}: the first frame measured is {}",
                                                      *shown_frame_, opened_.first_frame));
    }
  }

  ToolError no_such_frame(const MeasureReport& report) const {
    const GopStatistics& last = report.gops.back();
    return {ExitStatus::kUsage,
            fmt::format("--frame {}: {} ends after frame {}", *shown_frame_, input_names(arguments_.input),
                        opened_.first_frame + last.first_frame + last.frame_count - 1)};
  }

  MeasureReport empty_report() const {
    const FrameSource& source = *opened_.source;
    MeasureReport report;
    report.input = input_names(arguments_.input);
    report.criteria = arguments_.measure.criteria;
    report.importance = importance_;
    report.vertices = source.mesh().vertex_count;
    report.faces = source.mesh().faces.size();
    report.first_frame = opened_.first_frame;
    report.skeleton = source.skeleton();
    return report;
  }

  void show(const GopMeasure& gop) {
    const std::uint64_t first = opened_.first_frame + gop.first_frame;
    if (pattern_) {
      const VertexAttributes attributes = ply_attributes(gop.measure, colour());
      for (std::size_t i = 0; i < gop.frames.size(); ++i) {
        write_coloured_ply(pattern_->path(first + i), opened_.source->mesh(), gop.frames[i], attributes);
      }
    }
    if (!shown_frame_ || *shown_frame_ < first || *shown_frame_ >= first + gop.frames.size()) return;
    shown_ = true;
    const auto index = static_cast<std::size_t>(*shown_frame_ - first);
    if (!arguments_.ply.empty() && !pattern_) {
      write_coloured_ply(arguments_.ply, opened_.source->mesh(), gop.frames[index],
                         ply_attributes(gop.measure, colour()));
    }
#ifdef TVG_HAS_PLAYER
    if (!arguments_.picture.empty()) {
      player::draw_measure_picture(arguments_.picture, *opened_.source, measured_frame(gop, index, first),
                                   arguments_.measure.criteria, look_);
    }
#endif
  }

  MeasureColour colour() const {
    return arguments_.colour == "flags" ? MeasureColour::kFlags : MeasureColour::kCost;
  }

  const MeasureCommandArguments& arguments_;
  const Importance importance_;
  const std::optional<FramePattern> pattern_;  // of --ply
#ifdef TVG_HAS_PLAYER
  const player::Look look_;
#endif
  ProgressBar bar_;
  OpenedInput opened_;
  std::optional<std::uint64_t> shown_frame_;
  bool shown_ = false;
};

}  // namespace

void add_measure_command(CLI::App& tool) {
  auto arguments = std::make_shared<MeasureCommandArguments>();
  CLI::App& command = *tool.add_subcommand("measure", "Show which vertices matter to an animation, and why");
  add_input_options(command, arguments->input, ", or a .tvg");
  command.add_option("--fps", arguments->input.fps,
                     "frames per second at which a scene is sampled (default 30)");
  command.add_option("--gop", arguments->gop, "frames that are measured together, as encode does")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  add_measure_options(command, arguments->measure);
  add_count(
      command, "--frame", [arguments](std::uint64_t frame) { arguments->frame = frame; },
      "the frame that is shown, counted from 0 (default: the middle)");
  command.add_option("--ply", arguments->ply,
                     "write the frame as a coloured PLY with the properties cost and important, or every "
                     "frame (cost_%04d.ply)");
  command.add_option("--colour", arguments->colour, "of a PLY: cost or flags")
      ->check(CLI::IsMember({"cost", "flags"}))
      ->capture_default_str();
#ifdef TVG_HAS_PLAYER
  command.add_option("--picture", arguments->picture,
                     "draw the frame: cost and flags side by side, with the skeleton where there is one");
  add_view_options(command, arguments->look);
#endif
  command.add_flag("--json", arguments->json, "print everything as JSON");
  command.add_flag("-q,--quiet", arguments->quiet, "show no progress and no notes");
  command.callback([arguments] { MeasureJob(*arguments).run(); });
}

}  // namespace tvg::cli
