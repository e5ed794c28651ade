#pragma once
#include <array>
#include <string_view>

namespace tvg::bench {

/// Whole files of MPEG's reference coders, bits per coordinate, measured once on these sequences with the
/// reference software; it is not part of this repository and is not run here. Both at the error of the
/// lattice of B bits: FAMC (MPEG-4, its LD mode, the whole sequence as one segment) at equal RMS, the
/// base-mesh coder of V-DMC version 14 exact on the lattice.
struct PublishedRate {
  std::string_view sequence;
  std::string_view codec;
  int bits;                    ///< B
  double bits_per_coordinate;  ///< connectivity and headers included
};

constexpr std::array<PublishedRate, 11> kPublishedRates = {{{"chicken", "FAMC", 11, 0.66},
                                                            {"cow", "FAMC", 11, 2.38},
                                                            {"dance", "FAMC", 11, 1.57},
                                                            {"horse-gallop", "FAMC", 11, 2.53},
                                                            {"crane", "FAMC", 11, 1.57},
                                                            {"chicken", "V-DMC", 11, 1.24},
                                                            {"chicken", "V-DMC", 13, 1.70},
                                                            {"cow", "V-DMC", 11, 2.65},
                                                            {"dance", "V-DMC", 11, 1.98},
                                                            {"horse-gallop", "V-DMC", 11, 2.20},
                                                            {"crane", "V-DMC", 11, 1.82}}};

}  // namespace tvg::bench
