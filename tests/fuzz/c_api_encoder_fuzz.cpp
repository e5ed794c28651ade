#include "c_api/encoder_script.hpp"
#include "fuzz/require.hpp"

#include <cstdio>

/// The input: a script of calls on the encoding half of the C interface, as encoder_script.cpp reads it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string broken = tvg::test::EncoderScript({data, size}).run();
  if (!broken.empty()) std::fprintf(stderr, "not kept: %s\n", broken.c_str());
  tvg::fuzz::require(broken.empty());
  return 0;
}
