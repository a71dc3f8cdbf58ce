// Summaries of repeated measurements.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

namespace hybray::metrics {

// Linear-interpolation quantile (Hyndman and Fan's type 7) of at least one value; q in [0, 1].
double quantile(std::span<const double> values, double q);
inline double median(std::span<const double> values) {
  return quantile(values, 0.5);
}

// Interquartile range: the spread that stands beside each time.
double spread(std::span<const double> values);

struct Interval {
  double value, low, high;
};

// A statistic of independent values with its 95 % percentile bootstrap interval (Efron 1979). Deterministic
// for a given seed. At least one value; the statistic is given as many values as there are.
Interval bootstrap(std::span<const double> values,
                   const std::function<double(std::span<const double>)>& statistic, uint64_t seed,
                   int resamples = 2000);

// Median of numerator[i] / denominator[i], taken pair by pair, bootstrapped over the pairs. Both spans have
// the same length, at least 1; denominators are not zero.
Interval median_ratio(std::span<const double> numerator, std::span<const double> denominator, uint64_t seed,
                      int resamples = 2000);

}  // namespace hybray::metrics
