#include "core/metrics/flip_kernels.h"

#include "core/base/error.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

namespace hybray::metrics {
namespace {

double sum(const Kernel& kernel) {
  return std::accumulate(kernel.begin(), kernel.end(), 0.0);
}

// Weights are floats: each is right to 2^-24 of itself, and so is a sum of weights of one sign.
constexpr double kRounding = 0x1p-23;

TEST(FlipKernels, OfAConstantImageGiveItBack) {
  for (const double ppd : {1.0, 25.0, 67.0, 200.0}) {
    const FlipKernels k = flip_kernels(ppd);
    EXPECT_NEAR(sum(k.achromatic), 1.0, kRounding) << ppd;
    EXPECT_NEAR(sum(k.red_green), 1.0, kRounding) << ppd;
    EXPECT_NEAR(std::pow(sum(k.blue_yellow[0]), 2.0) + std::pow(sum(k.blue_yellow[1]), 2.0), 1.0,
                2.0 * kRounding)
        << ppd;
    EXPECT_NEAR(sum(k.smooth), 1.0, kRounding) << ppd;
    EXPECT_NEAR(sum(k.edge), 0.0, kRounding) << ppd;
    EXPECT_NEAR(sum(k.point), 0.0, kRounding) << ppd;
  }
}

TEST(FlipKernels, HaveTheRadiiAndTheFallOffOfThePaper) {
  const FlipKernels k = flip_kernels(67.0);
  // 3 sqrt(0.04 / (2 pi^2)) 67 = 9.05 and 3 (0.082 / 2) 67 = 8.24, rounded up.
  EXPECT_EQ(k.achromatic.size(), 21u);
  EXPECT_EQ(k.blue_yellow[1].size(), 21u);
  EXPECT_EQ(k.smooth.size(), 19u);
  EXPECT_EQ(k.edge.size(), 19u);
  // exp(-pi^2 x^2 / b) at x = 3 pixels.
  const auto fall = [](const Kernel& kernel, double b) {
    const double x = 3.0 / 67.0, expected = std::exp(-std::numbers::pi * std::numbers::pi * x * x / b);
    EXPECT_NEAR(static_cast<double>(kernel[13]) / static_cast<double>(kernel[10]), expected,
                kRounding * expected);
    EXPECT_EQ(kernel[13], kernel[7]);
  };
  fall(k.achromatic, 0.0047);
  fall(k.red_green, 0.0053);
  fall(k.blue_yellow[0], 0.04);
  fall(k.blue_yellow[1], 0.025);
  // Heights of the two products: 34.1 sqrt(pi / 0.04) against 13.5 sqrt(pi / 0.025).
  const double ratio = static_cast<double>(k.blue_yellow[0][10]) / static_cast<double>(k.blue_yellow[1][10]);
  EXPECT_NEAR(ratio * ratio, 34.1 / 13.5 * std::sqrt(0.025 / 0.04), 4.0 * kRounding * ratio * ratio);
}

TEST(FlipKernels, OfDerivativesAreNormalizedOnEachSideOfZero) {
  for (const double ppd : {1.0, 67.0}) {
    const FlipKernels k = flip_kernels(ppd);
    for (const Kernel* kernel : {&k.edge, &k.point}) {
      double positive = 0.0, negative = 0.0;
      for (const float w : *kernel) (w > 0.0f ? positive : negative) += static_cast<double>(w);
      EXPECT_NEAR(positive, 1.0, kRounding) << ppd;
      EXPECT_NEAR(negative, -1.0, kRounding) << ppd;
    }
    for (size_t i = 0; i < k.edge.size(); ++i) {
      EXPECT_EQ(k.edge[i], -k.edge[k.edge.size() - 1 - i]);
      EXPECT_EQ(k.point[i], k.point[k.edge.size() - 1 - i]);
    }
    EXPECT_GT(k.edge.front(), 0.0f);
    EXPECT_LT(k.point[k.point.size() / 2], 0.0f);
  }
}

TEST(FlipKernels, RefuseADisplayThatNobodyCanLookAt) {
  for (const double bad : {0.0, 0.99, -67.0, 1000.1, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(flip_kernels(bad), InputError) << bad;
}

}  // namespace
}  // namespace hybray::metrics
