// Timing of variants that are to be compared: in turn, in random order, within one process, so that slow
// spells of the machine hit all alike.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hybray {

struct Variant {
  std::string name;
  std::function<void()> run;
};

// Wall times, milliseconds: times[variant][repeat], repeat r of all variants taken close together.
struct InterleavedTimes {
  std::vector<std::vector<double>> ms;
  std::span<const double> of(size_t variant) const { return ms[variant]; }
};

// Runs every variant once without counting it, then `repeats` >= 1 rounds, each of which runs all variants
// once in an order drawn from (seed, round).
InterleavedTimes time_interleaved(std::span<const Variant> variants, int repeats, uint64_t seed);

}  // namespace hybray
