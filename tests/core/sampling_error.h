// How far an estimate from independent batches may lie from the truth.
#pragma once

#include <cmath>
#include <span>

#include <boost/math/distributions/students_t.hpp>

namespace hybray::test {

// Mean of independent values, of which there are at least two, and its standard error.
struct Estimate {
  double mean = 0.0, error = 0.0;
};
inline Estimate estimate(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  Estimate e;
  for (const double v : values) e.mean += v / n;
  for (const double v : values) e.error += (v - e.mean) * (v - e.mean);
  e.error = std::sqrt(e.error / (n * (n - 1.0)));
  return e;
}

// The multiple of its standard error, of `batches` values, that a mean exceeds as rarely as a normal variable
// exceeds three standard deviations (two-sided, 0.0027) in any of `comparisons` tests together: Student's t
// with batches - 1 degrees of freedom, corrected by Bonferroni. For a difference of two means, where the
// degrees of freedom are at least those of either (Welch), it errs on the side of passing. 64 batches and one
// comparison: 3.1; 150 comparisons: 4.6.
inline double error_limit(size_t batches, size_t comparisons = 1) {
  const double probability = std::erfc(3.0 / std::sqrt(2.0)) / static_cast<double>(comparisons);
  const boost::math::students_t t(static_cast<double>(batches) - 1.0);
  return boost::math::quantile(boost::math::complement(t, 0.5 * probability));
}

}  // namespace hybray::test
