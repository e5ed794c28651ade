#include "encoder/live/stream_output.hpp"

#include "tool/atomic_file.hpp"
#include "tool/remote_stream.hpp"
#ifdef TVG_HAS_PLAYER
#include "encoder/live/http_upload.hpp"
#else
#include "tool/tool_error.hpp"
#endif

namespace tvg::cli {

namespace {

class FileOutput final : public StreamOutput {
 public:
  FileOutput(const std::string& path, bool live) : file_(path), live_(live) {}

  void write(std::span<const std::uint8_t> bytes) override {
    file_.write(bytes.data(), bytes.size());
    if (live_) file_.flush();
  }
  void finish() override { file_.finish(); }

 private:
  AtomicFile file_;
  bool live_;
};

}  // namespace

std::unique_ptr<StreamOutput> open_stream_output(const std::string& target, bool live) {
  if (is_address(target)) {
#ifdef TVG_HAS_PLAYER
    return std::make_unique<HttpUpload>(target);
#else
    throw ToolError(ExitStatus::kUsage, "cannot upload to " + target +
                                            ": this tvg was built without HTTP; -o - | curl -T - " + target +
                                            " does the same");
#endif
  }
  return std::make_unique<FileOutput>(target, live);
}

}  // namespace tvg::cli
