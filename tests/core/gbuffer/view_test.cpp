#include "core/gbuffer/view.h"

#include "core/base/error.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

const Camera kCamera{"test", vec3(1, 2, 3), vec3(4, 1, -6), vec3(0, 1, 0), 50.0f};
const Bounds3 kBounds{vec3(-10), vec3(10)};

View make(DepthConvention convention, double near = 0.1, double far = 100.0) {
  return View(kCamera, {.width = 640, .height = 360, .near = near, .far = far, .convention = convention},
              kBounds);
}

TEST(View, MapsNearAndFarToTheEndsOfTheDepthRange) {
  const View standard = make(DepthConvention::standard), reversed = make(DepthConvention::reversed);
  EXPECT_NEAR(standard.device_depth(0.1), 0.0, 1e-15);
  EXPECT_NEAR(standard.device_depth(100.0), 1.0, 1e-15);
  EXPECT_NEAR(reversed.device_depth(0.1), 1.0, 1e-15);
  EXPECT_NEAR(reversed.device_depth(100.0), 0.0, 1e-15);
  for (double w : {0.1, 0.5, 3.0, 99.0}) {
    EXPECT_NEAR(standard.view_depth_of(standard.device_depth(w)), w, 1e-9 * w * w);
    EXPECT_NEAR(reversed.view_depth_of(reversed.device_depth(w)), w, 1e-12 * w * w);
    EXPECT_NEAR(standard.device_depth(w) + reversed.device_depth(w), 1.0, 1e-14);
  }
}

TEST(View, AnInfiniteFarPlaneLeavesDepthFinite) {
  const View reversed = make(DepthConvention::reversed, 0.1, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(reversed.device_depth(0.1), 1.0);
  EXPECT_DOUBLE_EQ(reversed.device_depth(1e6), 1e-7);
}

TEST(View, ProjectsThePointsOfItsOwnRays) {
  const View view = make(DepthConvention::reversed);
  for (double x : {0.0, 17.25, 639.5})
    for (double y : {0.5, 200.0, 360.0}) {
      const dvec3 p = view.eye() + 7.5 * view.ray_direction(x, y);
      EXPECT_NEAR(view.project(p).x, x, 1e-10);
      EXPECT_NEAR(view.project(p).y, y, 1e-10);
      EXPECT_NEAR(view.view_depth(p), 7.5, 1e-12);
    }
}

TEST(View, JitterMovesThePictureOnTheScreenAndNothingElse) {
  const View still = make(DepthConvention::reversed);
  const View moved(kCamera, {.width = 640, .height = 360, .far = 100.0, .jitter = {0.25, -0.5}}, kBounds);
  const dvec3 p(2, 1, -4);
  EXPECT_NEAR(glm::distance(moved.project(p), still.project(p) + dvec2(0.25, -0.5)), 0.0, 1e-10);
  EXPECT_EQ(moved.ray_direction(100.25, 49.5), still.ray_direction(100.0, 50.0));
  EXPECT_EQ(moved.view_depth(p), still.view_depth(p));
  EXPECT_EQ(moved.with_margin(8, 16).ray_direction(108.25, 65.5), still.ray_direction(100.0, 50.0));
}

TEST(View, LooksAlongItsAxisWithUpAboveAndTheAskedForAngle) {
  const View view = make(DepthConvention::reversed);
  const dvec2 target = view.project(dvec3(kCamera.target));
  EXPECT_NEAR(target.x, 320.0, 1e-9);
  EXPECT_NEAR(target.y, 180.0, 1e-9);
  EXPECT_LT(view.project(dvec3(kCamera.target) + dvec3(0, 1, 0)).y, 180.0) << "up is toward smaller y";
  const dvec3 top = glm::normalize(view.ray_direction(320.0, 0.0));
  EXPECT_NEAR(glm::dot(top, view.forward()), std::cos(25.0 * 3.14159265358979 / 180.0), 1e-9);
  EXPECT_GT(glm::dot(glm::cross(view.right(), -view.down()), -view.forward()), 0.99) << "right-handed";
}

TEST(View, TheAutomaticFarPlaneLiesBeyondEveryCornerOfTheScene) {
  const View view(kCamera, {.width = 64, .height = 64}, kBounds);
  for (float x : {-10.0f, 10.0f})
    for (float y : {-10.0f, 10.0f})
      for (float z : {-10.0f, 10.0f}) EXPECT_GT(view.far(), view.view_depth(dvec3(x, y, z)));
}

TEST(View, RefusesWhatHasNoMeaning) {
  const auto view = [](Camera camera, int w, int h, double near, double far) {
    return View(camera, {.width = w, .height = h, .near = near, .far = far}, kBounds);
  };
  EXPECT_THROW(view(kCamera, 0, 10, 0.1, 0), InputError);
  EXPECT_THROW(view(kCamera, 10, 10, 0.0, 0), InputError);
  EXPECT_THROW(view(kCamera, 10, 10, std::nan(""), 0), InputError);
  EXPECT_THROW(view(kCamera, 10, 10, 5.0, 4.0), InputError);
  EXPECT_THROW(view({"eye", vec3(0), vec3(0)}, 10, 10, 0.1, 0), InputError);
  EXPECT_THROW(view({"up", vec3(0), vec3(0, 1, 0)}, 10, 10, 0.1, 0), InputError);
  EXPECT_THROW(view({"fov", vec3(0), vec3(0, 0, -1), vec3(0, 1, 0), 180.0f}, 10, 10, 0.1, 0), InputError);
}

}  // namespace
}  // namespace hybray
