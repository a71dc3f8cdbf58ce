#include "core/scene/pose.h"

#include "core/base/error.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Pose, TurnsScalesAndMovesInThatOrder) {
  const Pose p{2.0, rotation({0, 0, 3}, 0.5 * std::numbers::pi), {10, 20, 30}};
  const dvec3 x = p({1, 2, 3});
  EXPECT_NEAR(x.x, 10.0 - 4.0, 1e-14);
  EXPECT_NEAR(x.y, 20.0 + 2.0, 1e-14);
  EXPECT_NEAR(x.z, 36.0, 1e-14);
  EXPECT_NEAR(glm::length(p.inverse(x) - dvec3(1, 2, 3)), 0.0, 1e-14);
}

TEST(Pose, RotationsKeepLengthsAnglesAndTheirAxis) {
  const dvec3 axis(0.3, 0.5, -0.8);
  const dmat3 r = rotation(axis, 1.1);
  EXPECT_NEAR(glm::length(r * axis - axis), 0.0, 1e-15);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(glm::dot(r[i], r[j]), i == j ? 1.0 : 0.0, 1e-15);
  EXPECT_NEAR(r[0][0] + r[1][1] + r[2][2], 1.0 + 2.0 * std::cos(1.1), 1e-14);  // the trace of any rotation
  EXPECT_GT(glm::dot(glm::cross(dvec3(1, 0, 0), r * dvec3(1, 0, 0)), axis), 0.0);
}

TEST(Pose, PlacesEverythingOfAScene) {
  const Scene scene = procedural::closed_form_scene(procedural::GlassSlab{});
  const Pose p{4.0, rotation({1, 2, 3}, 0.7), {5, -6, 7}};
  Scene moved = posed(scene, p);
  EXPECT_EQ(leave_out_collapsed(moved), 0u);
  ASSERT_EQ(moved.triangle_count(), scene.triangle_count());
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    EXPECT_EQ(moved.positions[i], vec3(p(dvec3(scene.positions[i]))));
    EXPECT_NEAR(glm::length(moved.normals[i]), 1.0f, 1e-6f);
  }
  for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    EXPECT_NEAR(glm::length(geometric_normal(moved, t) - p.turn * geometric_normal(scene, t)), 0.0, 1e-5);
  EXPECT_EQ(moved.lights[0].position, vec3(p(dvec3(scene.lights[0].position))));
  EXPECT_EQ(moved.cameras[0].target, vec3(p(dvec3(scene.cameras[0].target))));
  EXPECT_EQ(moved.materials[1].absorption.x, scene.materials[1].absorption.x / 4.0f);
  for (const vec3& v : moved.positions)
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(moved.bounds.lower[k], v[k]);
      EXPECT_GE(moved.bounds.upper[k], v[k]);
    }
  EXPECT_NE(moved.content_hash, scene.content_hash);
  EXPECT_EQ(posed(scene, {}).content_hash, scene.content_hash);
}

TEST(Pose, MovesAndScalesBallsButTurnsNoUprightSurface) {
  const Scene ball = posed(procedural::closed_form_scene(procedural::BallLens{}),
                           {3.0, rotation({0, 0, 1}, std::numbers::pi), {1, 0, 0}});
  EXPECT_NEAR(glm::length(ball.analytic[0].center - dvec3(1.0, -4.5, 0.0)), 0.0, 1e-14);
  EXPECT_EQ(ball.analytic[0].radius, 3.0);
  Scene pipe;
  pipe.materials.emplace_back();
  append_analytic(pipe, analytic_cylinder("pipe", 0, dvec3(1, 0, 2), 0.5, 1.0, 2.0));
  const Scene moved = posed(pipe, {2.0, dmat3(1.0), {0, 10, 0}});
  EXPECT_EQ(moved.analytic[0].y0, 12.0);
  EXPECT_EQ(moved.analytic[0].y1, 14.0);
  EXPECT_THROW(posed(pipe, {1.0, rotation({1, 0, 0}, 0.1), {}}), InputError);
}

TEST(Pose, LeavesOutTrianglesWithoutAreaAndKeepsTheOthersWithTheirObjects) {
  // Half a metre thick where floats are one metre apart: the four sides of the slab collapse.
  const Scene scene = procedural::closed_form_scene(procedural::GlassSlab{.bottom = 0.0, .thickness = 0.25});
  Scene moved = posed(scene, {1.0, dmat3(1.0), dvec3(0x1p23)});
  EXPECT_EQ(moved.triangle_count(), scene.triangle_count()) << "ids stay";
  EXPECT_EQ(leave_out_collapsed(moved), 8u);
  ASSERT_EQ(moved.objects.size(), 2u);
  EXPECT_EQ(moved.objects[0].triangle_count, 2u);
  EXPECT_EQ(moved.objects[1].first_triangle, 2u);
  EXPECT_EQ(moved.objects[1].triangle_count, 4u);
  EXPECT_EQ(moved.triangle_material, std::vector<uint32_t>({0, 0, 1, 1, 1, 1}));
}

