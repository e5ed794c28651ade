#pragma once
#include <type_traits>

// A loop over many symbols keeps its decoder in a variable of its own, which the compiler can hold in
// registers as long as nobody else is told its address.
namespace tvg {

/// A decoder is kept as a copy, an encoder stays where it is.
template <class Coder>
using KeptCoder = std::conditional_t<Coder::kDecoding, Coder, Coder&>;

/// Calls what is not part of the loop with the coder, a decoder by way of a copy. Returns what the call does.
template <class Coder, class Call>
[[gnu::always_inline]] inline auto apart(Coder& coder, const Call& call) {
  if constexpr (Coder::kDecoding) {
    Coder copy = coder;
    const auto result = call(copy);
    coder = copy;
    return result;
  } else {
    return call(coder);
  }
}

/// Ends the loop: the decoder that was given is where the kept one has come to.
template <class Coder>
void give_back(Coder& given, const Coder& kept) {
  if constexpr (Coder::kDecoding) given = kept;
}

}  // namespace tvg
