#include "harness/timing/interleaved.h"

#include "core/base/check.h"
#include "core/base/hash.h"

#include <chrono>
#include <numeric>
#include <utility>

namespace hybray {
namespace {

// A permutation of 0 .. n-1 (Fisher and Yates).
std::vector<size_t> random_order(size_t n, uint64_t round, uint64_t seed) {
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  for (size_t i = n; i > 1; --i)
    std::swap(order[i - 1], order[random_bits(i, 0, static_cast<uint32_t>(round), seed) % i]);
  return order;
}

// Milliseconds.
double time_once(const std::function<void()>& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

InterleavedTimes time_interleaved(std::span<const Variant> variants, int repeats, uint64_t seed) {
  HYBRAY_CHECK_LT(0, repeats);
  InterleavedTimes times;
  times.ms.resize(variants.size());
  for (const Variant& variant : variants) variant.run();
  for (int round = 0; round < repeats; ++round)
    for (size_t v : random_order(variants.size(), static_cast<uint64_t>(round), seed))
      times.ms[v].push_back(time_once(variants[v].run));
  return times;
}

}  // namespace hybray
