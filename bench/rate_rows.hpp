#pragma once
#include "bench/sequences.hpp"

namespace tvg::bench {

/// Prints what each mode makes of a sequence: size, error beside the lattice's, speed of one thread.
void print_rate_rows(const NamedSequence& named);

}  // namespace tvg::bench
