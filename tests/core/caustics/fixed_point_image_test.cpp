// Sums that do not depend on their order, and what does not fit.
#include "core/caustics/fixed_point_image.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

namespace hybray::caustics {
namespace {

constexpr uint64_t kSeed = 99;
constexpr size_t kAdditions = 200000;

// Values over fifteen orders of magnitude on 4 x 3 pixels.
struct Addition {
  size_t pixel;
  dvec3 value;
};
std::vector<Addition> additions() {
  std::vector<Addition> list(kAdditions);
  for (size_t i = 0; i < kAdditions; ++i) {
    list[i].pixel = random_bits(i, 0, 0, kSeed) % 12;
    for (uint32_t c = 0; c < 3; ++c)
      list[i].value[static_cast<int>(c)] = std::pow(10.0, -12.0 + 15.0 * random_unit(i, 1 + c, 0, kSeed));
  }
  return list;
}

bool equal(const FixedPointImage& a, const FixedPointImage& b) {
  const Image2D<vec3> x = a.image(), y = b.image();
  return std::equal(x.begin(), x.end(), y.begin(), y.end()) && a.peak_fraction() == b.peak_fraction();
}

TEST(FixedPointImage, IsTheSameInAnyOrderAndOnAnyNumberOfThreads) {
  const std::vector<Addition> list = additions();
  FixedPointImage forward(4, 3, 1e9), backward(4, 3, 1e9);
  for (size_t i = 0; i < kAdditions; ++i) forward.add(list[i].pixel, list[i].value);
  for (size_t i = kAdditions; i-- > 0;) backward.add(list[i].pixel, list[i].value);
  EXPECT_TRUE(equal(forward, backward));
  for (int run = 0; run < 5; ++run) {
    FixedPointImage parallel(4, 3, 1e9);
    parallel_blocks(kAdditions, 64, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) parallel.add(list[i].pixel, list[i].value);
    });
    EXPECT_TRUE(equal(forward, parallel));
    EXPECT_EQ(parallel.overflows(), 0u);
  }
}

TEST(FixedPointImage, ManyThreadsOnOnePixelLoseNothing) {
  // Long enough that threads do meet even where cores are few and busy.
  constexpr int kEach = 2000000;
  FixedPointImage image(1, 1, 4.0 * kEach);
  std::atomic<int> waiting{4};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (--waiting; waiting > 0;) std::this_thread::yield();
      for (int i = 0; i < kEach; ++i) image.add(0, dvec3(1.0, 0.5, 0.25));
    });
  for (std::thread& thread : threads) thread.join();
  // All numbers are whole multiples of the unit but for its own rounding.
  EXPECT_FLOAT_EQ(image.image()(0, 0).x, 8e6f);
  EXPECT_FLOAT_EQ(image.image()(0, 0).y, 4e6f);
  EXPECT_FLOAT_EQ(image.image(3.0)(0, 0).z, 6e6f);
}

TEST(FixedPointImage, SumsAreRightToTheRoundingOfEachAddition) {
  const std::vector<Addition> list = additions();
  constexpr double kLargest = 1e9;
  FixedPointImage image(4, 3, kLargest);
  std::vector<long double> truth(36, 0.0L);
  for (const Addition& a : list) {
    image.add(a.pixel, a.value);
    for (size_t c = 0; c < 3; ++c)
      truth[3 * a.pixel + c] += static_cast<long double>(a.value[static_cast<int>(c)]);
  }
  const Image2D<vec3> sums = image.image();
  for (size_t i = 0; i < 12; ++i)
    for (size_t c = 0; c < 3; ++c) {
      const auto expected = static_cast<double>(truth[3 * i + c]);
      // Half a unit of 2^-61 an addition, and the float of the result.
      const double tolerance = kLargest * 0x1p-62 * kAdditions + 0x1p-24 * expected;
      EXPECT_NEAR(static_cast<double>(sums[i][static_cast<int>(c)]), expected, 1.01 * tolerance);
    }
}

TEST(FixedPointImage, ResolvesAPartIn2To61OfTheLargestSum) {
  FixedPointImage image(2, 1, 1.0);
  image.add(0, dvec3(0x1p-61, 0x1.8p-61, 0x1p-63));
  EXPECT_EQ(image.image()(0, 0), vec3(0x1p-61f, 0x1p-60f, 0.0f));  // to the nearest, half up
  EXPECT_EQ(image.image()(1, 0), vec3(0.0f));
  EXPECT_EQ(image.overflows(), 0u);
}

TEST(FixedPointImage, HoldsTwiceTheLargestSumAndSaysHowFullItIs) {
  FixedPointImage image(2, 2, 8.0);
  EXPECT_EQ(image.peak_fraction(), 0.0);
  image.add(3, dvec3(1.0, 8.0, 4.0));
  EXPECT_EQ(image.peak_fraction(), 0.5);
  image.add(3, dvec3(0.0, 8.0, 0.0));
  EXPECT_EQ(image.peak_fraction(), 1.0);
  EXPECT_EQ(image.overflows(), 0u);
  EXPECT_EQ(image.image()(1, 1), vec3(1.0f, 16.0f, 4.0f));
  EXPECT_EQ(FixedPointImage().peak_fraction(), 0.0);
  EXPECT_TRUE(FixedPointImage().empty());
}

TEST(FixedPointImage, CountsWhatIsNotARadianceAndLeavesTheSumsAlone) {
  FixedPointImage image(1, 1, 1.0);
  image.add(0, dvec3(0.5));
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  uint64_t expected = 0;
  for (const double bad : {nan, infinity, -infinity, -1e-9, 2.0, 1e300}) {
    image.add(0, dvec3(bad, 0.0, bad));
    expected += 2;
    EXPECT_EQ(image.overflows(), expected) << bad;
  }
  EXPECT_EQ(image.image()(0, 0), vec3(0.5f));
}

TEST(FixedPointImage, CountsSumsThatDoNotFitInsteadOfWrapping) {
  FixedPointImage image(1, 1, 1.0);
  for (int i = 0; i < 50; ++i) {
    image.add(0, dvec3(1.5));
    ASSERT_EQ(image.overflows(), 3u * static_cast<uint64_t>(i)) << "1.5 of 2 fit once";
    ASSERT_GT(image.image()(0, 0).x, 0.0f);
    ASSERT_LE(image.peak_fraction(), 1.0);
  }
  // From many threads at once as well.
  FixedPointImage shared(1, 1, 1.0);
  parallel_blocks(10000, 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) shared.add(0, dvec3(0.75));
  });
  EXPECT_EQ(shared.overflows(), 3u * 9998u);
  EXPECT_EQ(shared.image()(0, 0), vec3(1.5f));
}

}  // namespace
}  // namespace hybray::caustics
