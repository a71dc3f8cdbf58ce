// The table against the same point worked out anew.
#include "core/scene/surface_table.h"

#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

// The point of a triangle with barycentric weights (1 - u - v, u, v), in double.
dvec3 point_of(const Scene& scene, uint32_t triangle, double u, double v) {
  const uvec3& t = scene.triangles[triangle];
  return (1.0 - u - v) * dvec3(scene.positions[t.x]) + u * dvec3(scene.positions[t.y]) +
         v * dvec3(scene.positions[t.z]);
}

// Triangles with normals that lean away from their own, for odd numbers.
Scene leaning_soup() {
  Scene scene = test::triangle_soup(500, 0.4f, 8.0f, 3);
  for (uint32_t t = 1; t < scene.triangles.size(); t += 2)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t v = scene.triangles[t][static_cast<int>(k)];
      const auto lean = [&](uint32_t d) { return static_cast<float>(random_unit(v, d) - 0.5); };
      scene.normals[v] = glm::normalize(scene.normals[v] + vec3(lean(0), lean(1), lean(2)));
    }
  return scene;
}

TEST(SurfaceTable, AgreesWithThePointWorkedOutAnewWithinRounding) {
  const Scene scene = leaning_soup();
  const SurfaceTable table(scene, true);
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const double u = 0.6 * random_unit(t, 0, 1), v = 0.4 * random_unit(t, 1, 1);
    const dvec3 on = point_of(scene, t, u, v);
    // A hit beside the surface by what a float distance may be off.
    const dvec3 hit = on + 1e-6 * geometric_normal(scene, t);
    const SurfacePoint a = table.point(t, static_cast<float>(u), static_cast<float>(v), hit);
    const SurfacePoint b = surface_point(scene, t, static_cast<float>(u), static_cast<float>(v), hit);
    // The plane's normal is a float: 6e-8 of the distance from the vertex that the plane goes through, and
    // of the coordinates where the plane's constant cancels.
    EXPECT_LT(glm::length(a.position - on), 3e-7 * 8.0);
    EXPECT_LT(glm::length(a.geometric_normal - b.geometric_normal), 2e-7);
    EXPECT_LT(glm::length(a.shading_normal - b.shading_normal), 6e-7);
    EXPECT_NEAR(a.offset, b.offset, 1e-6 * b.offset);
    EXPECT_GT(a.offset, glm::length(a.position - on));
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.primitive, b.primitive);
  }
}

TEST(SurfaceTable, LeavesAnalyticSurfacesAndEmptyTablesToTheExactFunction) {
  Scene scene = leaning_soup();
  append_analytic(scene, analytic_sphere("ball", 0, dvec3(0.5, 0.25, -1.0), 2.0));
  const auto ball = static_cast<uint32_t>(scene.triangles.size());
  const SurfaceTable full(scene, true), empty(scene, false);
  const dvec3 hit(0.5, 2.25 + 1e-7, -1.0);
  for (const SurfaceTable* table : {&full, &empty}) {
    const SurfacePoint p = table->point(ball, 0.0f, 0.0f, hit);
    EXPECT_NEAR(p.position.y, 2.25, 1e-12);
    EXPECT_NEAR(p.geometric_normal.y, 1.0, 1e-12);
  }
  const SurfacePoint a = empty.point(7, 0.25f, 0.5f, hit), b = surface_point(scene, 7, 0.25f, 0.5f, hit);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.shading_normal, b.shading_normal);
}

}  // namespace
}  // namespace hybray
