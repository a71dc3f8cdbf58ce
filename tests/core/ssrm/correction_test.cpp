// The slanted-plane correction against closed forms.
#include "core/ssrm/correction.h"

#include "core/metrics/verdict_table.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

// Rounding of a claimed distance, metres: the gap to the plane is a sum of terms each known to relative 2^-24
// (stored depth, slopes, ray), and the distance follows from it at the rate dt / d(gap).
double rounding_of(const test::MainView& v, size_t i, uint32_t pixel, double claimed) {
  const auto ray = v.screen_rays.get<double>(i);
  const View& view = v.gbuffer.view;
  const PlaneGap gap = plane_gap(v.depth(), ray, static_cast<int>(pixel) % view.width(),
                                 static_cast<int>(pixel) / view.width());
  const double l = gap.crossing(), step = 1e-6 * l;
  const double dt =
      (distance_of(v.rays, i, view, l + step) - distance_of(v.rays, i, view, l - step)) / (2.0 * step);
  const vec2 d = v.gbuffer.depth_derivatives[pixel];
  const double terms =
      std::abs(ray.oz) + std::abs(l * ray.dz) + std::abs(d.x) * (std::abs(ray.ox) + std::abs(l * ray.dx)) +
      std::abs(d.y) * (std::abs(ray.oy) + std::abs(l * ray.dy)) + std::abs(v.gbuffer.depth[pixel]);
  return 0x1p-24 * (4.0 * terms * std::abs(dt / gap.slope) + 8.0 * std::abs(claimed));
}

// Compares every HIT with the nearest crossing of the scene's (unbounded) rectangles. Pixels next to one of
// another rectangle are left out.
void expect_float_accuracy(const Scene& scene, const Camera& camera, int width, int height,
                           size_t least_hits) {
  const Tracer tracer(scene, {.robust = true});
  for (DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View view(camera, {.width = width, .height = height, .near = 0.1, .convention = convention},
                    scene.bounds);
    const test::MainView v(tracer, view);
    const MarchResults results = v.march();
    size_t hits = 0;
    double worst = 0.0;
    for (size_t i = 0; i < v.rays.size(); ++i) {
      if (results.verdict[i] != Verdict::hit) continue;
      const int x = static_cast<int>(results.pixel[i]) % width,
                y = static_cast<int>(results.pixel[i]) / width;
      const uint32_t wall = v.gbuffer.primitive(x, y) / 2;  // two triangles a rectangle
      bool edge = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = std::clamp(x + dx, 0, width - 1), ny = std::clamp(y + dy, 0, height - 1);
          edge |= v.gbuffer.primitive(nx, ny) == kNoPrimitive || v.gbuffer.primitive(nx, ny) / 2 != wall;
        }
      if (edge) continue;
      const auto exact =
          test::exact_hit(scene, 2 * wall, dvec3(v.rays.origin(i)), dvec3(v.rays.direction(i)), 1e30);
      ASSERT_TRUE(exact.has_value());
      const double claimed = plane_distance(v.depth(), v.screen_rays, v.rays, view, i, results.pixel[i]);
      const double error = std::abs(claimed - *exact), bound = rounding_of(v, i, results.pixel[i], claimed);
      EXPECT_LE(error, bound) << "ray " << i << " claimed " << claimed << " exact " << *exact;
      worst = std::max(worst, error / *exact);
      ++hits;
    }
    EXPECT_GE(hits, least_hits);
    EXPECT_LT(worst, 2e-3) << "the bound itself must stay far below a pixel";
  }
}

TEST(Correction, IsFloatAccurateForAMirrorFloorFacingAWall) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, 0), vec3(0, 12, 0));
  expect_float_accuracy(scene, Camera{"c", vec3(0.3f, 2.0f, 3.5f), vec3(0, 1.5f, -8)}, 320, 200, 5000);
}

TEST(Correction, IsFloatAccurateInACornerOfThreeWalls) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-6, 0, 6), vec3(12, 0, 0), vec3(0, 0, -12));
  test::add_rectangle(scene, vec3(-6, 0, -6), vec3(12, 0, 0), vec3(0, 8, 0));
  test::add_rectangle(scene, vec3(-6, 0, 6), vec3(0, 0, -12), vec3(0, 8, 0));
  expect_float_accuracy(scene, Camera{"c", vec3(3.5f, 2.5f, 4.5f), vec3(-6, 1.5f, -6)}, 320, 200, 5000);
}

// An analytic sphere above a floor: exact depths and tangent planes at pixel centres, no tessellation in the
// way.
struct SphereView {
  View view;
  dvec3 center{0.2, 1.1, -3.0};
  double radius = 1.0;
  Image2D<float> depth;
  Image2D<vec2> derivatives;
  DepthPyramid pyramid;

