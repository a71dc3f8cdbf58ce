// Curves in the G-buffer, in its layers and conservative bounds, and as origins of reflection rays.
#include "core/gbuffer/conservative_depth.h"
#include "core/gbuffer/depth_layers.h"
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/reflection_rays.h"
#include "core/gbuffer/triangle_plane.h"
#include "core/scene/curved_primitive.h"
#include "tests/core/curve_truth.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr unsigned kAll =
    kDepth | kDepthDerivatives | kGeometricNormal | kShadingNormal | kPrimitive | kMaterial;
constexpr uint64_t kSeed = 12;
constexpr uint32_t kCurves = 14;

Scene curves_over_floor() {
  Scene scene = test::empty_scene();
  scene.materials.push_back({});
  test::add_rectangle(scene, vec3(-5, -1.5f, 5), vec3(10, 0, 0), vec3(0, 0, -10));
  for (uint64_t i = 0; i < kCurves; ++i) {
    RoundCurve curve =
        test::random_curve([&](uint32_t d) { return 2.0 * random_unit(i, d, 0, kSeed) - 1.0; }, 0.12);
    curve.material = 1;
    append_curve(scene, curve);
  }
  return scene;
}
View view_of(const Scene& scene, DepthConvention convention = DepthConvention::standard) {
  return {Camera{"c", vec3(0.5f, 1, 4), vec3(0.1f, 0.0f, 0)},
          {.width = 123, .height = 77, .near = 0.5, .convention = convention},
          scene.bounds};
}

TEST(CurveGBuffer, HasTheDepthNormalAndSlopeOfTheSweptCircle) {
  const Scene scene = curves_over_floor();
  const Tracer tracer(scene, {.robust = true});
  std::vector<test::CurveTruth> truth;
  for (const RoundCurve& curve : scene.curves) truth.emplace_back(curve);
  for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View view = view_of(scene, convention);
    const GBuffer g = make_gbuffer(tracer, view, kAll);
    int seen = 0, sloped = 0, beside = 0;
    for (int y = 0; y < 77; ++y)
      for (int x = 0; x < 123; ++x) {
        const uint32_t primitive = g.primitive(x, y);
        if (primitive == kNoPrimitive || !scene.is_curve(primitive)) continue;
        EXPECT_EQ(g.material(x, y), 1u);
        EXPECT_EQ(g.geometric_normal(x, y), g.shading_normal(x, y));
        const test::CurveTruth& curve = truth[primitive - scene.first_curve()];
        // View depth at which the ray through a screen point meets it.
        const auto depth_at = [&](double px, double py) -> std::optional<double> {
          const dvec3 ray = view.ray_direction(px, py);
          const auto t = curve.first_hit(view.eye(), glm::normalize(ray), 8.0, 1.6);
          return t ? std::optional(*t / glm::length(ray)) : std::nullopt;
        };
        const auto w = depth_at(x + 0.5, y + 0.5);
        if (!w) {
          ++beside;  // the tracer's float ray met it, the double one passes beside it
          continue;
        }
        ++seen;
        EXPECT_NEAR(g.depth(x, y), view.device_depth(*w), 6e-8) << x << " " << y;
        const dvec3 at = view.eye() + *w * view.ray_direction(x + 0.5, y + 0.5);
        const dvec3 n(g.geometric_normal(x, y));
        EXPECT_LT(glm::length(n - outward_normal(scene, primitive, at)), 1e-6) << x << " " << y;
        if (std::abs(glm::dot(n, glm::normalize(view.eye() - at))) < 0.5) continue;
        constexpr double kH = 1e-3;
        const auto left = depth_at(x + 0.5 - kH, y + 0.5), right = depth_at(x + 0.5 + kH, y + 0.5),
                   above = depth_at(x + 0.5, y + 0.5 - kH), below = depth_at(x + 0.5, y + 0.5 + kH);
        if (!left || !right || !above || !below) continue;
        ++sloped;
        // Central differences: the second derivative cancels, the third is (footprint / radius)^2, 1/10.
        const auto slope = [&](double a, double b) {
          return (view.device_depth(b) - view.device_depth(a)) / (2.0 * kH);
        };
        const double sx = slope(*left, *right), sy = slope(*above, *below);
        EXPECT_NEAR(g.depth_derivatives(x, y).x, sx, 1e-5 * std::abs(sx) + 1e-8) << x << " " << y;
        EXPECT_NEAR(g.depth_derivatives(x, y).y, sy, 1e-5 * std::abs(sy) + 1e-8) << x << " " << y;
      }
    EXPECT_GT(seen, 500);
    EXPECT_GT(sloped, 300);
    EXPECT_LE(beside, 2);
  }
}

