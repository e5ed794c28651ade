#include "bench/sequences.hpp"
#include "connectivity/connectivity_encode.hpp"
#include "corpus/corpus.hpp"
#include "entropy/range_coder.hpp"
#include "planes/plane_coder.hpp"
#include "quantization/lattice_over_encode.hpp"

#include <array>
#include <benchmark/benchmark.h>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

// Google Benchmark of the choice in format-spec §7.3.2: residuals as symbols of a 16-letter alphabet, or as a
// few binary decisions each. Both code the same residuals of the same sequence under the same pairs of
// contexts.
namespace tvg {
namespace {

/// One residual: its two contexts and its letter.
struct TracedSymbol {
  std::uint32_t first, second, symbol;
};

/// Stands in for a RangeEncoder and writes down which models code which letter.
class TracingCoder {
 public:
  static constexpr bool kDecoding = false;

  TracingCoder& lane(std::size_t /*plane*/) { return *this; }
  std::uint32_t code(AdaptiveSymbol& first, AdaptiveSymbol& second, std::uint32_t symbol) {
    trace.push_back({number(&first), number(&second), symbol});
    return symbol;
  }
  bool code(AdaptiveBit& /*model*/, bool bit) { return bit; }
  std::uint32_t code_raw(std::uint32_t value, int /*count*/) { return value; }

  std::size_t model_count() const { return numbers_.size(); }

  std::vector<TracedSymbol> trace;

 private:
  std::uint32_t number(const AdaptiveSymbol* model) {
    return numbers_.try_emplace(model, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

  std::unordered_map<const AdaptiveSymbol*, std::uint32_t> numbers_;
};

struct Trace {
  std::vector<TracedSymbol> symbols;
  std::size_t model_count = 0;
  double vertices = 0;  ///< vertices times frames
};

Trace trace_of(const Sequence& sequence, int bits) {
  const EncodedConnectivity mesh = encode_connectivity(sequence.mesh);
  BoundingBox box;
  for (const FramePositions& frame : sequence.frames) box.extend(frame);
  const Lattice lattice = *lattice_over(box, bits, bits, {});
  PlaneCoder<3> planes(Schedule(mesh.connectivity.gates), {}, lattice);
  Predictor predictor = Predictor::kSpace;
  TracingCoder coder;
  for (const FramePositions& frame : sequence.frames) {
    planes.next();
    for (std::size_t v = 0; v < mesh.order.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        planes.indices()[v][axis] =
            quantize(frame[3 * std::size_t{mesh.order[v]} + axis], lattice.origin[axis], lattice);
      }
    }
    planes.code(coder, std::exchange(predictor, Predictor::kElp));
  }
  return {std::move(coder.trace), coder.model_count(),
          static_cast<double>(sequence.frames.size()) * sequence.mesh.vertex_count};
}

/// Letters as they are in the format: one symbol each, under the mean of two models.
struct SymbolWise {
  explicit SymbolWise(std::size_t count) : models(count) {}

  template <class Coder>
  std::uint32_t code(Coder& coder, const TracedSymbol& s) {
    return coder.code(models[s.first], models[s.second], s.symbol);
  }

  std::vector<AdaptiveSymbol> models;
};

/// The same letters as binary decisions: zero or not, sign, then the size in unary; the escape is the size 8.
struct BitWise {
  struct Model {
    AdaptiveBit zero, negative;
    std::array<AdaptiveBit, 7> larger;
  };

  explicit BitWise(std::size_t count) : models(count) {}

  template <class Coder>
  std::uint32_t code(Coder& coder, const TracedSymbol& s) {
    Model& a = models[s.first];
    Model& b = models[s.second];
    const int value = s.symbol == 15 ? 8 : static_cast<int>(s.symbol) - 7;
    if (coder.code(a.zero, b.zero, value == 0)) return 7;
    const bool negative = coder.code(a.negative, b.negative, value < 0);
    const int wanted = value < 0 ? -value : value;
    int size = 1;
    while (size < 8 && coder.code(a.larger[static_cast<std::size_t>(size - 1)],
                                  b.larger[static_cast<std::size_t>(size - 1)], size < wanted)) {
      ++size;
    }
    return size == 8 ? 15u : static_cast<std::uint32_t>(negative ? 7 - size : 7 + size);
  }

  std::vector<Model> models;
};

/// A range coder that also takes the mean of two binary models, as it takes that of two symbol models.
template <class Base>
class PairCoder : public Base {
 public:
  using Base::Base;
  using Base::code;

  bool code(AdaptiveBit& a, AdaptiveBit& b, bool bit) {
    bit = this->code_bit((a.zero_frequency() + b.zero_frequency()) / 2, bit);
    a.adapt(bit);
    b.adapt(bit);
    return bit;
  }
};

template <class Binarization>
std::vector<std::uint8_t> encode(const Trace& trace) {
  Binarization models(trace.model_count);
  PairCoder<RangeEncoder> coder;
  for (const TracedSymbol& s : trace.symbols) models.code(coder, s);
  return coder.finish();
}

template <class Binarization>
void decode(benchmark::State& state, const Trace& trace) {
  const std::vector<std::uint8_t> bytes = encode<Binarization>(trace);
  for (auto _ : state) {
    Binarization models(trace.model_count);
    PairCoder<RangeDecoder> coder(bytes);
    std::uint32_t wrong = 0;
    for (const TracedSymbol& s : trace.symbols) wrong |= models.code(coder, s) ^ s.symbol;
    if (wrong != 0) state.SkipWithError("decoded another residual");
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
  state.counters["bits/coordinate"] =
      8 * static_cast<double>(bytes.size()) / static_cast<double>(trace.symbols.size());
  state.counters["vertices/s"] =
      benchmark::Counter(trace.vertices, benchmark::Counter::kIsIterationInvariantRate);
}

void register_sequence(const std::string& name, const Sequence& sequence) {
  for (const int bits : {7, 11, 13}) {
    auto trace = std::make_shared<Trace>(trace_of(sequence, bits));
    const std::string suffix = name + "/" + std::to_string(bits);
    benchmark::RegisterBenchmark(("symbols/" + suffix).c_str(),
                                 [trace](auto& state) { decode<SymbolWise>(state, *trace); });
    benchmark::RegisterBenchmark(("bits/" + suffix).c_str(),
                                 [trace](auto& state) { decode<BitWise>(state, *trace); });
  }
}

}  // namespace
}  // namespace tvg

int main(int argc, char** argv) {
  using namespace tvg;
  benchmark::Initialize(&argc, argv);
  const std::string folder = bench::default_data_folder();
  constexpr std::size_t kFrames = 50;
  for (const std::string& name : bench::names_in(folder)) {
    register_sequence(name, bench::first_frames(bench::load(folder, name).sequence, kFrames));
  }
  register_sequence("hand", corpus::make_hand({1570, kFrames}).sequence);
  benchmark::RunSpecifiedBenchmarks();
}
