#include "core/gbuffer/guard_band.h"

#include "core/gbuffer/reflection_rays.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr unsigned kBits = kDepth | kDepthDerivatives | kPrimitive;

TEST(GuardBand, IsAtLeastTheFractionInWholeTiles) {
  EXPECT_EQ(guard_band(1920, 0.1), 192);
  EXPECT_EQ(guard_band(1080, 0.1), 112);
  EXPECT_EQ(guard_band(1, 0.25), 8);
  EXPECT_EQ(guard_band(333, 0.0), 0);
}

class GuardBandScenes : public testing::TestWithParam<const char*> {};

TEST_P(GuardBandScenes, BuffersOfTheLargerViewHoldThoseOfTheViewBitForBit) {
  const Scene scene = load_scene(test::scene_paths(), GetParam());
  const Tracer tracer(scene, {.robust = true});
  for (const ivec2& size : {ivec2(160, 90), ivec2(333, 217), ivec2(64, 1), ivec2(1, 1)}) {
    const View view(scene.cameras.front(), {.width = size.x, .height = size.y}, scene.bounds);
    const ivec2 margin(guard_band(size.x, 0.25), guard_band(size.y, 0.25));
    const GBuffer inner = make_gbuffer(tracer, view, kBits);
    const GBuffer whole = make_gbuffer(tracer, view.with_margin(margin.x, margin.y), kBits);
    const GBuffer banded = with_guard_band(tracer, inner, margin);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        ASSERT_EQ(whole.depth(x + margin.x, y + margin.y), inner.depth(x, y)) << x << "," << y;
        ASSERT_EQ(whole.primitive(x + margin.x, y + margin.y), inner.primitive(x, y)) << x << "," << y;
      }
    for (size_t p = 0; p < whole.depth.size(); ++p) {
      ASSERT_EQ(banded.depth[p], whole.depth[p]) << p;
      ASSERT_EQ(banded.primitive[p], whole.primitive[p]) << p;
      ASSERT_EQ(banded.depth_derivatives[p], whole.depth_derivatives[p]) << p;
    }
    EXPECT_EQ(banded.covered_pixels, whole.covered_pixels);
  }
}

INSTANTIATE_TEST_SUITE_P(Procedural, GuardBandScenes, testing::Values("sphere", "atrium", "street"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace hybray