  SphereView(int width, int height)
      : view(Camera{"c", vec3(0, 1.2f, 2.0f), vec3(0.2f, 0.6f, -3)},
             {.width = width, .height = height, .near = 0.1, .far = 50.0}, Bounds3{vec3(-8), vec3(8)}),
        depth(width, height, 0.0f),
        derivatives(width, height),
        pyramid(width, height) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (const auto t = sphere_hit(view.eye(), view.ray_direction(x + 0.5, y + 0.5))) {
          const dvec3 p = view.eye() + *t * view.ray_direction(x + 0.5, y + 0.5), n = p - center;
          const double distance = glm::dot(n, p - view.eye());
          depth(x, y) = static_cast<float>(view.device_depth(*t));
          derivatives(x, y) = vec2(dvec2(glm::dot(n, view.right()), glm::dot(n, view.down())) *
                                   (view.depth_b() / (distance * view.focal())));
        }
    pyramid.build(depth, view.depth_sign(), view.background_depth());
  }

  std::optional<double> sphere_hit(const dvec3& o, const dvec3& d) const {
    const dvec3 s = o - center;
    const double a = glm::dot(d, d), b = glm::dot(s, d), c = glm::dot(s, s) - radius * radius,
                 q = b * b - a * c;
    if (q < 0.0 || -b - std::sqrt(q) < 0.0) return std::nullopt;
    return (-b - std::sqrt(q)) / a;
  }
};

// Median relative error of the claimed distance of rays mirrored by the floor y = 0 up to the sphere.
double median_sphere_error(int height) {
  const SphereView s(height * 16 / 9, height);
  RayStream rays;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < s.view.width(); ++x) {
      const dvec3 d = s.view.ray_direction(x + 0.5, y + 0.5);
      if (s.depth(x, y) != 0.0f || d.y >= 0.0) continue;
      const dvec3 p = s.view.eye() - d * (s.view.eye().y / d.y);
      rays.resize(rays.size() + 1);
      rays.set(rays.size() - 1, vec3(p), glm::normalize(vec3(dvec3(d.x, -d.y, d.z))),
               static_cast<uint32_t>(y * s.view.width() + x));
    }
  const ScreenRays screen = project_rays(rays, s.view, Bounds3{vec3(-8), vec3(8)});
  const DepthView depth{s.pyramid, s.derivatives, s.view.depth_sign()};
  MarchResults results;
  results.resize(rays.size());
  march(depth, screen, rays.pixel, {}, results);
  std::vector<double> errors;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (results.verdict[i] != Verdict::hit) continue;
    const auto exact = s.sphere_hit(dvec3(rays.origin(i)), dvec3(rays.direction(i)));
    if (!exact) continue;
    errors.push_back(
        std::abs(plane_distance(depth, screen, rays, s.view, i, results.pixel[i]) / *exact - 1.0));
  }
  EXPECT_GT(errors.size(), rays.size() / 50);
  std::nth_element(errors.begin(), errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

TEST(Correction, ErrorOnAnAnalyticSphereFallsWithTheSquareOfThePixelSize) {
  std::vector<double> log_pixel, log_error;
  for (int height : {60, 120, 240, 480}) {
    log_pixel.push_back(-std::log(static_cast<double>(height)));
    log_error.push_back(std::log(median_sphere_error(height)));
  }
  double mx = 0.0, my = 0.0, sxy = 0.0, sxx = 0.0;
  for (size_t i = 0; i < 4; ++i) mx += log_pixel[i] / 4.0, my += log_error[i] / 4.0;
  for (size_t i = 0; i < 4; ++i)
    sxy += (log_pixel[i] - mx) * (log_error[i] - my), sxx += (log_pixel[i] - mx) * (log_pixel[i] - mx);
  EXPECT_NEAR(sxy / sxx, 2.0, 0.2);
}

// A single pixel column of known planes, looked at by hand-made rays.
TEST(Correction, DistinguishesPassesBehindAndOtherFailures) {
  DepthPyramid pyramid(4, 1);
  Image2D<float> depth(4, 1, 0.5f);
  Image2D<vec2> derivatives(4, 1);
  derivatives(2, 0) = vec2(0.2f, 0.0f);  // plane from 0.4 at x = 2 to 0.6 at x = 3
  pyramid.build(depth, 1, 1.0f);
  const DepthView view{pyramid, derivatives, 1};
  const auto ray = [](double z_at_2, double z_at_3) {  // enters pixel 2 at l = 2, leaves at l = 3
    return ScreenRay<double>{
        0.0, 0.5, z_at_2 - 2 * (z_at_3 - z_at_2), 1.0, 0x1p-126, z_at_3 - z_at_2, 100.0, Verdict::miss};
  };
  const ivec2 pixel(2, 0), previous(1, 0), origin(0, 0);
  EXPECT_EQ(correct(view, ray(0.3, 0.7), pixel, previous, origin).verdict, Verdict::hit);
  EXPECT_EQ(correct(view, ray(0.3, 0.7), pixel, previous, origin).pixel, 2u);
  EXPECT_EQ(correct(view, ray(0.3, 0.55), pixel, previous, origin).verdict, Verdict::correction)
      << "in front all along";
  EXPECT_EQ(correct(view, ray(0.75, 0.8), pixel, previous, origin).verdict, Verdict::behind);
  // Behind pixel 2 where it enters, but it crossed the flat pixel 1 before: 0.45 at x = 1, 0.55 at x = 2.
  EXPECT_EQ(correct(view, ray(0.55, 0.65), pixel, previous, origin).pixel, 1u);
  EXPECT_EQ(correct(view, ray(0.55, 0.65), pixel, previous, previous).verdict, Verdict::behind)
      << "never the origin's pixel";
}

}  // namespace
}  // namespace hybray::ssrm
