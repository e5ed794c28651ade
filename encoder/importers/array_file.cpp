#include "encoder/importers/array_file.hpp"

#include "encoder/importers/import_error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace tvg::cli {

namespace {

class NpyFile final : public ArrayFile {
 public:
  explicit NpyFile(const std::string& path) : file_(path) {
    if (!file_.size()) {
      throw ImportError(ErrorCode::kInvalidInput,
                        fmt::format("{}: a NumPy array is read of a regular file only", file_.name()));
    }
  }
  const std::string& name() const override { return file_.name(); }
  std::uint64_t size() const override { return *file_.size(); }
  std::size_t read(void* data, std::size_t size) override { return file_.read(data, size); }
  void seek(std::uint64_t offset) override { file_.seek(offset); }

 private:
  InputFile file_;
};

}  // namespace

std::unique_ptr<ArrayFile> open_array_file(const std::string& path) {
  return std::make_unique<NpyFile>(path);
}

}  // namespace tvg::cli
