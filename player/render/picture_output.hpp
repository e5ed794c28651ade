#pragma once
#include "player/render/render_options.hpp"
#include "player/view/image.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tvg::player {

/// Takes finished pictures to where the user wants them.
class PictureOutput {
 public:
  virtual ~PictureOutput() = default;

  /// `frame`: the picture's number in its sequence.
  virtual void add(const Image& image, std::uint64_t frame) = 0;
  /// The last picture was added.
  virtual void finish() = 0;
  /// Names of the files that are complete.
  const std::vector<std::string>& files() const { return files_; }

 protected:
  std::vector<std::string> files_;
};

/// `fps`: for a clip. Throws ToolError, see VideoWriter.
std::unique_ptr<PictureOutput> open_output(const RenderOptions& options, const std::string& fps);

}  // namespace tvg::player
