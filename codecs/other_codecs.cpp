#include "codecs/other_codecs.hpp"

#include <array>

namespace tvg::bench {

namespace {

#ifdef TVG_HAS_DRACO
constexpr auto kRunDraco = run_draco;
#else
constexpr CodecResult (*kRunDraco)(const LatticeSequence&, int) = nullptr;
#endif

constexpr std::array<OtherCodec, 4> kCodecs = {{{"draco", kRunDraco},
                                                {"meshopt", run_meshoptimizer},
                                                {"meshopt+zstd", run_meshoptimizer_zstd},
                                                {"zstd", run_zstd_deltas}}};

}  // namespace

std::span<const OtherCodec> other_codecs() {
  return kCodecs;
}

}  // namespace tvg::bench
