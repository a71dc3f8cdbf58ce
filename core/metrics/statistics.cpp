#include "core/metrics/statistics.h"

#include "core/base/check.h"
#include "core/base/hash.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hybray::metrics {

double quantile(std::span<const double> values, double q) {
  HYBRAY_CHECK_LT(size_t{0}, values.size());
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double at = q * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(std::floor(at)), above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double spread(std::span<const double> values) {
  return quantile(values, 0.75) - quantile(values, 0.25);
}

Interval median_ratio(std::span<const double> numerator, std::span<const double> denominator, uint64_t seed,
                      int resamples) {
  HYBRAY_CHECK_EQ(numerator.size(), denominator.size());
  const size_t n = numerator.size();
  std::vector<double> ratios(n), sample(n), medians(static_cast<size_t>(resamples));
  for (size_t i = 0; i < n; ++i) ratios[i] = numerator[i] / denominator[i];
  for (int r = 0; r < resamples; ++r) {
    for (size_t i = 0; i < n; ++i) sample[i] = ratios[random_bits(i, 0, static_cast<uint32_t>(r), seed) % n];
    medians[static_cast<size_t>(r)] = median(sample);
  }
  return {median(ratios), quantile(medians, 0.025), quantile(medians, 0.975)};
}

}  // namespace hybray::metrics
