#include "core/gbuffer/pixel_rays.h"

#include "core/gbuffer/reflection_rays.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr unsigned kNeeded = kPrimitive | kShadingNormal;

struct Floor {
  Scene scene = test::empty_scene();
  Floor() { test::add_rectangle(scene, vec3(-20, 0, 5), vec3(40, 0, 0), vec3(0, 0, -40)); }
};

GBuffer seen(const Scene& scene, int width, int height) {
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 2, 4), vec3(0, 0, -6)}, {.width = width, .height = height},
                  scene.bounds);
  return make_gbuffer(tracer, view, kNeeded);
}

TEST(PixelRays, AtRoughnessZeroAreTheMirrorRays) {
  Scene scene = test::triangle_soup(400, 0.8f, 2.0f, 8);
  for (size_t i = 0; i < scene.normals.size(); ++i) {  // some far from the geometric ones
    const auto unit = [&](uint32_t d) { return static_cast<float>(2.0 * random_unit(i, d, 3, 8) - 1.0); };
    scene.normals[i] = glm::normalize(scene.normals[i] + 0.7f * vec3(unit(0), unit(1), unit(2)));
  }
  const GBuffer g = seen(scene, 160, 90);
  const ReflectionRays mirror = make_reflection_rays(g, scene);
  const PixelRays rough = make_pixel_rays(g, scene, {.kind = RayKind::rough, .roughness = 0.0});
  EXPECT_GT(mirror.mirrored_about_geometric_normal, 0u);
  EXPECT_EQ(rough.about_geometric_normal, mirror.mirrored_about_geometric_normal);
  EXPECT_EQ(rough.skipped, 0u);
  ASSERT_EQ(rough.rays.pixel, mirror.rays.pixel);
  for (size_t i = 0; i < rough.rays.size(); ++i) {
    EXPECT_EQ(rough.rays.origin(i), mirror.rays.origin(i));
    // Both are rounded to float once; the doubles before differ by a few 2^-53.
    EXPECT_LE(glm::length(rough.rays.direction(i) - mirror.rays.direction(i)), 2e-7f);
  }
}

TEST(PixelRays, OfEveryKindLeaveTheSurfaceAndRepeatThemselves) {
  Scene scene = test::triangle_soup(400, 0.8f, 2.0f, 3);
  scene.lights.push_back({});
  scene.lights[0].position = vec3(1, 5, 2);
  const GBuffer g = seen(scene, 61, 43);
  for (RayKind kind : {RayKind::rough, RayKind::ambient, RayKind::shadow}) {
    const PixelRaySettings settings{.kind = kind, .rays_per_pixel = 3, .roughness = 0.8, .length = 0.7};
    const PixelRays a = make_pixel_rays(g, scene, settings), b = make_pixel_rays(g, scene, settings);
    EXPECT_EQ(a.rays.size() + a.skipped, 3 * g.covered_pixels);
    EXPECT_EQ(a.rays.dx, b.rays.dx);
    EXPECT_EQ(a.lengths, b.lengths);
    EXPECT_EQ(a.lengths.size(), asks_for_occlusion(kind) ? a.rays.size() : 0u);
    for (size_t i = 0; i < a.rays.size(); ++i) {
      const uint32_t primitive = g.primitive[a.rays.pixel[i]];
      dvec3 n = geometric_normal(scene, primitive);
      if (glm::dot(n, dvec3(a.rays.origin(i)) - g.view.eye()) > 0.0) n = -n;
      EXPECT_GT(glm::dot(n, dvec3(a.rays.direction(i))), -1e-6);
      EXPECT_NEAR(glm::length(dvec3(a.rays.direction(i))), 1.0, 1e-6);
      if (kind == RayKind::ambient) {
        EXPECT_EQ(a.lengths[i], 0.7f);
      }
      if (kind == RayKind::shadow) {
        const dvec3 end =
            dvec3(a.rays.origin(i)) + static_cast<double>(a.lengths[i]) * dvec3(a.rays.direction(i));
        EXPECT_NEAR(glm::length(end - dvec3(1, 5, 2)), 1e-4 * a.lengths[i], 1e-5);
      }
    }
    if (kind == RayKind::shadow) continue;
    PixelRaySettings other = settings;
    other.seed = 2;
    EXPECT_NE(a.rays.dx, make_pixel_rays(g, scene, other).rays.dx);
  }
}

TEST(PixelRays, OfAPixelAreAsManyAsAskedForAndDiffer) {
  const Floor floor;
  const GBuffer g = seen(floor.scene, 64, 1);
  const PixelRays r = make_pixel_rays(g, floor.scene, {.kind = RayKind::ambient, .rays_per_pixel = 5});
  std::map<uint32_t, std::vector<float>> by_pixel;
  for (size_t i = 0; i < r.rays.size(); ++i) by_pixel[r.rays.pixel[i]].push_back(r.rays.dx[i]);
  EXPECT_EQ(by_pixel.size(), g.covered_pixels);
  for (auto& [pixel, dx] : by_pixel) {
    std::sort(dx.begin(), dx.end());
    EXPECT_EQ(dx.size(), 5u);
    EXPECT_EQ(std::unique(dx.begin(), dx.end()), dx.end());
  }
}

TEST(PixelRays, AmbientRaysFollowTheCosine) {
  const Floor floor;
  const GBuffer g = seen(floor.scene, 160, 90);
  const PixelRays r = make_pixel_rays(g, floor.scene, {.kind = RayKind::ambient, .rays_per_pixel = 8});
  double sum = 0.0;
  for (float y : r.rays.dy) sum += static_cast<double>(y);
  const auto n = static_cast<double>(r.rays.size());
  // Mean 2/3 and variance 1/18 of the cosine under its own density.
  EXPECT_NEAR(sum / n, 2.0 / 3.0, 5.0 * std::sqrt(1.0 / 18.0 / n));
}

TEST(PixelRays, ToASunAreParallelAndLeaveOutWhatIsTurnedAway) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-20, 0, 5), vec3(40, 0, 0), vec3(0, 0, -40));  // floor
  const GBuffer g = seen(scene, 50, 40);
  const dvec3 up = glm::normalize(dvec3(1, 2, 0)), below = glm::normalize(dvec3(1, -2, 0));
  const PixelRays lit = make_pixel_rays(g, scene, {.kind = RayKind::shadow, .to_sun = up});
  EXPECT_EQ(lit.rays.size(), g.covered_pixels);
  for (size_t i = 0; i < lit.rays.size(); ++i) {
    EXPECT_EQ(lit.rays.direction(i), vec3(up));
    EXPECT_TRUE(std::isinf(lit.lengths[i]));
  }
  const PixelRays dark = make_pixel_rays(g, scene, {.kind = RayKind::shadow, .to_sun = below});
  EXPECT_EQ(dark.rays.size(), 0u);
  EXPECT_EQ(dark.skipped, g.covered_pixels);
}

}  // namespace
}  // namespace hybray
