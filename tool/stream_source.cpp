#include "tool/stream_source.hpp"

#include "tool/mesh_format.hpp"
#include "tool/tool_error.hpp"

#include <utility>

#include <tvg/data.hpp>

namespace tvg::cli {

bool is_stream_file(const std::string& path) {
  return has_suffix(path, ".tvg") || is_address(path);
}

StreamSource::StreamSource(std::string path) : path_(std::move(path)) {
  open();
  if (const auto index = reader_->read_index()) frame_count_ = index->frame_count();
}

void StreamSource::open() {
  reader_ = std::make_unique<StreamReader>(path_);
  data_.clear();
  for (;;) {
    const Decoder& decoder = reader_->decoder();
    switch (reader_->next()) {
      case Decoder::Event::kMesh:
        take_mesh();
        return;
      case Decoder::Event::kData:
        take_data(decoder.data());
        break;
      case Decoder::Event::kError:
        throw tool_error(path_, decoder.error());
      case Decoder::Event::kDamage:
        throw tool_error(path_, decoder.damage().error);
      case Decoder::Event::kEnd:
        throw ToolError(ExitStatus::kInvalidInput, path_ + ": the stream has no mesh");
      default:
        break;
    }
  }
}

/// Data of a name that came before take the place of those; what cannot be unpacked is left out.
void StreamSource::take_data(const CodedData& coded) {
  Result<NamedData> data = unpack_data(coded);
  if (!data) return;
  std::erase_if(data_, [&](const NamedData& known) { return known.name == data->name; });
  data_.push_back(std::move(*data));
}

void StreamSource::take_mesh() {
  mesh_ = reader_->decoder().mesh();
  properties_ = reader_->decoder().properties();
}

Error StreamSource::named(Error error) const {
  error.message = path_ + ": " + error.message;
  error.names_file = true;
  return error;
}

Result<bool> StreamSource::read_frame(std::span<float> positions) {
  for (;;) {
    const Decoder& decoder = reader_->decoder();
    switch (reader_->next()) {
      case Decoder::Event::kFrame:
        decoder.copy_positions(positions.data());
        return true;
      case Decoder::Event::kEnd:
        return false;
      case Decoder::Event::kError:
        return named(decoder.error());
      case Decoder::Event::kDamage:
        return named(decoder.damage().error);
      case Decoder::Event::kMesh:
        changed_ = true;
        return named({ErrorCode::kInvalidInput,
                      "the stream goes on with another mesh: take its parts one by one",
                      {},
                      {},
                      ""});
      default:
        break;
    }
  }
}

Result<bool> StreamSource::begin_next_mesh() {
  if (!changed_) return false;
  changed_ = false;
  take_mesh();
  return true;
}

bool StreamSource::rewind() {
  if (!reader_->size()) return false;
  changed_ = false;
  open();
  return true;
}

}  // namespace tvg::cli