TEST(Pose, RebasingLosesNothingThatTheSceneStillHad) {
  const Scene scene = procedural::closed_form_scene(procedural::GlassSlab{});
  const Scene far = posed(scene, {1.0, dmat3(1.0), dvec3(12345.678)});
  const dvec3 middle = rebasing_offset(far);
  const Scene near = posed(far, {1.0, dmat3(1.0), -middle});
  for (size_t i = 0; i < far.positions.size(); ++i)
    EXPECT_EQ(dvec3(near.positions[i]) + middle, dvec3(far.positions[i]));
  EXPECT_EQ(dvec3(near.lights[0].position) + middle, dvec3(far.lights[0].position));
  EXPECT_LT(glm::length(near.bounds.center()), 1.0f);
}

TEST(Pose, LeavesASceneThatStaysWhereItIsAsItIs) {
  for (const char* name : {"sphere", "closed_ball_lens", "meadow", "sculptures"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    EXPECT_EQ(posed(scene, {}).content_hash, scene.content_hash) << name;
  }
}

TEST(Pose, ByPowersOfTwoAndBackLosesNothing) {
  const Scene scene = load_scene(test::scene_paths(), "sphere");
  const Scene there = posed(scene, {.scale = 1024.0});
  EXPECT_NE(there.content_hash, scene.content_hash);
  for (size_t i = 0; i < scene.positions.size(); ++i)
    EXPECT_EQ(there.positions[i], 1024.0f * scene.positions[i]);
  EXPECT_EQ(there.bounds.lower, 1024.0f * scene.bounds.lower);
  EXPECT_EQ(there.cameras[0].eye, 1024.0f * scene.cameras[0].eye);
  EXPECT_EQ(posed(there, {.scale = 1.0 / 1024.0}).content_hash, scene.content_hash);
}

TEST(Pose, MovesAnalyticSurfacesInDouble) {
  const Scene scene = load_scene(test::scene_paths(), "closed_cylinder");
  const Pose pose{.scale = 3.0, .offset = dvec3(1e7, -2e7, 5e6)};
  const Scene there = posed(scene, pose);
  const AnalyticSurface &was = scene.analytic[0], &is = there.analytic[0];
  EXPECT_EQ(is.center, pose(was.center));
  EXPECT_EQ(is.radius, 3.0 * was.radius);
  EXPECT_EQ(is.y0, 3.0 * was.y0 - 2e7);
  EXPECT_EQ(is.y1, 3.0 * was.y1 - 2e7);
  EXPECT_GE(there.bounds.upper.y, static_cast<float>(is.y1));
  EXPECT_EQ(there.triangle_count(), scene.triangle_count());
}

TEST(Pose, ScalesCurvesAndFieldsAsWholes) {
  const Scene meadow = load_scene(test::scene_paths(), "meadow");
  const Scene larger = posed(meadow, {.scale = 4.0});
  for (size_t i = 0; i < meadow.curves.size(); i += 97)
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(larger.curves[i].control[k], 4.0f * meadow.curves[i].control[k]);
  const Scene court = load_scene(test::scene_paths(), "sculptures");
  const Pose pose{.scale = 3.0, .offset = dvec3(5, -7, 11)};
  const Scene there = posed(court, pose);
  for (size_t i = 0; i < court.analytic.size(); ++i)
    for (const dvec3& p : {dvec3(0.1, 0.2, 0.3), dvec3(-0.4, 0.05, 0.2)})
      EXPECT_NEAR(value(there.analytic[i].field, 3.0 * p), 3.0 * value(court.analytic[i].field, p), 1e-12)
          << court.analytic[i].name;
}

// A float near 1e7 is a whole number of metres.
TEST(Pose, FarFromTheOriginPositionsRoundToWhatFloatHas) {
  const Scene scene = load_scene(test::scene_paths(), "sphere");
  const Pose pose{.scale = 1.0, .offset = dvec3(1e7, 0, 0)};
  const Scene there = posed(scene, pose);
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    EXPECT_EQ(there.positions[i].x, std::round(there.positions[i].x));
    EXPECT_LE(std::abs(double(there.positions[i].x) - pose(dvec3(scene.positions[i])).x), 0.5);
  }
}

}  // namespace
}  // namespace hybray