TEST(CurveGBuffer, ReflectionRaysLeaveByTheMirrorLawAndDoNotStartInside) {
  const Scene scene = curves_over_floor();
  const Tracer tracer(scene, {.robust = true});
  const View view = view_of(scene);
  const GBuffer g = make_gbuffer(tracer, view, kPrimitive | kShadingNormal);
  const ReflectionRays r = make_reflection_rays(g, scene);
  EXPECT_EQ(r.rays.size(), g.covered_pixels);
  int on_curve = 0;
  for (size_t i = 0; i < r.rays.size(); ++i) {
    const uint32_t primitive = g.primitive[r.rays.pixel[i]];
    if (!scene.is_curve(primitive)) continue;
    ++on_curve;
    const dvec3 p = seen_point(view, scene, primitive, r.rays.pixel[i] % 123 + 0.5,
                               static_cast<double>(r.rays.pixel[i] / 123) + 0.5);
    const dvec3 n = outward_normal(scene, primitive, p), v = glm::normalize(p - view.eye());
    if (glm::dot(n, v) > 0.0) continue;  // seen through an open end
    EXPECT_LT(glm::length(dvec3(r.rays.direction(i)) - (v - 2.0 * glm::dot(v, n) * n)), 1e-6);
    EXPECT_GT(test::CurveTruth(scene.curve(primitive)).field(dvec3(r.rays.origin(i))), 0.0);
  }
  EXPECT_GT(on_curve, 500);
}

// Behind a curve comes what the ray meets next, not the curve's own far side.
TEST(CurveGBuffer, ACurveIsOneLayer) {
  const Scene scene = curves_over_floor();
  const Tracer tracer(scene, {.robust = true, .layers = true});
  const View view = view_of(scene);
  const GBuffer first = make_gbuffer(tracer, view, kDepth | kDepthDerivatives | kPrimitive);
  const DepthLayers layers = make_depth_layers(tracer, first, 4);
  int compared = 0, differ = 0;
  for (int y = 0; y < 77; ++y)
    for (int x = 0; x < 123; ++x) {
      const dvec3 ray = view.ray_direction(x + 0.5, y + 0.5);
      std::vector<std::pair<double, uint32_t>> met;
      for (uint32_t p = 0; p < scene.primitive_count(); ++p) {
        const auto w = scene.is_curve(p) ? nearest_hit(scene, p, view.eye(), ray, view.near(), view.far())
                                         : test::exact_hit(scene, p, view.eye(), ray);
        if (w) met.emplace_back(*w, p);
      }
      std::sort(met.begin(), met.end());
      for (size_t k = 0; k < 4; ++k) {
        const uint32_t got = k == 0 ? first.primitive(x, y) : layers.further[k - 1].primitive(x, y);
        const uint32_t expected = k < met.size() ? met[k].second : kNoPrimitive;
        compared += k > 0 && k < met.size() && scene.is_curve(met[k - 1].second);
        if (got == expected) continue;
        ++differ;  // a float ray by an outline or the floor's diagonal
        break;
      }
    }
  EXPECT_LE(differ, 6);
  EXPECT_GT(compared, 300);
}

TEST(CurveGBuffer, ConservativeBoundsLieInFrontOfEveryPointOfACurve) {
  const Scene scene = curves_over_floor();
  const Tracer tracer(scene, {.robust = true});
  const View view = view_of(scene);
  const GBuffer g = make_gbuffer(tracer, view, kAll);
  ConservativeDepth c;
  make_conservative_depth(g, scene, c);
  const double sign = view.depth_sign();
  size_t seen = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const double px = 123.0 * random_unit(i, 0, 0, 9), py = 77.0 * random_unit(i, 1, 0, 9);
    const int x = static_cast<int>(px), y = static_cast<int>(py);
    for (uint32_t p = static_cast<uint32_t>(scene.first_curve()); p < scene.primitive_count(); ++p) {
      const auto w = nearest_hit(scene, p, view.eye(), view.ray_direction(px, py), view.near(), view.far());
      if (!w) continue;
      ++seen;
      const double z = sign * view.device_depth(*w);
      ASSERT_GE(z, sign * c.nearest(x, y)) << "point " << i;
      const vec2 d = g.depth_derivatives(x, y);
      ASSERT_GE(z, c.intercept(x, y) + sign * (d.x * (px - x - 0.5) + d.y * (py - y - 0.5)));
    }
  }
  EXPECT_GT(seen, 1000u);
}

}  // namespace
}  // namespace hybray
