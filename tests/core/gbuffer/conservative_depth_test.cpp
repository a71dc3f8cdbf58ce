// Conservative depth against brute force: every triangle cut by every pixel's square, in double.
#include "core/gbuffer/conservative_depth.h"

#include "core/base/parallel.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr unsigned kBits = kDepth | kDepthDerivatives | kPrimitive;
constexpr double kFar = std::numeric_limits<double>::infinity();

// Cuts a polygon of view-space points (across, down, depth) by the plane through the eye n . p >= 0, or by
// the near plane.
std::vector<dvec3> cut_by(const std::vector<dvec3>& in, const dvec3& n, double offset = 0.0) {
  std::vector<dvec3> out;
  for (size_t i = 0; i < in.size(); ++i) {
    const dvec3 &a = in[i], &b = in[(i + 1) % in.size()];
    const double da = glm::dot(n, a) - offset, db = glm::dot(n, b) - offset;
    if (da >= 0.0) out.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) out.push_back(a + (da / (da - db)) * (b - a));
  }
  return out;
}

// Least view depth of the scene inside pixel (x, y), grown by `rim` on every side: in space, by the planes
// through the eye and the pixel's sides, which shares no step with a cut on the screen.
double nearest_in(const Scene& scene, const View& view, int x, int y, double rim) {
  const double cx = 0.5 * view.width(), cy = 0.5 * view.height(), f = view.focal();
  double nearest = kFar;
  for (const uvec3& tri : scene.triangles) {
    std::vector<dvec3> p;
    for (const uint32_t v : {tri.x, tri.y, tri.z}) {
      const dvec3 d = dvec3(scene.positions[v]) - view.eye();
      p.emplace_back(glm::dot(d, view.right()), glm::dot(d, view.down()), glm::dot(d, view.forward()));
    }
    p = cut_by(p, {0, 0, 1}, view.near());
    p = cut_by(p, {f, 0, -(x - rim - cx)});
    p = cut_by(p, {-f, 0, x + 1 + rim - cx});
    p = cut_by(p, {0, f, -(y - rim - cy)});
    p = cut_by(p, {0, -f, y + 1 + rim - cy});
    for (const dvec3& q : p) nearest = std::min(nearest, q.z);
  }
  return nearest;
}

// Triangles of every kind: large ones through the near plane, slivers, and ones smaller than a pixel.
Scene mixed_soup(uint64_t seed) {
  Scene scene = test::triangle_soup(25, 1.5f, 2.0f, seed);
  for (const auto& [count, size] : {std::pair(60u, 0.02f), {12u, 0.4f}}) {
    Scene more = test::triangle_soup(count, size, 1.5f, seed + count);
    Mesh mesh{more.positions, {}, more.triangles};
    if (size == 0.4f)  // slivers: a corner almost on the line through the other two
      for (const uvec3& t : mesh.triangles)
        mesh.positions[t.z] = 0.3f * mesh.positions[t.x] + 0.7f * mesh.positions[t.y] + vec3(2e-4f, 1e-4f, 0);
    append_mesh(scene, mesh, mat4(1.0f), 0, "more");
  }
  return scene;
}

TEST(ConservativeDepth, IsTheNearestOfAllTrianglesOverEachPixelsArea) {
  for (const uint64_t seed : {1u, 2u, 3u})
    for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed})
      for (const auto& [w, h] : {std::pair(33, 21), {64, 1}, {1, 1}}) {
        const Scene scene = mixed_soup(seed);
        const Tracer tracer(scene, {.robust = true});
        const View view(Camera{"c", vec3(0.2f, 0.3f, 1.4f), vec3(0)},
                        {.width = w, .height = h, .near = 0.2, .convention = convention}, scene.bounds);
        const GBuffer g = make_gbuffer(tracer, view, kBits);
        ConservativeDepth c;
        make_conservative_depth(g, scene, c);
        const double sign = view.depth_sign();
        // The rim of a pixel, and what the general tracer's rounding adds to it at the near plane.
        const double rim = pixel_rim(w, h) + view.focal() * 0x1p-20 * 8.0 / view.near();
        for (int y = 0; y < h; ++y)
          for (int x = 0; x < w; ++x) {
            const double least = nearest_in(scene, view, x, y, 0.0),
                         grown = nearest_in(scene, view, x, y, rim);
            const float found = c.nearest(x, y);
            if (found == view.background_depth()) {
              EXPECT_EQ(least, kFar) << x << " " << y << " seed " << seed;
              continue;
            }
            ASSERT_LT(grown, kFar) << x << " " << y << " of " << w << ", seed " << seed;
            if (least < kFar) {
              EXPECT_LE(sign * found, sign * view.device_depth(least)) << x << " " << y << " seed " << seed;
            }
            // Not nearer than the grown pixel's, but for the margins of depth and of the tracer's rounding.
            const double slack =
                2.0 * kDepthMargin + std::abs(view.device_depth(grown) - view.device_depth(grown - 0x1p-18));
            EXPECT_GE(sign * found, sign * view.device_depth(grown) - slack)
                << x << " " << y << " seed " << seed;
          }
      }
}

TEST(ConservativeDepth, ItsSlantedBoundsLieInFrontOfEverySurfacePoint) {
  const Scene scene = mixed_soup(4);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0.2f, 0.3f, 3.0f), vec3(0)}, {.width = 40, .height = 30, .near = 0.2},
                  scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kBits);
  ConservativeDepth c;
  make_conservative_depth(g, scene, c);
  const double sign = view.depth_sign();
  size_t seen = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const double px = 40.0 * random_unit(i, 0, 0, 9), py = 30.0 * random_unit(i, 1, 0, 9);
    const dvec3 ray = view.ray_direction(px, py);
    const int x = static_cast<int>(px), y = static_cast<int>(py);
    for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
      const auto w = test::exact_hit(scene, t, view.eye(), ray);
      if (!w || *w < view.near()) continue;
      ++seen;
      const vec2 d = g.depth_derivatives(x, y);
      const double bound = c.intercept(x, y) + sign * (d.x * (px - x - 0.5) + d.y * (py - y - 0.5));
      ASSERT_GE(sign * view.device_depth(*w), bound) << "seed 9, point " << i;
    }
  }
  EXPECT_GT(seen, 5000u);
}

TEST(ConservativeDepth, IsTheSameAtAnyNumberOfThreads) {
  const Scene scene = load_scene(test::scene_paths(), "atrium");
  const Tracer tracer(scene, {.robust = true});
  const View view(scene.cameras.at(0), {.width = 97, .height = 61}, scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kBits);
  ConservativeDepth one, all;
  {
    const ThreadLimit limit(1);
    make_conservative_depth(g, scene, one);
  }
  make_conservative_depth(g, scene, all);
  EXPECT_TRUE(std::equal(one.nearest.begin(), one.nearest.end(), all.nearest.begin()));
  EXPECT_TRUE(std::equal(one.intercept.begin(), one.intercept.end(), all.intercept.begin()));
  EXPECT_TRUE(std::equal(one.origin_clear.begin(), one.origin_clear.end(), all.origin_clear.begin()));
  EXPECT_EQ(one.pixels_touched, all.pixels_touched);
}

}  // namespace
}  // namespace hybray
