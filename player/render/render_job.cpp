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

/// What moves about after the first frame of a pipe, in radii of that.
constexpr double kRoom = 0.24;

class RenderJob {
 public:
  explicit RenderJob(const RenderOptions& options)
      : options_(options), frames_(options), bar_("rendering", options.quiet) {
    camera_.set_angles(options.angles);
    camera_.set_orientation(options.orientation.of(frames_.metadata()));
  }

  void run() {
    count_ = frames_.wanted();
    // What a file holds is looked through first, so that camera and colours keep still; a pipe shows its
    // first frame only.
    if (frames_.rewind()) {
      survey_all();
    } else if (is_sheet() && !count_) {
      throw cli::ToolError(
          cli::ExitStatus::kUsage,
          "standard input can be read only once: name the frames of the picture with --frames");
    } else {
      plan();
    }
    PicturePainter painter(options_.width, options_.height, options_.style, options_.labels, options_.axes);
    if (is_sheet()) {
      draw_sheet(painter);
    } else {
      draw_frames(painter);
    }
    if (options_.quiet) return;
    bar_.clear();
    report();
  }

 private:
  bool is_sheet() const {
    return options_.kind == RenderOptions::Output::kPicture && (count_ != 1 || options_.sheet);
  }

  /// Cells, and of a sheet the frames in them: by count_, which a sheet has to know.
  void plan() {
    int columns = 1, rows = 1;
    const int across = options_.side_by_side ? 2 : 1;
    in_sheet_.clear();
    if (is_sheet()) {
      const SheetShape shape =
          options_.sheet ? *options_.sheet : sheet_shape(*count_, options_.width, options_.height * across);
      columns = shape.columns;
      rows = shape.rows;
      in_sheet_ =
          spread_evenly(*count_, static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows));
    }
    cells_ = sheet_cells(options_.width, options_.height, columns * across, rows);
    extent_ = camera_.extent(static_cast<double>(cells_[0].width) / cells_[0].height);
  }

  /// Looks through all frames for what is to be in the picture.
  void survey_all() {
    if (!count_) count_ = look_through(false);
    for (;;) {
      plan();
      const std::uint64_t count = look_through(true);
      if (count == count_) break;
      count_ = count;  // the input has other frames than it says
    }
    surveyed_ = true;
  }

  /// Returns how many frames there are, and goes back to the first.
  std::uint64_t look_through(bool surveys) {
    std::uint64_t count = 0;
    cli::ProgressBar bar("looking through", options_.quiet);
    while (frames_.next()) {
      const bool is_shown = in_sheet_.empty() || std::ranges::binary_search(in_sheet_, count);
      if (surveys && is_shown) survey_frame();
      bar.update(++count, frames_.wanted());
    }
    if (count == 0) throw no_frames();
    check_complete(count);
    frames_.rewind();
    return count;
  }

  void survey_frame() {
    extend_view(frames_.frame());
    if (options_.side_by_side) extend_view(frames_.reference());
  }

  void extend_view(const ShownFrame& frame) {
    if (!shows_nothing(*frame.mesh)) extent_->extend(frame.positions);
  }

  /// Once the camera knows what it looks at: after the survey, or at the first frame of a pipe.
  void prepare(PicturePainter& painter) {
    if (!surveyed_) {
      survey_frame();
      extent_->pad(kRoom * view_radius(extent_->bounds()));
    }
    frames_.keep_scale(surveyed_);
    camera_.fit(*extent_);
    painter.set_scene(extent_->bounds(), camera_);
    if (!options_.shading_is_given) painter.set_shading(shading_of(frames_.metadata()));
  }

  void draw_frames(PicturePainter& painter) {
    const std::unique_ptr<PictureOutput> output = open_output(options_, frame_rate());
    const std::vector<double> times = frames_.times();
    while (frames_.next()) {
      if (drawn_ == 0) prepare(painter);
      painter.begin();
      draw_frame(painter, cells_, {});
      const Image& image = finish(painter);
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
    const std::size_t across = options_.side_by_side ? 2 : 1;
    painter.begin();
    std::uint64_t position = 0;
    while (drawn_ < in_sheet_.size() && frames_.next()) {
      if (position == 0) prepare(painter);
      if (position++ != in_sheet_[drawn_]) continue;
      const auto first = cells_.begin() + static_cast<std::ptrdiff_t>(drawn_ * across);
      draw_frame(painter, {first, first + static_cast<std::ptrdiff_t>(across)},
                 fmt::format("frame {}", frames_.frame().number));
      bar_.update(++drawn_, in_sheet_.size());
    }
    if (drawn_ < in_sheet_.size()) check_complete(position);
    for (std::size_t i = drawn_ * across; i < cells_.size(); ++i) painter.clear(cells_[i]);
    write_png(options_.output, finish(painter));
    files_ = {options_.output};
  }

  const Image& finish(PicturePainter& painter) const {
    if (frames_.legend()) painter.legend(*frames_.legend(), options_.side_by_side);
    painter.axes(cells_.back());
    return painter.finish();
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
  OrbitCamera camera_;
  std::optional<ViewExtent> extent_;  // of what is drawn
  std::vector<Cell> cells_;
  std::vector<std::uint64_t> in_sheet_;  // which of the frames wanted; empty where that is no sheet
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
