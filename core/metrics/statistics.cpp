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

Interval bootstrap(std::span<const double> values,
                   const std::function<double(std::span<const double>)>& statistic, uint64_t seed,
                   int resamples) {
  const size_t n = values.size();
  std::vector<double> sample(n), statistics(static_cast<size_t>(resamples));
  for (int r = 0; r < resamples; ++r) {
    for (size_t i = 0; i < n; ++i) sample[i] = values[random_bits(i, 0, static_cast<uint32_t>(r), seed) % n];
    statistics[static_cast<size_t>(r)] = statistic(sample);
  }
  return {statistic(values), quantile(statistics, 0.025), quantile(statistics, 0.975)};
}

Interval median_ratio(std::span<const double> numerator, std::span<const double> denominator, uint64_t seed,
                      int resamples) {
  HYBRAY_CHECK_EQ(numerator.size(), denominator.size());
  std::vector<double> ratios(numerator.size());
  for (size_t i = 0; i < ratios.size(); ++i) ratios[i] = numerator[i] / denominator[i];
  return bootstrap(ratios, median, seed, resamples);
}

}  // namespace hybray::metrics
