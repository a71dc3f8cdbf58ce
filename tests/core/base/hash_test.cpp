#include "core/base/hash.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Hash, MatchesThePublishedValueOfTheEmptyInput) {
  EXPECT_EQ(hash_bytes(nullptr, 0), 0x2D06800538D394C2ull);  // XXH3_64bits of no bytes, xxHash specification
}

TEST(Hash, ChainsBySeed) {
  EXPECT_NE(hash_text("b", hash_text("a")), hash_text("a", hash_text("b")));
  EXPECT_EQ(hex(0xabcull), "0000000000000abc");
}

TEST(RandomUnit, IsUniformByTheChiSquareTestInEachDimension) {
  for (uint32_t dimension : {0u, 1u, 17u}) {
    constexpr int kBins = 100, kSamples = 100000;
    std::array<int, kBins> bins{};
    for (int i = 0; i < kSamples; ++i) {
      const double u = random_unit(static_cast<uint64_t>(i), dimension, 0, 42);
      ASSERT_GE(u, 0.0);
      ASSERT_LT(u, 1.0);
      ++bins[static_cast<size_t>(u * kBins)];
    }
    double chi = 0.0;
    for (int n : bins) chi += (n - 1000.0) * (n - 1000.0) / 1000.0;
    EXPECT_GT(chi, 50.5) << "too even: 99 degrees of freedom, p = 0.00001";
    EXPECT_LT(chi, 171.7) << "too uneven: 99 degrees of freedom, p = 0.99999";
  }
}

TEST(RandomUnit, NeighbouringCountersAreUncorrelated) {
  constexpr int kSamples = 200000;
  double item = 0.0, dimension = 0.0, sample = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const auto u = [](uint64_t a, uint32_t d, uint32_t s) { return random_unit(a, d, s, 7) - 0.5; };
    const auto n = static_cast<uint64_t>(i);
    item += u(n, 0, 0) * u(n + 1, 0, 0);
    dimension += u(n, 0, 0) * u(n, 1, 0);
    sample += u(n, 0, 0) * u(n, 0, 1);
  }
  // A product of two independent centred uniforms has standard deviation 1/12.
  const double five_sigma = 5.0 / 12.0 / std::sqrt(static_cast<double>(kSamples));
  for (double sum : {item, dimension, sample}) EXPECT_LT(std::abs(sum / kSamples), five_sigma);
}

}  // namespace
}  // namespace hybray
