#include "core/scene/placement.h"

#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Placement, LeavesASceneThatStaysWhereItIsAsItIs) {
  for (const char* name : {"sphere", "closed_ball_lens", "meadow", "sculptures"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    EXPECT_EQ(placed_scene(scene, {}).content_hash, scene.content_hash) << name;
  }
}

TEST(Placement, ByPowersOfTwoAndBackLosesNothing) {
  const Scene scene = load_scene(test::scene_paths(), "sphere");
  const Scene there = placed_scene(scene, {1024.0, dvec3(0)});
  EXPECT_NE(there.content_hash, scene.content_hash);
  for (size_t i = 0; i < scene.positions.size(); ++i)
    EXPECT_EQ(there.positions[i], 1024.0f * scene.positions[i]);
  EXPECT_EQ(there.bounds.lower, 1024.0f * scene.bounds.lower);
  EXPECT_EQ(there.cameras[0].eye, 1024.0f * scene.cameras[0].eye);
  EXPECT_EQ(placed_scene(there, {1.0 / 1024.0, dvec3(0)}).content_hash, scene.content_hash);
}

TEST(Placement, MovesAnalyticSurfacesInDouble) {
  const Scene scene = load_scene(test::scene_paths(), "closed_cylinder");
  const Placement placement{3.0, dvec3(1e7, -2e7, 5e6)};
  const Scene there = placed_scene(scene, placement);
  const AnalyticSurface &was = scene.analytic[0], &is = there.analytic[0];
  EXPECT_EQ(is.center, placement(was.center));
  EXPECT_EQ(is.radius, 3.0 * was.radius);
  EXPECT_EQ(is.y0, 3.0 * was.y0 - 2e7);
  EXPECT_EQ(is.y1, 3.0 * was.y1 - 2e7);
  EXPECT_GE(there.bounds.upper.y, static_cast<float>(is.y1));
  EXPECT_EQ(there.triangle_count(), scene.triangle_count());
}

TEST(Placement, ScalesCurvesAndFieldsAsWholes) {
  const Scene meadow = load_scene(test::scene_paths(), "meadow");
  const Scene larger = placed_scene(meadow, {4.0, dvec3(0)});
  for (size_t i = 0; i < meadow.curves.size(); i += 97)
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(larger.curves[i].control[k], 4.0f * meadow.curves[i].control[k]);
  const Scene court = load_scene(test::scene_paths(), "sculptures");
  const Placement placement{3.0, dvec3(5, -7, 11)};
  const Scene there = placed_scene(court, placement);
  for (size_t i = 0; i < court.analytic.size(); ++i)
    for (const dvec3& p : {dvec3(0.1, 0.2, 0.3), dvec3(-0.4, 0.05, 0.2)})
      EXPECT_NEAR(value(there.analytic[i].field, 3.0 * p), 3.0 * value(court.analytic[i].field, p), 1e-12)
          << court.analytic[i].name;
}

// A float near 1e7 is a whole number of metres.
TEST(Placement, FarFromTheOriginPositionsRoundToWhatFloatHas) {
  const Scene scene = load_scene(test::scene_paths(), "sphere");
  const Placement placement{1.0, dvec3(1e7, 0, 0)};
  const Scene there = placed_scene(scene, placement);
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    EXPECT_EQ(there.positions[i].x, std::round(there.positions[i].x));
    EXPECT_LE(std::abs(double(there.positions[i].x) - placement(dvec3(scene.positions[i])).x), 0.5);
  }
}

}  // namespace
}  // namespace hybray
