// Analytic surfaces in the G-buffer and as origins of reflection rays.
#include "core/gbuffer/gbuffer.h"
#include "core/gbuffer/reflection_rays.h"
#include "core/gbuffer/triangle_plane.h"
#include "tests/core/field_truth.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr unsigned kAll =
    kDepth | kDepthDerivatives | kGeometricNormal | kShadingNormal | kPrimitive | kMaterial;
const dvec3 kCenter(0.25, 0.5, -1.0);
constexpr double kRadius = 1.25;

Scene ball_over_floor() {
  Scene scene = test::empty_scene();
  scene.materials.push_back({});
  test::add_rectangle(scene, vec3(-5, -1, 5), vec3(10, 0, 0), vec3(0, 0, -10));
  append_analytic(scene, analytic_sphere("ball", 1, kCenter, kRadius));
  return scene;
}

// View depth at which the ray of a screen point meets the ball.
std::optional<double> ball_depth(const View& view, double px, double py) {
  const dvec3 d = view.ray_direction(px, py), o = view.eye() - kCenter;
  const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - kRadius * kRadius;
  if (b * b < a * c) return std::nullopt;
  return (-b - std::sqrt(b * b - a * c)) / a;
}

TEST(AnalyticGBuffer, ASphereHasTheDepthNormalAndSlopeOfItsEquation) {
  const Scene scene = ball_over_floor();
  const Tracer tracer(scene, {.robust = true});
  for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View view(Camera{"c", vec3(0.5f, 1, 4), vec3(0.25f, 0.25f, -1)},
                    {.width = 123, .height = 77, .near = 0.5, .convention = convention}, scene.bounds);
    const GBuffer g = make_gbuffer(tracer, view, kAll);
    int on_ball = 0, rim = 0;
    for (int y = 0; y < 77; ++y)
      for (int x = 0; x < 123; ++x) {
        const auto w = ball_depth(view, x + 0.5, y + 0.5);
        if (w.has_value() != (g.material(x, y) == 1u)) {
          ++rim;  // the tracer's float ray may pass on the other side of the outline
          continue;
        }
        if (!w) continue;
        ++on_ball;
        EXPECT_EQ(g.primitive(x, y), 2u);
        EXPECT_NEAR(g.depth(x, y), view.device_depth(*w), 6e-8) << x << " " << y;
        const dvec3 n = (view.eye() + *w * view.ray_direction(x + 0.5, y + 0.5) - kCenter) / kRadius;
        EXPECT_LT(glm::length(n - dvec3(g.geometric_normal(x, y))), 1e-6);
        EXPECT_EQ(g.geometric_normal(x, y), g.shading_normal(x, y));
        // Central differences of the exact depth; their error grows toward the outline.
        constexpr double kH = 1e-3;
        const auto depth = [&](double dx, double dy) {
          const auto at = ball_depth(view, x + 0.5 + dx, y + 0.5 + dy);
          return at ? view.device_depth(*at) : std::nan("");
        };
        const double slope_x = (depth(kH, 0) - depth(-kH, 0)) / (2 * kH);
        const double slope_y = (depth(0, kH) - depth(0, -kH)) / (2 * kH);
        if (glm::dot(n, glm::normalize(view.eye() - kCenter)) < 0.5) continue;
        EXPECT_NEAR(g.depth_derivatives(x, y).x, slope_x, 1e-6 * std::abs(slope_x) + 1e-9);
        EXPECT_NEAR(g.depth_derivatives(x, y).y, slope_y, 1e-6 * std::abs(slope_y) + 1e-9);
      }
    EXPECT_GT(on_ball, 900);
    EXPECT_LE(rim, 1);
  }
}

TEST(AnalyticGBuffer, AWideSceneHoldsTheSurfaceInsideItsDepthRange) {
  Scene scene = test::empty_scene();
  append_analytic(scene, analytic_sphere("ball", 0, {0, 0, -20}, 5.0));
  const Tracer tracer(scene, {});
  const View view(Camera{"c", vec3(0), vec3(0, 0, -1)}, {.width = 32, .height = 32}, scene.bounds);
  EXPECT_GE(view.far(), 25.0);
  const GBuffer g = make_gbuffer(tracer, view, kDepth);
  EXPECT_NEAR(view.view_depth_of(g.depth(16, 16)), 15.0, 0.02);
}

