#include "player/render/render_job.hpp"

#include "player/render/overlay_frames.hpp"
#include "player/render/picture.hpp"
#include "player/render/picture_output.hpp"
#include "player/render/sheet.hpp"
#include "tool/frame_times.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace tvg::player {

namespace {

class RenderJob {
 public:
  explicit RenderJob(const RenderOptions& options)
      : options_(options), frames_(options), bar_("rendering", options.quiet) {}

  void run() {
    const bool single = options_.kind == RenderOptions::Output::kPicture;
    // What a file holds is looked through first, so that camera and colours keep still; a pipe shows its
    // first frame only.
    if (frames_.rewind()) {
      survey_all();
    } else if (single && !options_.frames) {
      throw cli::ToolError(
          cli::ExitStatus::kUsage,
          "standard input can be read only once: name the frames of the picture with --frames");
    } else {
      count_ =
          options_.frames ? std::optional(options_.frames->last - options_.frames->first + 1) : std::nullopt;
    }
    PicturePainter painter(options_.width, options_.height, options_.style, options_.labels);
    if (single && (count_ != 1 || options_.sheet)) {
      draw_sheet(painter);
    } else {
      draw_frames(painter);
    }
    if (options_.quiet) return;
    bar_.clear();
    report();
  }

 private:
  void survey_all() {
    std::uint64_t count = 0;
    cli::ProgressBar bar("looking through", options_.quiet);
    while (frames_.next()) {
      survey_frame();
      bar.update(++count, frames_.wanted());
    }
    if (count == 0) throw no_frames();
    check_complete(count);
    count_ = count;
    surveyed_ = true;
    frames_.rewind();
  }

  void survey_frame() {
    extend_bounds(frames_.frame());
    if (options_.side_by_side) extend_bounds(frames_.reference());
  }

  void extend_bounds(const ShownFrame& frame) {
    if (!shows_nothing(*frame.mesh)) bounds_.extend(frame.positions);
  }

  /// Once the camera knows what it looks at: after the survey, or at the first frame of a pipe.
  void prepare(PicturePainter& painter, int cell_width, int cell_height) {
    if (!surveyed_) {
      survey_frame();
      bounds_.pad(0.24 * view_radius(bounds_));
    }
    frames_.keep_scale(surveyed_);
    OrbitCamera camera;
    camera.set_angles(options_.angles);
    const UpAxis up_axis = up_axis_of(frames_.metadata());
    camera.fit_closely(bounds_, up_axis, static_cast<double>(cell_width) / cell_height);
    painter.set_scene(bounds_, up_axis, camera);
    if (!options_.shading_is_given) painter.set_shading(shading_of(frames_.metadata()));
  }

  void draw_frames(PicturePainter& painter) {
    const std::unique_ptr<PictureOutput> output = open_output(options_, frame_rate());
    const std::vector<Cell> cells =
        sheet_cells(options_.width, options_.height, options_.side_by_side ? 2 : 1, 1);
    const std::vector<double> times = frames_.times();
    while (frames_.next()) {
      if (drawn_ == 0) prepare(painter, cells[0].width, cells[0].height);
      painter.begin();
      draw_frame(painter, cells, {});
      if (frames_.legend()) painter.legend(*frames_.legend(), options_.side_by_side);
      const Image& image = painter.finish();
      for (std::uint64_t i = pictures_of(frames_.frame().number, times); i > 0; --i)
        output->add(image, frames_.frame().number);
      bar_.update(++drawn_, count_);
    }
    if (drawn_ == 0) throw no_frames();
    check_complete(drawn_);
    output->finish();
    files_ = output->files();
  }

