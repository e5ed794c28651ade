#pragma once
#include <optional>
#include <span>

#include <tvg/source.hpp>

namespace tvg::cli {

/// A quarter turn about the x axis.
enum class Turn {
  kZUpToYUp,  ///< (x, y, z) becomes (x, z, -y)
  kYUpToZUp,  ///< (x, y, z) becomes (x, -z, y)
};

/// The turn that brings a cache to its mesh, where the cache lies far from it as it is and near it turned;
/// both are [vertex][xyz], the cache's first frame.
std::optional<Turn> find_quarter_turn(std::span<const float> mesh, std::span<const float> cache);

/// A source with its positions turned.
class TurnedSource final : public SourceDecorator {
 public:
  TurnedSource(std::unique_ptr<FrameSource> source, Turn turn)
      : SourceDecorator(std::move(source)), turn_(turn) {}

  Result<bool> read_frame(std::span<float> positions) override;

 private:
  Turn turn_;
};

}  // namespace tvg::cli
