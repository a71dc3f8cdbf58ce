#include "core/gbuffer/gbuffer.h"

#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 99;
constexpr unsigned kAll =
    kDepth | kDepthDerivatives | kGeometricNormal | kShadingNormal | kPrimitive | kMaterial;

TEST(GBuffer, AgreesWithBruteForceInDoubleAtEveryPixelCentre) {
  const Scene scene = test::triangle_soup(150, 0.8f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  for (DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View view(Camera{"c", vec3(0.3f, 0.2f, 6), vec3(0)},
                    {.width = 77, .height = 45, .near = 0.5, .convention = convention}, scene.bounds);
    const GBuffer g = make_gbuffer(tracer, view, kAll);
    size_t covered = 0;
    int different = 0;
    for (int y = 0; y < 45; ++y)
      for (int x = 0; x < 77; ++x) {
        double w = std::numeric_limits<double>::infinity();
        uint32_t triangle = kNoPrimitive;
        for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
          const auto hit = test::exact_hit(scene, t, view.eye(), view.ray_direction(x + 0.5, y + 0.5));
          if (hit && *hit >= view.near() && *hit < w) w = *hit, triangle = t;
        }
        covered += g.primitive(x, y) != kNoPrimitive;
        if (g.primitive(x, y) != triangle) {
          ++different;
          continue;
        }
        if (triangle == kNoPrimitive) {
          EXPECT_EQ(g.depth(x, y), view.background_depth());
          continue;
        }
        EXPECT_NEAR(g.depth(x, y), view.device_depth(w), 6e-8);  // float rounding of a number below 1
        EXPECT_EQ(g.material(x, y), 0u);
        const dvec3 n = geometric_normal(scene, triangle);
        EXPECT_NEAR(glm::dot(n, dvec3(g.geometric_normal(x, y))), 1.0, 1e-6);
        EXPECT_NEAR(glm::dot(n, dvec3(g.shading_normal(x, y))), 1.0, 1e-6) << "flat triangles shade flat";
      }
    EXPECT_LE(different, 1) << "seed " << kSeed;
    EXPECT_EQ(g.covered_pixels, covered);
    EXPECT_GT(covered, 500u);
  }
}

TEST(GBuffer, DerivativesPredictTheDepthOfNeighboursOnTheSamePlane) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-50, 0, 5), vec3(100, 0, 0), vec3(0, 0, -60));
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 1.6f, 4), vec3(1, 0.5f, -5)}, {.width = 320, .height = 200},
                  scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kDepth | kDepthDerivatives);
  int compared = 0;
  for (int y = 0; y + 1 < 200; ++y)
    for (int x = 0; x + 1 < 320; ++x) {
      if (g.depth(x, y) == 0.0f || g.depth(x + 1, y) == 0.0f || g.depth(x, y + 1) == 0.0f) continue;
      const vec2 d = g.depth_derivatives(x, y);
      EXPECT_NEAR(g.depth(x, y) + d.x, g.depth(x + 1, y), 3 * 6e-8 * g.depth(x, y));
      EXPECT_NEAR(g.depth(x, y) + d.y, g.depth(x, y + 1), 3 * 6e-8 * g.depth(x, y));
      ++compared;
    }
  EXPECT_GT(compared, 10000);
}

TEST(GBuffer, LeavesOutWhatIsNearerThanTheNearPlaneOrBeyondTheFarPlane) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-1, -1, -2), vec3(2, 0, 0), vec3(0, 2, 0));
  test::add_rectangle(scene, vec3(-9, -9, -6), vec3(18, 0, 0), vec3(0, 18, 0));
  const Tracer tracer(scene, {.robust = true});
  const Camera camera{"c", vec3(0), vec3(0, 0, -1)};
  const auto depth_at_centre = [&](double near, double far) {
    const View view(camera, {.width = 9, .height = 9, .near = near, .far = far}, scene.bounds);
    const GBuffer g = make_gbuffer(tracer, view, kDepth | kPrimitive);
    return g.primitive(4, 4) == kNoPrimitive ? -1.0 : view.view_depth_of(g.depth(4, 4));
  };
  EXPECT_NEAR(depth_at_centre(1, 10), 2.0, 1e-5);
  EXPECT_NEAR(depth_at_centre(3, 10), 6.0, 1e-4);
  EXPECT_EQ(depth_at_centre(3, 5), -1.0);
}

TEST(GBuffer, BuildsOnlyTheBuffersAskedFor) {
  const Scene scene = test::triangle_soup(50, 0.8f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 6), vec3(0)}, {.width = 20, .height = 10}, scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kDepth);
  EXPECT_EQ(g.depth.size(), 200u);
  EXPECT_TRUE(g.depth_derivatives.empty() && g.geometric_normal.empty() && g.shading_normal.empty());
  EXPECT_TRUE(g.primitive.empty() && g.material.empty());
  EXPECT_EQ(g.memory_bytes(), 800u);
}

TEST(DifferenceDerivatives, AreTheDifferencesInsideEachQuad) {
  Image2D<float> depth(5, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) depth(x, y) = static_cast<float>(x * x + 10 * y * y);
  const Image2D<vec2> d = difference_derivatives(depth);
  EXPECT_EQ(d(0, 0), vec2(1, 10));
  EXPECT_EQ(d(1, 0), vec2(1, 10));  // the quad's own difference, not the one to the next quad
  EXPECT_EQ(d(3, 1), vec2(5, 10));
  EXPECT_EQ(d(4, 2), vec2(7, 30));  // no partner: the pixel before
  const Image2D<vec2> one = difference_derivatives(Image2D<float>(1, 1, 3.0f));
  EXPECT_EQ(one(0, 0), vec2(0.0f));
}

}  // namespace
}  // namespace hybray
