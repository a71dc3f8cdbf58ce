#include "core/metrics/binomial.h"

#include "core/base/error.h"
#include "core/base/hash.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

TEST(ClopperPearson, GivesTheIntervalsOfScipy) {
  // scipy 1.17.1: binomtest(successes, trials).proportion_ci(confidence, "exact"), good to the tolerance of
  // its root search.
  struct Case {
    int64_t successes, trials;
    double confidence, low, high;
  };
  for (const Case& c : {Case{3, 10, 0.95, 0.06673951117773447, 0.652452850060008},
                        {3, 10, 0.99, 0.03700722109620741, 0.7351139852871308},
                        {81, 263, 0.95, 0.25273674558504267, 0.36762192260134746}}) {
    const Interval interval = clopper_pearson(c.successes, c.trials, c.confidence);
    EXPECT_DOUBLE_EQ(interval.value, static_cast<double>(c.successes) / static_cast<double>(c.trials));
    EXPECT_NEAR(interval.low, c.low, 1e-9 * c.low);
    EXPECT_NEAR(interval.high, c.high, 1e-9 * c.high);
  }
}

TEST(ClopperPearson, OfNoneAndOfAllIsItsClosedForm) {
  // (1 - p)^n = 0.025.
  for (const int64_t n : {1, 10, 5000}) {
    const double far = std::pow(0.025, 1.0 / static_cast<double>(n));
    const Interval none = clopper_pearson(0, n), all = clopper_pearson(n, n);
    EXPECT_EQ(none.low, 0.0);
    EXPECT_NEAR(none.high, 1.0 - far, 1e-12);
    EXPECT_NEAR(all.low, far, 1e-12);
    EXPECT_EQ(all.high, 1.0);
  }
}

TEST(ClopperPearson, OfOneAmongVeryManyIsRightInItsTails) {
  // At the lower end 1 - (1 - p)^n = 0.025; at the upper end (1 - p)^n + n p (1 - p)^(n - 1) = 0.025.
  constexpr double kTrials = 1e6;
  const Interval interval = clopper_pearson(1, 1000000);
  const double low = -std::expm1(std::log1p(-0.025) / kTrials), p = interval.high;
  EXPECT_NEAR(interval.low, low, 1e-10 * low);
  EXPECT_NEAR(std::exp(kTrials * std::log1p(-p)) + kTrials * p * std::exp((kTrials - 1.0) * std::log1p(-p)),
              0.025, 1e-10);
}

TEST(ClopperPearson, CoversTheTrueProportionAtLeastAsOftenAsItSays) {
  constexpr int kTrials = 4000, kDraws = 20;
  for (const double p : {0.03, 0.2, 0.5}) {
    int covered = 0;
    for (uint64_t trial = 0; trial < kTrials; ++trial) {
      int successes = 0;
      for (uint32_t i = 0; i < kDraws; ++i) successes += random_unit(trial, i, 0, 17) < p;
      const Interval interval = clopper_pearson(successes, kDraws);
      covered += interval.low <= p && p <= interval.high;
    }
    EXPECT_GE(covered, kTrials * (0.95 - 4.0 * std::sqrt(0.95 * 0.05 / kTrials))) << p;
  }
}

TEST(ClopperPearson, RefusesWhatIsNoProportion) {
  EXPECT_THROW(clopper_pearson(0, 0), InputError);
  EXPECT_THROW(clopper_pearson(-1, 10), InputError);
  EXPECT_THROW(clopper_pearson(11, 10), InputError);
  for (double confidence : {0.0, 1.0, -0.5, std::nan("")})
    EXPECT_THROW(clopper_pearson(1, 10, confidence), InputError);
}

}  // namespace
}  // namespace hybray::metrics
