// The table against the same point worked out anew.
#include "core/scene/surface_table.h"

#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>

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

// How far `p`, as a float, lies off the plane of `triangle` on the side of `normal`, by the triangle's own
// vertices.
double clearance(const Scene& scene, uint32_t triangle, const dvec3& p, double sign) {
  const dvec3 a(scene.positions[scene.triangles[triangle].x]);
  return sign * glm::dot(dvec3(vec3(p)) - a, geometric_normal(scene, triangle));
}

TEST(SurfaceTable, OffsetsClearTheRoundingOfPointsWhereverTheyLie) {
  for (const double place : {0.0, 10.0, 1e3, 1e5}) {
    Scene scene = leaning_soup();
    for (vec3& p : scene.positions) p += vec3(static_cast<float>(place));
    const SurfaceTable table(scene, true), none(scene, false);
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const auto u = static_cast<float>(0.6 * random_unit(t, 0, 1)),
                 v = static_cast<float>(0.4 * random_unit(t, 1, 1));
      for (const SurfaceTable* from : {&table, &none})
        for (const LeavingOffset leaving : {LeavingOffset::largest, LeavingOffset::along_normal}) {
          const dvec3 hit = point_of(scene, t, static_cast<double>(u), static_cast<double>(v));
          const SurfacePoint p = from->point(t, u, v, hit, leaving);
          for (const double sign : {-1.0, 1.0})
            EXPECT_GT(clearance(scene, t, p.position + sign * p.offset * p.geometric_normal, sign),
                      0.25 * p.offset)
                << "triangle " << t << " at " << place;
        }
    }
  }
}

TEST(SurfaceTable, OffsetsAlongTheNormalDoNotGrowWithWhatLiesAcrossIt) {
  // A level square of side 2000 whose height is 0.75, and one like it through the origin.
  for (const float height : {0.75f, 0.0f}) {
    Scene scene = test::triangle_soup(1, 1.0f, 1.0f, 1);
    const float far = 1000.0f;
    scene.positions = {{-far, height, far}, {far, height, far}, {far, height, -far}};
    for (vec3& n : scene.normals) n = vec3(0, 1, 0);
    const SurfaceTable table(scene, true);
    const dvec3 hit(123.0, static_cast<double>(height), -45.0);
    const auto offset = [&](LeavingOffset leaving) {
      return table.point(0, 0.2f, 0.3f, hit, leaving).offset;
    };
    EXPECT_EQ(offset(LeavingOffset::largest), kSurfaceOffset * 2000.0);
    EXPECT_EQ(offset(LeavingOffset::along_normal), kNormalOffset * kLeastOfEdge * 2000.0);
  }
}

TEST(SurfaceTable, OffsetsAlongTheNormalClearASphereFarFromTheOrigin) {
  Scene scene = leaning_soup();
  const dvec3 center(2e4, -1e3, 3e5);
  append_analytic(scene, analytic_sphere("ball", 0, center, 0.75));
  const auto ball = static_cast<uint32_t>(scene.triangles.size());
  for (uint32_t i = 0; i < 2000; ++i) {
    const dvec3 n = glm::normalize(dvec3(random_unit(i, 0), random_unit(i, 1), random_unit(i, 2)) - 0.5);
    const SurfacePoint p =
        surface_point(scene, ball, 0.0f, 0.0f, center + 0.75 * n, LeavingOffset::along_normal);
    for (const double sign : {-1.0, 1.0}) {
      const dvec3 left(vec3(p.position + sign * p.offset * n));
      EXPECT_GT(sign * (glm::length(left - center) - 0.75), 0.0) << i;
    }
    EXPECT_LE(p.offset, kNormalOffset * (std::sqrt(3.0) * 3e5 + 0x1p-24 * 9e10));
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
