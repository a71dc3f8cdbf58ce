// The medium around a point, among nested bodies and opaque things.
#include "core/caustics/medium_at.h"

#include "core/scene/shapes.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

void add_box(Scene& scene, uint32_t material, const vec3& center, const vec3& size) {
  mat4 place(1.0f);
  for (int c = 0; c < 3; ++c) place[c][c] = size[c], place[3][c] = center[c];
  append_mesh(scene, make_shape("box", 2), place, material, "box");
}

double ior_at(const Prepared& p, const dvec3& point) {
  return p.caustic.optics.media[medium_at(p.tracer, p.caustic.optics, point)].ior;
}

// A ball of radius 2 of glass of 1.5 with a core of radius 1 of 1.8, whose outer medium is the glass.
Scene nested_balls() {
  Scene scene = empty_scene();
  const uint32_t shell = add_material(scene, glass(1.5f));
  Material inner = glass(1.75f);
  inner.outer_ior = 1.5f;
  const uint32_t core = add_material(scene, inner);
  append_analytic(scene, analytic_sphere("shell", shell, dvec3(0.0), 2.0));
  append_analytic(scene, analytic_sphere("core", core, dvec3(0.5, 0.0, 0.0), 1.0));
  return scene;
}

TEST(MediumAt, KnowsTheInsideOfNestedBallsFromTheirOutside) {
  const Prepared p(nested_balls());
  for (uint64_t i = 0; i < 3000; ++i) {
    dvec3 q(0.0);
    for (uint32_t c = 0; c < 3; ++c) q[static_cast<int>(c)] = -3.0 + 6.0 * random_unit(i, c, 0, 3);
    const double from_shell = glm::length(q), from_core = glm::length(q - dvec3(0.5, 0.0, 0.0));
    if (std::abs(from_shell - 2.0) < 1e-3 || std::abs(from_core - 1.0) < 1e-3) continue;
    const double expected = from_core < 1.0 ? 1.75 : from_shell < 2.0 ? 1.5 : 1.0;
    // Outside, directions that miss the balls say vacuum, and so do those that meet them.
    ASSERT_EQ(ior_at(p, q), expected) << "item " << i;
  }
}

TEST(MediumAt, LooksThroughOpaqueThingsMirrorsAndSheets) {
  Scene scene = nested_balls();
  const uint32_t m = add_material(scene, mirror(vec3(1.0f)));
  Material pane = glass(1.3f);
  pane.thin_walled = true;
  const uint32_t sheet = add_material(scene, pane);
  // A point in the shell shut into three boxes.
  add_box(scene, 0, vec3(-1.25f, 0.0f, 0.0f), vec3(0.1f));
  add_box(scene, m, vec3(-1.25f, 0.0f, 0.0f), vec3(0.2f));
  add_box(scene, sheet, vec3(-1.25f, 0.0f, 0.0f), vec3(0.3f));
  // And one outside.
  add_box(scene, 0, vec3(4.0f, 0.0f, 0.0f), vec3(0.5f));
  const Prepared p(std::move(scene));
  EXPECT_EQ(ior_at(p, dvec3(-1.25, 0.01, 0.0)), 1.5);
  EXPECT_EQ(ior_at(p, dvec3(-1.25, 0.07, 0.0)), 1.5);
  EXPECT_EQ(ior_at(p, dvec3(-1.25, 0.12, 0.0)), 1.5);
  EXPECT_EQ(ior_at(p, dvec3(4.0, 0.1, 0.0)), 1.0);
}

TEST(MediumAt, UnderWaterAndAboveIt) {
  // A pool: water of index 1.333 in a box, a matte ball in it, on a matte floor.
  Scene scene = empty_scene();
  const uint32_t water = add_material(scene, glass(1.333f, vec3(0.1f)));
  add_box(scene, water, vec3(0.0f, -1.0f, 0.0f), vec3(10.0f, 2.0f, 6.0f));
  add_floor(scene, 20.0f, -2.1f);
  append_analytic(scene, analytic_sphere("ball", 0, dvec3(1.0, -1.0, 0.5), 0.4));
  const Prepared p(std::move(scene));
  const double n = static_cast<double>(1.333f);
  for (const dvec3& below :
       {dvec3(0.0, -0.01, 0.0), dvec3(4.9, -1.9, 2.9), dvec3(1.0, -0.59, 0.5), dvec3(-3.0, -1.0, -2.99)})
    EXPECT_EQ(ior_at(p, below), n) << below.x;
  const uint16_t medium = medium_at(p.tracer, p.caustic.optics, dvec3(0.0, -1.0, 0.0));
  EXPECT_EQ(p.caustic.optics.media[medium].absorption, dvec3(vec3(0.1f)));
  for (const dvec3& outside :
       {dvec3(0.0, 0.01, 0.0), dvec3(5.01, -1.0, 0.0), dvec3(0.0, -2.05, 0.0), dvec3(0.0, 50.0, 0.0)})
    EXPECT_EQ(ior_at(p, outside), 1.0) << outside.y;
}

TEST(MediumAt, GoesByTheMajorityWhereBodiesDisagree) {
  // A glass ball in water that states vacuum around itself: whichever way it lies, most directions see more
  // of the water.
  for (uint64_t i = 0; i < 40; ++i) {
    Scene scene = empty_scene();
    const uint32_t water = add_material(scene, glass(1.25f)), ball = add_material(scene, glass(1.5f));
    add_box(scene, water, vec3(0.0f), vec3(8.0f));
    const double c = 2.0 * random_unit(i, 0, 0, 4) - 1.0, phi = 6.28 * random_unit(i, 1, 0, 4);
    const double s = std::sqrt(1.0 - c * c);
    append_analytic(scene,
                    analytic_sphere("ball", ball, dvec3(s * std::cos(phi), c, s * std::sin(phi)), 0.6));
    const Prepared p(std::move(scene));
    EXPECT_EQ(ior_at(p, dvec3(0.0)), 1.25) << i;
  }
}

TEST(MediumAt, WithoutInterfacesIsVacuumAndTracesNothing) {
  Scene scene = empty_scene();
  const uint32_t m = add_material(scene, mirror(vec3(1.0f)));
  append_analytic(scene, analytic_sphere("mirror", m, dvec3(0.0), 2.0));
  const Prepared p(std::move(scene));
  EXPECT_EQ(medium_at(p.tracer, p.caustic.optics, dvec3(0.0)), 0);
}

}  // namespace
}  // namespace hybray
