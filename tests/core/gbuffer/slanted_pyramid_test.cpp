#include "core/gbuffer/slanted_pyramid.h"

#include "core/base/hash.h"
#include "core/base/lanes.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 11;

struct Size {
  int width, height;
};
void PrintTo(const Size& size, std::ostream* out) {
  *out << size.width << "x" << size.height;
}

struct Buffers {
  Image2D<float> depth;
  Image2D<vec2> derivatives;
  float background;
};

// Pixels on random planes, some of them background.
Buffers random_buffers(int width, int height, int sign) {
  Buffers b{Image2D<float>(width, height), Image2D<vec2>(width, height), sign > 0 ? 1.0f : 0.0f};
  const auto random = [](size_t i, uint32_t dimension) {
    return static_cast<float>(random_unit(i, dimension, 0, kSeed));
  };
  for (size_t i = 0; i < b.depth.size(); ++i) {
    const bool none = random(i, 0) < 0.15f;
    b.depth[i] = none ? b.background : 0.01f + 0.9f * random(i, 1);
    const float steep = std::exp2(-20.0f * random(i, 2));
    b.derivatives[i] = none ? vec2(0.0f) : steep * vec2(random(i, 3) - 0.5f, random(i, 4) - 0.5f);
  }
  return b;
}

// Texel's bound at a point of the screen.
double bound_at(const SlantedPyramid& pyramid, int level, int x, int y, double px, double py) {
  const SlantedTexel t = pyramid.at(level, x, y);
  const double side = 1 << level;
  return t.depth + double(t.slope_x()) * (px - (x + 0.5) * side) +
         double(t.slope_y()) * (py - (y + 0.5) * side);
}

class SlantedPyramidSizes : public testing::TestWithParam<Size> {};

TEST_P(SlantedPyramidSizes, NoBoundLiesBehindThePlaneOfAPixelUnderIt) {
  const auto [w, h] = GetParam();
  for (const int sign : {1, -1})
    for (const auto bounds : {SlantedPyramid::Bounds::slanted, SlantedPyramid::Bounds::flat}) {
      const Buffers b = random_buffers(w, h, sign);
      SlantedPyramid pyramid(w, h);
      pyramid.build(b.depth, b.derivatives, sign, b.background, bounds);
      for (int level = 0; level < pyramid.levels(); ++level) {
        Image2D<uint8_t> any(pyramid.width(level), pyramid.height(level), 0);
        for (int y = 0; y < h; ++y)
          for (int x = 0; x < w; ++x) {
            if (b.depth(x, y) == b.background) continue;
            const int tx = x >> level, ty = y >> level;
            any(tx, ty) = 1;
            for (const double ex : {0.0, 1.0})
              for (const double ey : {0.0, 1.0}) {
                const double plane = sign * (double(b.depth(x, y)) + (ex - 0.5) * b.derivatives(x, y).x +
                                             (ey - 0.5) * b.derivatives(x, y).y);
                ASSERT_LE(bound_at(pyramid, level, tx, ty, x + ex, y + ey), plane)
                    << level << " pixel " << x << " " << y << " seed " << kSeed;
              }
          }
        for (int y = 0; y < any.height(); ++y)
          for (int x = 0; x < any.width(); ++x) {
            ASSERT_EQ(std::isinf(pyramid.at(level, x, y).depth), any(x, y) == 0);
            if (bounds == SlantedPyramid::Bounds::flat) {
              ASSERT_EQ(pyramid.at(level, x, y).slopes, 0u);
            }
          }
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, SlantedPyramidSizes,
                         testing::Values(Size{1, 1}, Size{64, 1}, Size{1, 37}, Size{2, 2}, Size{3, 5},
                                         Size{33, 31}, Size{127, 65}, Size{320, 180}),
                         testing::PrintToStringParamName());

// One plane all over the screen: bounds lose only what rounding the slopes to 8 significant bits and the
// slack take. Slopes are off by at most 2^-9 of themselves, which is lost over half a texel along each axis,
// once when a level rounds and once when the level below differs from it; the slack adds the shares named in
// the source.
TEST(SlantedPyramid, FollowsAPlaneAtEveryLevel) {
  constexpr int kWidth = 300, kHeight = 200;
  const dvec2 slope(-3e-4, 5e-4);
  Image2D<float> depth(kWidth, kHeight);
  Image2D<vec2> derivatives(kWidth, kHeight, vec2(slope));
  const auto plane = [&](double x, double y) { return 0.5 + slope.x * (x - 150) + slope.y * (y - 100); };
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) depth(x, y) = static_cast<float>(plane(x + 0.5, y + 0.5));
  SlantedPyramid pyramid(kWidth, kHeight);
  pyramid.build(depth, derivatives, 1, 1.0f);
  const double steepness = std::abs(slope.x) + std::abs(slope.y);
  double allowed = 0x1p-24;  // of the depth buffer itself
  for (int level = 0; level < pyramid.levels(); ++level) {
    const double side = 1 << level;
    allowed += 0x1p-9 * steepness * side + 0x1p-21 + 0x1p-20 * steepness * (side + kWidth);
    for (int y = 0; y < pyramid.height(level); ++y)
      for (int x = 0; x < pyramid.width(level); ++x)
        ASSERT_NEAR(bound_at(pyramid, level, x, y, (x + 0.5) * side, (y + 0.5) * side),
                    plane((x + 0.5) * side, (y + 0.5) * side), allowed)
            << level;
  }
}

TEST(SlantedPyramid, IsTheSameOnEveryInstructionSet) {
  constexpr int kWidth = 333, kHeight = 217;
  const Buffers b = random_buffers(kWidth, kHeight, -1);
  std::vector<SlantedTexel> first;
  for (const std::string& target : lanes_targets()) {
    use_lanes_target(target);
    SlantedPyramid pyramid(kWidth, kHeight);
    pyramid.build(b.depth, b.derivatives, -1, b.background);
    const size_t count = pyramid.memory_bytes() / sizeof(SlantedTexel);
    if (first.empty()) first.assign(pyramid.texels(), pyramid.texels() + count);
    EXPECT_EQ(std::memcmp(first.data(), pyramid.texels(), pyramid.memory_bytes()), 0) << target;
  }
  use_lanes_target("");
  EXPECT_FALSE(first.empty());
}

}  // namespace
}  // namespace hybray
