#include "core/metrics/paired_tests.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "tests/core/metrics/random_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

// Hamilton depression scale of nine patients at two visits (Hollander and Wolfe 1973, p. 29), R's example of
// wilcox.test.
const std::vector<double> kFirst{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30},
    kSecond{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};

TEST(PairedT, GivesTheStatisticAndProbabilityOfScipy) {
  const TestResult result = paired_t(kFirst, kSecond);  // scipy 1.17.1: ttest_rel
  EXPECT_NEAR(result.statistic, 3.0353754156485917, 1e-12);
  EXPECT_NEAR(result.p, 0.016176627434908088, 1e-12);
  EXPECT_DOUBLE_EQ(paired_t(kSecond, kFirst).statistic, -result.statistic);
  EXPECT_DOUBLE_EQ(paired_t(kSecond, kFirst).p, result.p);
}

TEST(PairedT, OfDifferencesWithoutSpreadIsCertain) {
  const std::vector<double> a{1.0, 2.0, 4.0}, above{2.0, 3.0, 5.0};
  EXPECT_EQ(paired_t(a, a).p, 1.0);
  EXPECT_EQ(paired_t(a, a).statistic, 0.0);
  EXPECT_EQ(paired_t(a, above).p, 0.0);
  EXPECT_EQ(paired_t(a, above).statistic, -std::numeric_limits<double>::infinity());
}

TEST(WilcoxonSignedRank, GivesTheStatisticAndProbabilityOfR) {
  const TestResult result = wilcoxon_signed_rank(kFirst, kSecond);  // V = 40, p-value = 0.03906: 20 of 512
  EXPECT_EQ(result.statistic, 40.0);
  EXPECT_DOUBLE_EQ(result.p, 20.0 / 512.0);
  EXPECT_EQ(wilcoxon_signed_rank(kSecond, kFirst).statistic, 5.0);
  EXPECT_DOUBLE_EQ(wilcoxon_signed_rank(kSecond, kFirst).p, result.p);
}

TEST(WilcoxonSignedRank, CountsTheSignsThatAreAsFarOutAlsoWhereRanksAreTiedOrNothingDiffers) {
  // All 2^n choices of signs, which chance alone makes equally often.
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<double> a, b;
    for (uint64_t i = 0; i < 11; ++i) {
      a.push_back(static_cast<double>(random_bits(i, 0, 0, seed) % 7));
      b.push_back(static_cast<double>(random_bits(i, 1, 0, seed) % 7));
    }
    std::vector<double> apart;
    for (size_t i = 0; i < a.size(); ++i)
      if (a[i] != b[i]) apart.push_back(a[i] - b[i]);
    std::vector<double> ranks;
    for (const double d : apart) {
      double below = 0.0, same = 0.0;
      for (const double other : apart)
        below += std::abs(other) < std::abs(d), same += std::abs(other) == std::abs(d);
      ranks.push_back(below + 0.5 * (same + 1.0));
    }
    double whole = 0.0, observed = 0.0;
    for (size_t i = 0; i < ranks.size(); ++i) whole += ranks[i], observed += apart[i] > 0.0 ? ranks[i] : 0.0;
    int far = 0;
    const int choices = 1 << ranks.size();
    for (int signs = 0; signs < choices; ++signs) {
      double sum = 0.0;
      for (size_t i = 0; i < ranks.size(); ++i) sum += signs >> i & 1 ? ranks[i] : 0.0;
      far += std::abs(sum - 0.5 * whole) >= std::abs(observed - 0.5 * whole);
    }
    const TestResult result = wilcoxon_signed_rank(a, b);
    EXPECT_EQ(result.statistic, observed) << seed;
    EXPECT_NEAR(result.p, static_cast<double>(far) / choices, 1e-12) << seed;
  }
}

TEST(WilcoxonSignedRank, OfManyPairsIsScipysNormalApproximation) {
  std::vector<double> a, b;
  for (int i = 0; i < 300; ++i) a.push_back(i * 37 % 101 / 8.0), b.push_back(i * 53 % 97 / 8.0);
  // scipy 1.17.1: wilcoxon(a, b, method="approx", correction=False); the statistic that of alternative
  // "greater".
  const TestResult result = wilcoxon_signed_rank(a, b);
  EXPECT_EQ(result.statistic, 23333.0);
  EXPECT_NEAR(result.p, 0.3578855880563915, 1e-12);
}

TEST(WilcoxonSignedRank, IsContinuousWhereTheNormalDistributionTakesOver) {
  // The largest exact number of pairs and one more: p of the same shift differs by no more than the error of
  // the approximation, about 1 / pairs of itself and more in the tail.
  const auto p_of = [](uint64_t pairs) {
    std::vector<double> a(pairs, 0.0), b;
    for (uint64_t i = 0; i < pairs; ++i) b.push_back((i % 2 == 0 ? 1.0 : -1.25) * static_cast<double>(i + 1));
    return wilcoxon_signed_rank(a, b).p;
  };
  EXPECT_NEAR(p_of(200), p_of(202), 0.02);
}

TEST(WilcoxonSignedRank, WithoutAnyDifferenceSaysNothing) {
  EXPECT_EQ(wilcoxon_signed_rank(kFirst, kFirst).p, 1.0);
  EXPECT_EQ(wilcoxon_signed_rank(std::vector<double>{1.0}, std::vector<double>{2.0}).p, 1.0);
}

TEST(PairedTests, FindADifferenceByChanceAsOftenAsTheySay) {
  constexpr int kTrials = 4000, kPairs = 12;
  int by_t = 0, by_ranks = 0;
  for (uint64_t trial = 0; trial < kTrials; ++trial) {
    std::vector<double> a, b;
    for (uint32_t i = 0; i < kPairs; ++i) {
      a.push_back(test::random_normal(trial, 2 * i, 23));
      b.push_back(test::random_normal(trial, 2 * i + 1, 23));
    }
    by_t += paired_t(a, b).p < 0.05;
    by_ranks += wilcoxon_signed_rank(a, b).p < 0.05;
  }
  // t is exact; of 12 ranks' 4096 choices, those with p < 0.05 are 172: 4.2 %.
  EXPECT_NEAR(by_t, kTrials * 0.05, 4.0 * std::sqrt(kTrials * 0.05 * 0.95));
  EXPECT_NEAR(by_ranks, kTrials * 172.0 / 4096.0, 4.0 * std::sqrt(kTrials * 0.042 * 0.958));
}

TEST(PairedTests, RefuseWhatIsNotPaired) {
  const std::vector<double> two{1.0, 2.0}, one{1.0}, none, bad{1.0, std::nan("")},
      endless{1.0, std::numeric_limits<double>::infinity()};
  for (const auto test : {paired_t, wilcoxon_signed_rank}) {
    EXPECT_THROW(test(two, one), InputError);
    EXPECT_THROW(test(none, none), InputError);
    EXPECT_THROW(test(two, bad), InputError);
    EXPECT_THROW(test(endless, two), InputError);
  }
  EXPECT_THROW(paired_t(one, one), InputError);
}

}  // namespace
}  // namespace hybray::metrics
