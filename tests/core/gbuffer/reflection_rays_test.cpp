#include "core/gbuffer/reflection_rays.h"

#include "core/base/morton.h"
#include "tests/core/test_scenes.h"

#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr unsigned kNeeded = kPrimitive | kShadingNormal;

TEST(ReflectionRays, ObeyTheMirrorLawOnAFloor) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-20, 0, 5), vec3(40, 0, 0), vec3(0, 0, -40));
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 2, 4), vec3(0, 0, -6)}, {.width = 100, .height = 70}, scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kNeeded);
  const ReflectionRays r = make_reflection_rays(g, scene);
  EXPECT_EQ(r.rays.size(), g.covered_pixels);
  EXPECT_EQ(r.mirrored_about_geometric_normal, 0u);
  for (size_t i = 0; i < r.rays.size(); ++i) {
    const double x = r.rays.pixel[i] % 100 + 0.5, y = r.rays.pixel[i] / 100 + 0.5;
    const dvec3 v = glm::normalize(view.ray_direction(x, y));
    const dvec3 d(r.rays.direction(i));
    EXPECT_NEAR(glm::length(d - dvec3(v.x, -v.y, v.z)), 0.0, 2e-7);
    const dvec3 p = view.eye() + view.ray_direction(x, y) * (2.0 / -view.ray_direction(x, y).y);
    EXPECT_NEAR(glm::length(dvec3(r.rays.origin(i)) - p), 0.0, 40.0 * 0x1p-18);
    EXPECT_GT(r.rays.origin(i).y, 0.0f) << "above the floor";
  }
}

TEST(ReflectionRays, CoverEachPixelOnceInTilesAlongMortonCurves) {
  const Scene scene = test::triangle_soup(400, 0.8f, 2.0f, 3);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 4), vec3(0)}, {.width = 61, .height = 43}, scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kNeeded);
  const RayStream rays = make_reflection_rays(g, scene).rays;
  std::vector<uint32_t> expected;
  for (int ty = 0; ty < 43; ty += 8)
    for (int tx = 0; tx < 61; tx += 8)
      for (uint32_t i = 0; i < 64; ++i) {
        const int x = tx + morton_x(i), y = ty + morton_y(i);
        if (x < 61 && y < 43 && g.primitive(x, y) != kNoPrimitive)
          expected.push_back(static_cast<uint32_t>(y * 61 + x));
      }
  EXPECT_EQ(rays.pixel, expected);
}

TEST(ReflectionRays, NeverPointIntoTheSurfaceNorHitTheTriangleTheyLeave) {
  Scene scene = test::triangle_soup(400, 0.8f, 2.0f, 8);
  // Shading normals far from the geometric ones, some on the wrong side.
  for (size_t i = 0; i < scene.normals.size(); ++i) {
    const auto unit = [&](uint32_t d) { return static_cast<float>(2.0 * random_unit(i, d, 3, 8) - 1.0); };
    scene.normals[i] = glm::normalize(scene.normals[i] + 1.5f * vec3(unit(0), unit(1), unit(2)));
  }
  for (float scale : {1e-3f, 1.0f, 1e3f}) {
    Scene scaled = scene;
    for (vec3& p : scaled.positions) p *= scale;
    scaled.bounds = Bounds3{};
    for (const vec3& p : scaled.positions) scaled.bounds.extend(p);
    const Tracer robust(scaled, {.robust = true}), fast(scaled, {});
    const View view(Camera{"c", vec3(0, 0, 4 * scale), vec3(0)},
                    {.width = 200, .height = 150, .near = 0.01 * scale}, scaled.bounds);
    const GBuffer g = make_gbuffer(robust, view, kNeeded);
    const ReflectionRays r = make_reflection_rays(g, scaled);
    EXPECT_GT(r.mirrored_about_geometric_normal, 100u);
    for (size_t i = 0; i < r.rays.size(); ++i) {
      const uint32_t own = g.primitive[r.rays.pixel[i]];
      const dvec3 v = view.ray_direction(r.rays.pixel[i] % 200 + 0.5, r.rays.pixel[i] / 200 + 0.5);
      const dvec3 n = geometric_normal(scaled, own);
      EXPECT_GT(glm::dot(n, dvec3(r.rays.direction(i))) * -glm::dot(n, v), 0.0)
          << "leaves on the side it came from";
      EXPECT_NE(robust.intersect(r.rays.origin(i), r.rays.direction(i)).primitive, own);
      EXPECT_NE(fast.intersect(r.rays.origin(i), r.rays.direction(i)).primitive, own);
    }
  }
}

}  // namespace
}  // namespace hybray
