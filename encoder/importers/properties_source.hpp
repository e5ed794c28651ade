#pragma once
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <tvg/source.hpp>

namespace tvg::cli {

/// The frames of another source with what their mesh has beside, none of it animated. Data are those given
/// and then those of the other source.
class PropertiesSource final : public SourceDecorator {
 public:
  PropertiesSource(std::unique_ptr<FrameSource> source, MeshProperties properties,
                   std::vector<NamedData> data)
      : SourceDecorator(std::move(source)), properties_(std::move(properties)), data_(std::move(data)) {
    const std::span<const NamedData> others = SourceDecorator::data();
    data_.insert(data_.end(), others.begin(), others.end());
  }

  const MeshProperties& properties() const override { return properties_; }
  std::span<const NamedData> data() const override { return data_; }

 private:
  MeshProperties properties_;
  std::vector<NamedData> data_;
};

}  // namespace tvg::cli