  void draw_sheet(PicturePainter& painter) {
    const int across = options_.side_by_side ? 2 : 1;
    const SheetShape shape =
        options_.sheet ? *options_.sheet : sheet_shape(*count_, options_.width, options_.height * across);
    const std::vector<std::uint64_t> wanted = spread_evenly(
        *count_, static_cast<std::uint64_t>(shape.columns) * static_cast<std::uint64_t>(shape.rows));
    const std::vector<Cell> cells =
        sheet_cells(options_.width, options_.height, shape.columns * across, shape.rows);
    painter.begin();
    std::uint64_t position = 0;
    while (drawn_ < wanted.size() && frames_.next()) {
      if (position == 0) prepare(painter, cells[0].width, cells[0].height);
      if (position++ != wanted[drawn_]) continue;
      const auto first = cells.begin() + static_cast<std::ptrdiff_t>(drawn_) * across;
      draw_frame(painter, {first, first + across}, fmt::format("frame {}", frames_.frame().number));
      bar_.update(++drawn_, wanted.size());
    }
    if (drawn_ < wanted.size()) check_complete(position);
    for (std::size_t i = drawn_ * static_cast<std::size_t>(across); i < cells.size(); ++i)
      painter.clear(cells[i]);
    if (frames_.legend()) painter.legend(*frames_.legend(), options_.side_by_side);
    write_png(options_.output, painter.finish());
    files_ = {options_.output};
  }

  /// Draws the frame, after the reference where both are wanted.
  void draw_frame(PicturePainter& painter, const std::vector<Cell>& cells, const std::string& name) {
    if (options_.side_by_side) {
      painter.draw(frames_.reference(), PicturePainter::Which::kReference, frames_.map(), cells[0]);
      painter.label(cells[0], name.empty() ? "reference" : name + ", reference");
    }
    painter.draw(frames_.frame(), PicturePainter::Which::kShown, frames_.map(), cells.back());
    if (options_.side_by_side) {
      painter.label(cells.back(), name.empty() ? "decoded" : name + ", decoded");
    } else if (!name.empty()) {
      painter.label(cells.back(), name);
    }
  }

  /// How many pictures of the output show the frame: of a clip whose frames are uneven in time so many as
  /// come until the next one, perhaps none.
  std::uint64_t pictures_of(std::uint64_t frame, const std::vector<double>& times) const {
    if (options_.kind != RenderOptions::Output::kVideo || times.empty()) return 1;
    constexpr double kMostSeconds = 3600;  // of one frame: times may be anything
    const double rate = *cli::parse_frame_rate(frame_rate());
    const cli::FrameTimeline line(times, rate);
    const auto place = static_cast<double>(frame);
    const double begin = line.time_at(place);
    const double end = std::min(line.time_at(place + 1), begin + kMostSeconds);
    return static_cast<std::uint64_t>(std::max(0.0, std::round(end * rate) - std::round(begin * rate)));
  }

  std::string frame_rate() const {
    if (options_.fps) return *options_.fps;
    const Metadata metadata = frames_.metadata();
    const auto fps = metadata.find("fps");
    return fps != metadata.end() && cli::parse_frame_rate(fps->second) ? fps->second : "30";
  }

  cli::ToolError no_frames() const {
    return {cli::ExitStatus::kInvalidInput, options_.inputs.front() + ": there is no frame to draw"};
  }

  void check_complete(std::uint64_t count) const {
    if (!options_.frames || count == options_.frames->last - options_.frames->first + 1) return;
    throw cli::ToolError(
        cli::ExitStatus::kUsage,
        fmt::format("--frames {}-{}: {} ends after frame {}", options_.frames->first, options_.frames->last,
                    options_.inputs.front(), options_.frames->first + count - 1));
  }

  void report() const {
    if (files_.size() == 1) {
      fmt::print(stderr, "{}: {} {}, {}x{}\n", files_[0], drawn_, drawn_ == 1 ? "frame" : "frames",
                 options_.width, options_.height);
    } else {
      fmt::print(stderr, "{} to {}: {} pictures, {}x{}\n", files_.front(), files_.back(), files_.size(),
                 options_.width, options_.height);
    }
    if (const std::string note = frames_.note(); !note.empty()) fmt::print(stderr, "note: {}\n", note);
  }

  const RenderOptions& options_;
  OverlayFrames frames_;
  cli::ProgressBar bar_;
  BoundingBox bounds_;
  bool surveyed_ = false;
  std::optional<std::uint64_t> count_;  // frames that are wanted
  std::uint64_t drawn_ = 0;
  std::vector<std::string> files_;
};

}  // namespace

void render(const RenderOptions& options) {
  RenderJob(options).run();
}

}  // namespace tvg::player
