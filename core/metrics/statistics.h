// Summaries of repeated measurements.
#pragma once

#include <cstdint>
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

// Median of numerator[i] / denominator[i], taken pair by pair, with its 95 % percentile bootstrap interval
// (Efron) over the pairs. Deterministic for a given seed. Both spans have the same length, at least 1;
// denominators are not zero.
Interval median_ratio(std::span<const double> numerator, std::span<const double> denominator, uint64_t seed,
                      int resamples = 2000);

}  // namespace hybray::metrics
