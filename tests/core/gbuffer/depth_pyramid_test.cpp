#include "core/gbuffer/depth_pyramid.h"

#include "core/base/hash.h"

#include <limits>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(DepthPyramid, HasThePapersNumberOfLevels) {
  EXPECT_EQ(DepthPyramid::level_count(1920, 1080), 11);
  EXPECT_EQ(DepthPyramid::level_count(3840, 2160), 12);
  EXPECT_EQ(DepthPyramid::level_count(64, 1), 1);
  EXPECT_EQ(DepthPyramid::level_count(1, 1), 1);
  EXPECT_EQ(DepthPyramid::level_count(1024, 1024), 11);
}

struct Size {
  int width, height;
};
void PrintTo(const Size& size, std::ostream* out) {
  *out << size.width << "x" << size.height;
}
class DepthPyramidSizes : public testing::TestWithParam<Size> {};

TEST_P(DepthPyramidSizes, EveryTexelHoldsTheNearestDepthOfThePixelsUnderIt) {
  const auto [w, h] = GetParam();
  constexpr uint64_t kSeed = 5;
  for (int sign : {1, -1}) {
    const float background = sign > 0 ? 1.0f : 0.0f;
    Image2D<float> depth(w, h);
    for (size_t i = 0; i < depth.size(); ++i)
      depth[i] =
          random_unit(i, 1, 0, kSeed) < 0.2 ? background : static_cast<float>(random_unit(i, 0, 0, kSeed));
    DepthPyramid pyramid(w, h);
    pyramid.build(depth, sign, background);
    ASSERT_EQ(pyramid.levels(), DepthPyramid::level_count(w, h));
    for (int level = 0; level < pyramid.levels(); ++level) {
      const int lw = (w + (1 << level) - 1) >> level, lh = (h + (1 << level) - 1) >> level;
      Image2D<float> nearest(lw, lh, std::numeric_limits<float>::infinity());
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
          if (depth(x, y) != background)
            nearest(x >> level, y >> level) =
                std::min(nearest(x >> level, y >> level), static_cast<float>(sign) * depth(x, y));
      ASSERT_EQ(pyramid.width(level), lw);
      ASSERT_EQ(pyramid.height(level), lh);
      for (int y = 0; y < lh; ++y)
        for (int x = 0; x < lw; ++x)
          ASSERT_EQ(pyramid.at(level, x, y), nearest(x, y)) << level << " " << x << " " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, DepthPyramidSizes,
                         testing::Values(Size{1, 1}, Size{64, 1}, Size{1, 37}, Size{2, 2}, Size{3, 5},
                                         Size{333, 217}, Size{1279, 719}, Size{640, 360}, Size{1031, 67}),
                         [](const auto& test) {
                           return std::to_string(test.param.width) + "x" + std::to_string(test.param.height);
                         });

TEST(DepthPyramid, KeepsAWallInTheLastColumnAndRowOfAnOddSize) {
  for (auto [w, h] : {Size{1919, 1079}, Size{45, 135}}) {
    Image2D<float> depth(w, h, 1.0f);
    for (int y = 0; y < h; ++y) depth(w - 1, y) = 0.25f;
    for (int x = 0; x < w; ++x) depth(x, h - 1) = 0.125f;
    DepthPyramid pyramid(w, h);
    pyramid.build(depth, 1, 1.0f);
    for (int l = 0; l < pyramid.levels(); ++l) {
      EXPECT_EQ(pyramid.at(l, (w - 1) >> l, 0),
                l == pyramid.levels() - 1 && (h - 1) >> l == 0 ? 0.125f : 0.25f)
          << l;
      EXPECT_EQ(pyramid.at(l, 0, (h - 1) >> l), 0.125f) << l;
    }
  }
}

}  // namespace
}  // namespace hybray
