#include "core/metrics/statistics.h"

#include "core/base/hash.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

TEST(Quantile, MatchesHyndmanAndFansType7) {
  const std::vector<double> v{3, 1, 2, 10};
  EXPECT_DOUBLE_EQ(quantile(v, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(v, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(median(v), 2.5);
  EXPECT_DOUBLE_EQ(quantile(v, 0.75), 4.75);
  EXPECT_DOUBLE_EQ(quantile(v, 1.0), 10.0);
  EXPECT_DOUBLE_EQ(spread(v), 3.0);
  EXPECT_DOUBLE_EQ(median(std::vector<double>{7}), 7.0);
}

TEST(Bootstrap, OfAMeanIsAsWideAsItsStandardError) {
  // Percentiles of the mean of n draws of {0, 1}: binomial, sd 1 / (2 sqrt(n)); n = 400 puts the ends at 0.5
  // -+ 1.96 x 0.025. Of 2000 resamples a 2.5 % quantile lies within some 0.06 sd; four times that, and half a
  // step of 1/400.
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(i % 2);
  const auto mean = [](std::span<const double> v) {
    double sum = 0.0;
    for (const double x : v) sum += x;
    return sum / static_cast<double>(v.size());
  };
  const Interval interval = bootstrap(values, mean, 3);
  EXPECT_DOUBLE_EQ(interval.value, 0.5);
  EXPECT_NEAR(interval.low, 0.5 - 1.96 * 0.025, 4 * 0.06 * 0.025 + 0.00125);
  EXPECT_NEAR(interval.high, 0.5 + 1.96 * 0.025, 4 * 0.06 * 0.025 + 0.00125);
  EXPECT_EQ(bootstrap(values, mean, 3).low, interval.low) << "the same for a seed";
  const std::vector<double> one{7.0};
  EXPECT_EQ(bootstrap(one, mean, 3).high, 7.0);
}

TEST(MedianRatio, TakesRatiosPairByPairSoThatCommonDriftCancels) {
  std::vector<double> a, b;
  for (double drift : {1.0, 3.0, 0.5, 7.0, 2.0}) a.push_back(3.0 * drift), b.push_back(2.0 * drift);
  const Interval r = median_ratio(a, b, 1);
  EXPECT_DOUBLE_EQ(r.value, 1.5);
  EXPECT_DOUBLE_EQ(r.low, 1.5);
  EXPECT_DOUBLE_EQ(r.high, 1.5);
}

TEST(MedianRatio, IntervalsCoverTheTrueRatioAboutAsOftenAsTheySay) {
  constexpr int kTrials = 600, kPairs = 15;
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> a, b;
    for (uint32_t i = 0; i < kPairs; ++i) {
      a.push_back(
          std::exp(0.2 * (random_unit(static_cast<uint64_t>(trial), i, 0, 9) - 0.5)));  // median ratio 1
      b.push_back(1.0);
    }
    const Interval r = median_ratio(a, b, static_cast<uint64_t>(trial), 400);
    EXPECT_LE(r.low, r.value);
    EXPECT_LE(r.value, r.high);
    covered += r.low <= 1.0 && 1.0 <= r.high;
  }
  // 95 % asked for; the percentile bootstrap of a median of 15 is known to be near 93-97 %. Binomial standard
  // error 0.9 %.
  EXPECT_GT(covered, kTrials * 0.90);
  EXPECT_LT(covered, kTrials * 0.995);
}

TEST(MedianRatio, IsDeterministicForASeed) {
  const std::vector<double> a{1, 2, 3, 4, 5}, b{2, 1, 2, 3, 1};
  EXPECT_EQ(median_ratio(a, b, 5).low, median_ratio(a, b, 5).low);
}

}  // namespace
}  // namespace hybray::metrics
