#include "player/render/picture_output.hpp"

#include "player/render/video_writer.hpp"

namespace tvg::player {

namespace {

/// One picture, or one per frame under numbered names.
class PngOutput final : public PictureOutput {
 public:
  explicit PngOutput(const RenderOptions& options) : options_(options) {}

  void add(const Image& image, std::uint64_t frame) override {
    const std::string path = options_.pattern ? options_.pattern->path(frame) : options_.output;
    write_png(path, image);
    files_.push_back(path);
  }
  void finish() override {}

 private:
  const RenderOptions& options_;
};

class VideoOutput final : public PictureOutput {
 public:
  VideoOutput(const RenderOptions& options, const std::string& fps)
      : path_(options.output), writer_(options.output, options.width, options.height, fps) {}

  void add(const Image& image, std::uint64_t) override { writer_.add(image); }
  void finish() override {
    writer_.finish();
    files_.push_back(path_);
  }

 private:
  std::string path_;
  VideoWriter writer_;
};

}  // namespace

std::unique_ptr<PictureOutput> open_output(const RenderOptions& options, const std::string& fps) {
  if (options.kind == RenderOptions::Output::kVideo) return std::make_unique<VideoOutput>(options, fps);
  return std::make_unique<PngOutput>(options);
}

}  // namespace tvg::player
