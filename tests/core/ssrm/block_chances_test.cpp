#include "core/ssrm/block_chances.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

TEST(BlockChances, AreTheWeightedMeanOfABlockAndItsNeighbours) {
  BlockChances c;
  c.reset(36, 18);  // blocks: 5 x 3, the last ones cut
  c.spread();
  EXPECT_EQ(c.around(10.0f, 10.0f), BlockChances::kUnknown);
  c.add(8, 8, BlockChances::kWhole, 3);
  c.spread();
  EXPECT_FLOAT_EQ(c.around(15.9f, 15.9f), 1.0f);
  EXPECT_FLOAT_EQ(c.around(16.0f, 16.0f), 1.0f) << "diagonal neighbour";
  EXPECT_EQ(c.around(24.0f, 8.0f), BlockChances::kUnknown) << "two blocks away";
  c.add(23, 15, 0, 1);
  c.add(35, 17, 51, 2);
  c.spread();
  EXPECT_FLOAT_EQ(c.around(10.0f, 10.0f), 4.0f * 3.0f / (4.0f * 3.0f + 2.0f));
  EXPECT_FLOAT_EQ(c.around(16.0f, 16.0f), 3.0f / (3.0f + 2.0f));
  EXPECT_FLOAT_EQ(c.around(35.0f, 17.0f), 0.2f) << "the screen's corner, no neighbour";
  for (const auto& [x, y] : {std::pair(-0.1f, 10.0f), {36.0f, 10.0f}, {10.0f, 18.0f}, {10.0f, -1e-6f}})
    EXPECT_EQ(c.around(x, y), BlockChances::kUnknown);
  c.reset(36, 18);
  EXPECT_EQ(c.around(10.0f, 10.0f), BlockChances::kUnknown);
}

TEST(BlockChances, DoNotDependOnThreads) {
  const auto filled = [](int threads) {
    const ThreadLimit limit(threads);
    BlockChances c;
    c.reset(64, 64);
    parallel_blocks(100000, 100, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i)
        c.add(static_cast<int>(i % 61), static_cast<int>(i % 7), static_cast<uint32_t>(i % 256), 16);
    });
    c.spread();
    return c;
  };
  const BlockChances one = filled(1), many = filled(0);
  for (int x = 0; x < 64; ++x)
    EXPECT_EQ(one.around(static_cast<float>(x), 2.0f), many.around(static_cast<float>(x), 2.0f));
}

TEST(Reprojection, SendsAPointWhereTheOtherViewSeesIt) {
  const Bounds3 bounds{vec3(-10), vec3(10)};
  for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View from(Camera{"a", vec3(1, 2, 6), vec3(0)},
                    {.width = 320, .height = 180, .convention = convention}, bounds);
    const View to(Camera{"b", vec3(-2, 1, 5), vec3(0.5f, 0, -1)},
                  {.width = 200, .height = 150, .convention = convention, .jitter = dvec2(0.4, -7.0)},
                  bounds);
    const Reprojection map(from, to);
    for (uint64_t i = 0; i < 1000; ++i) {
      const auto coordinate = [&](uint32_t axis) { return 4.0 * random_unit(i, axis, 0, 9) - 2.0; };
      const dvec3 p(coordinate(0), coordinate(1), coordinate(2));
      const dvec2 at = from.project(p), expected = to.project(p);
      const vec2 found = map(static_cast<float>(at.x), static_cast<float>(at.y),
                             static_cast<float>(from.device_depth(from.view_depth(p))));
      // Some ten roundings of 2^-24 relative to sums of a few screens' size.
      EXPECT_NEAR(found.x, expected.x, 2e-3);
      EXPECT_NEAR(found.y, expected.y, 2e-3);
    }
    // Behind the other eye.
    const dvec3 behind = to.eye() - 2.0 * to.forward();
    const View back(Camera{"c", vec3(behind - 4.0 * to.forward()), vec3(behind)},
                    {.width = 320, .height = 180, .convention = convention}, bounds);
    const vec2 nowhere = Reprojection(back, to)(160.0f, 90.0f, static_cast<float>(back.device_depth(4.0)));
    EXPECT_FALSE(nowhere.x >= 0.0f && nowhere.x < 200.0f && nowhere.y >= 0.0f && nowhere.y < 150.0f);
  }
}

}  // namespace
}  // namespace hybray::ssrm
