// Whether two series differ that were measured in pairs: two methods on the same scenes, frames or rays.
//
// Pairs, because what they have in common (the scene, the seed, the machine's mood) then cancels. Two tests:
// Student's t where the differences are near normal, as those of means over many pixels are; Wilcoxon's
// signed ranks (1945) where they may be anything symmetric, as times and errors that hang on few pixels are:
// it loses 5 % of t's efficiency on normal differences, where the sign test, which is not offered, would lose
// 36 %.
#pragma once

#include <span>

namespace hybray::metrics {

struct TestResult {
  double statistic = 0.0;
  double p = 1.0;  // two-sided: how often chance alone gives a statistic at least as far out
};

// t = mean(a - b) / its standard error, n - 1 degrees of freedom. Where all differences are the same, t is
// infinite and p = 0, or t = 0 and p = 1 where they are 0. Throws InputError for series of different length,
// fewer than 2 pairs, NaN and infinity.
TestResult paired_t(std::span<const double> a, std::span<const double> b);

// Sum of the ranks of |a - b| over the pairs with a > b; pairs without a difference are left out, tied ones
// share the mean of their ranks. p from the exact distribution of that sum for these ranks, up to 200 pairs;
// beyond from the normal distribution with the ranks' own variance. With fewer than 6 pairs p cannot fall
// below 0.05. Throws InputError for series of different length, none at all, NaN and infinity.
TestResult wilcoxon_signed_rank(std::span<const double> a, std::span<const double> b);

}  // namespace hybray::metrics
