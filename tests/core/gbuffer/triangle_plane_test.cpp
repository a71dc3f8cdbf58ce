#include "core/gbuffer/triangle_plane.h"

#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(TrianglePlane, GivesTheDepthAndSlopesOfTheIntersectionOfPixelRaysWithThePlane) {
  constexpr uint64_t kSeed = 77;
  const Scene scene = test::triangle_soup(200, 2.0f, 3.0f, kSeed);
  const View view(Camera{"c", vec3(0, 0, 12), vec3(0)}, {.width = 400, .height = 300}, scene.bounds);
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    // Where the ray of a screen point meets the triangle's plane, by the intersection test with unlimited
    // slack.
    const auto inverse_w = [&](double x, double y) {
      const auto w = test::exact_hit(scene, t, view.eye(), view.ray_direction(x, y), 1e30);
      return w ? 1.0 / *w : -1.0;
    };
    const double x = 400 * random_unit(t, 50, 0, kSeed), y = 300 * random_unit(t, 51, 0, kSeed);
    if (inverse_w(x, y) <= 0.0 || inverse_w(x + 1, y) <= 0.0 || inverse_w(x, y + 1) <= 0.0) continue;
    const TrianglePlane plane = triangle_plane(view, scene, t, x, y);
    const double scale = std::abs(plane.inverse_w) + std::abs(plane.slope_x) + std::abs(plane.slope_y);
    EXPECT_NEAR(plane.inverse_w, inverse_w(x, y), 1e-12 * scale);
    EXPECT_NEAR(plane.inverse_w + plane.slope_x, inverse_w(x + 1, y), 1e-11 * scale);
    EXPECT_NEAR(plane.inverse_w + plane.slope_y, inverse_w(x, y + 1), 1e-11 * scale);
  }
}

}  // namespace
}  // namespace hybray
