#include "core/ssrm/screen_rays.h"

#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr uint64_t kSeed = 4711;
const Bounds3 kBounds{vec3(-10), vec3(10)};

class ScreenRaysInBoth : public testing::TestWithParam<DepthConvention> {};

TEST_P(ScreenRaysInBoth, RunThroughTheProjectionsOfThePointsOfTheWorldRay) {
  const View view(Camera{"c", vec3(1, 2, 9), vec3(0)},
                  {.width = 800, .height = 600, .convention = GetParam()}, kBounds);
  RayStream rays;
  constexpr size_t kRays = 3000;
  rays.resize(kRays);
  for (size_t i = 0; i < kRays; ++i) {
    const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 0, kSeed) - 1.0; };
    const dvec3 o =
        view.eye() + (5.0 + 4.0 * unit(0)) * view.ray_direction(400 + 399 * unit(1), 300 + 299 * unit(2));
    rays.set(i, vec3(o), glm::normalize(vec3(dvec3(unit(3), unit(4), unit(5)))), 0);
  }
  const ScreenRays screen = project_rays(rays, view, kBounds);
  for (size_t i = 0; i < kRays; ++i) {
    const ScreenRay<double> ray = screen.get<double>(i);
    for (double share : {0.1, 0.5, 0.9}) {
      const double l = share * ray.l_end, t = distance_of(rays, i, view, l);
      const dvec3 p = dvec3(rays.origin(i)) + t * dvec3(rays.direction(i));
      const double w = view.view_depth(p);
      ASSERT_GT(w, 0.0);
      const dvec2 pixel = view.project(p);
      // Float rounding of origin and direction, each relative 2^-24, moves the point by that share of the way
      // it has come on the screen.
      const double pixels =
          4 * 0x1p-24 * (std::abs(ray.ox) + std::abs(l * ray.dx) + std::abs(ray.oy) + std::abs(l * ray.dy));
      EXPECT_NEAR(ray.ox + l * ray.dx, pixel.x, pixels) << "seed " << kSeed << " ray " << i;
      EXPECT_NEAR(ray.oy + l * ray.dy, pixel.y, pixels);
      EXPECT_NEAR(ray.oz + ray.rise(l), view.depth_sign() * view.device_depth(w),
                  4 * 0x1p-24 * (std::abs(ray.oz) + std::abs(l * ray.dz)));
    }
  }
}

TEST_P(ScreenRaysInBoth, EndAtTheFirstOfNearPlaneFarPlaneAndBounds) {
  const View view(Camera{"c", vec3(0, 0, 5), vec3(0)},
                  {.width = 100, .height = 100, .near = 1.0, .far = 30.0, .convention = GetParam()}, kBounds);
  RayStream rays;
  rays.resize(4);
  rays.set(0, vec3(0), vec3(0, 0, 1), 0);   // toward the viewer: near plane at z = 4
  rays.set(1, vec3(0), vec3(1, 0, 0), 0);   // sideways: bounds at x = 10 plus the margin
  rays.set(2, vec3(0), vec3(0, 0, -1), 0);  // away: bounds at z = -10 minus the margin
  rays.set(3, vec3(0, 0, -6), glm::normalize(vec3(0.1f, 0.1f, 1)), 0);
  const double margin = kBoundsMargin * kBounds.diagonal();
  const ScreenRays screen = project_rays(rays, view, kBounds);
  EXPECT_EQ(screen.end[0], Verdict::viewer);
  EXPECT_NEAR(distance_of(rays, 0, view, screen.l_end[0]), 4.0, 1e-5);
  EXPECT_EQ(screen.end[1], Verdict::miss);
  EXPECT_NEAR(distance_of(rays, 1, view, screen.l_end[1]), 10.0 + margin, 1e-5);
  EXPECT_EQ(screen.end[2], Verdict::miss);
  EXPECT_NEAR(distance_of(rays, 2, view, screen.l_end[2]), 10.0 + margin, 1e-5);
  EXPECT_EQ(screen.end[3], Verdict::viewer);
  EXPECT_NEAR(distance_of(rays, 3, view, screen.l_end[3]) * rays.dz[3], 10.0, 1e-4);

  const View shallow(Camera{"c", vec3(0, 0, 5), vec3(0)},
                     {.width = 100, .height = 100, .near = 1.0, .far = 8.0, .convention = GetParam()},
                     kBounds);
  const ScreenRays cut = project_rays(rays, shallow, kBounds);
  EXPECT_EQ(cut.end[2], Verdict::offscreen)
      << "the far plane cuts the scene: the view volume ends, not the scene";
  EXPECT_NEAR(distance_of(rays, 2, shallow, cut.l_end[2]), 3.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Depth, ScreenRaysInBoth,
                         testing::Values(DepthConvention::standard, DepthConvention::reversed));

TEST(ScreenRays, NeverHaveAZeroDirectionComponent) {
  const View view(Camera{"c", vec3(0, 0, 5), vec3(0)}, {.width = 101, .height = 101}, kBounds);
  RayStream rays;
  rays.resize(2);
  rays.set(0, vec3(0), vec3(0, 0, -1), 0);  // along the view axis, through the centre of the screen
  rays.set(1, vec3(0), vec3(1, 0, 0), 0);
  const ScreenRays screen = project_rays(rays, view, kBounds);
  for (size_t i : {0u, 1u}) {
    EXPECT_GE(std::abs(screen.dx[i]), 0x1p-126f);
    EXPECT_GE(std::abs(screen.dy[i]), 0x1p-126f);
  }
}

}  // namespace
}  // namespace hybray::ssrm