TEST(AnalyticGBuffer, ReflectionRaysLeaveTheSphereByTheMirrorLaw) {
  const Scene scene = ball_over_floor();
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0.5f, 1, 4), vec3(0.25f, 0.25f, -1)}, {.width = 123, .height = 77},
                  scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kPrimitive | kShadingNormal);
  const ReflectionRays r = make_reflection_rays(g, scene);
  EXPECT_EQ(r.rays.size(), g.covered_pixels);
  int on_ball = 0;
  for (size_t i = 0; i < r.rays.size(); ++i) {
    if (g.primitive[r.rays.pixel[i]] != 2u) continue;
    const double px = r.rays.pixel[i] % 123 + 0.5, py = r.rays.pixel[i] / 123 + 0.5;
    const auto w = ball_depth(view, px, py);
    if (!w) continue;
    ++on_ball;
    const dvec3 p = view.eye() + *w * view.ray_direction(px, py), n = (p - kCenter) / kRadius;
    const dvec3 v = glm::normalize(view.ray_direction(px, py));
    EXPECT_LT(glm::length(dvec3(r.rays.direction(i)) - (v - 2.0 * glm::dot(v, n) * n)), 1e-6);
    EXPECT_LT(glm::length(dvec3(r.rays.origin(i)) - p), 1e-5);
    EXPECT_GT(glm::length(dvec3(r.rays.origin(i)) - kCenter), kRadius) << "outside of the ball";
    EXPECT_NE(tracer.intersect(r.rays.origin(i), r.rays.direction(i)).primitive, 2u);
  }
  EXPECT_GT(on_ball, 900);
}

TEST(AnalyticGBuffer, ALineOfSightBesideTheSurfaceHasAPointAndNoPlane) {
  const Scene scene = ball_over_floor();
  const View view(Camera{"c", vec3(0.25f, 0.5f, 4), vec3(0.25f, 0.5f, -1)}, {.width = 100, .height = 100},
                  scene.bounds);
  EXPECT_FALSE(std::isfinite(tangent_plane(view, scene, 2, 0.5, 0.5).inverse_w));
  const dvec3 p = seen_point(view, scene, 2, 0.5, 0.5);
  EXPECT_NEAR(glm::length(p - kCenter), kRadius, 1e-12);
}

TEST(AnalyticGBuffer, AFieldHasTheDepthAndSlopeOfItsFirstZero) {
  using Shape = DistanceField::Shape;
  for (const DistanceField& field :
       {DistanceField{.shape = Shape::torus, .radius = 1.0, .thickness = 0.3, .axis = {0.6, 0.8, 0}},
        DistanceField{.shape = Shape::gyroid, .radius = 1.2, .thickness = 0.4, .period = 1.1},
        DistanceField{.shape = Shape::blob, .radius = 1.2, .thickness = 0.3}}) {
    Scene scene = test::empty_scene();
    scene.materials.push_back({});
    test::add_rectangle(scene, vec3(-5, -2, 5), vec3(10, 0, 0), vec3(0, 0, -10));
    append_analytic(scene, analytic_field("body", 1, kCenter, field));
    const Tracer tracer(scene, {.robust = true});
    const View view(Camera{"c", vec3(0.5f, 1, 4), vec3(0.25f, 0.5f, -1)},
                    {.width = 83, .height = 57, .near = 0.5}, scene.bounds);
    const GBuffer g = make_gbuffer(tracer, view, kAll);
    const auto depth_at = [&](double px, double py) {
      const dvec3 o = view.eye() - kCenter, d = view.ray_direction(px, py);
      const double length = glm::length(d);
      const auto t = test::first_sign_change([&](double a) { return value(field, o + a * (d / length)); },
                                             0.5, 12.0, 1.0 + 1e-6, 1e-10, false);
      return t ? std::optional(*t / length) : std::nullopt;
    };
    int seen = 0, other = 0, sloped = 0, bent = 0;
    for (int y = 0; y < 57; ++y)
      for (int x = 0; x < 83; ++x) {
        const auto w = depth_at(x + 0.5, y + 0.5);
        if (w.has_value() != (g.material(x, y) == 1u)) {
          ++other;
          continue;
        }
        if (!w) continue;
        ++seen;
        EXPECT_NEAR(g.depth(x, y), view.device_depth(*w), 6e-8) << label(field.shape) << x << " " << y;
        constexpr double kH = 2e-3;
        const auto left = depth_at(x + 0.5 - kH, y + 0.5), right = depth_at(x + 0.5 + kH, y + 0.5);
        const dvec3 ray = glm::normalize(view.ray_direction(x + 0.5, y + 0.5));
        if (!left || !right || std::abs(glm::dot(ray, dvec3(g.geometric_normal(x, y)))) < 0.5) continue;
        const double slope = (view.device_depth(*right) - view.device_depth(*left)) / (2 * kH);
        ++sloped;
        bent += std::abs(g.depth_derivatives(x, y).x - slope) > 1e-4 * std::abs(slope) + 1e-7;
      }
    EXPECT_GT(seen, 150) << label(field.shape);
    EXPECT_GT(sloped, 80) << label(field.shape);
    EXPECT_LE(other, 1) << label(field.shape);
    EXPECT_LE(bent, sloped / 100) << label(field.shape) << ": pixels on a crease";
  }
}

}  // namespace
}  // namespace hybray
