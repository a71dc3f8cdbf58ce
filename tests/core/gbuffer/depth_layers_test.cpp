#include "core/gbuffer/depth_layers.h"

#include "tests/core/test_scenes.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 7;

// All triangles that the ray through a pixel centre meets, nearest first, by brute force in double.
std::vector<std::pair<double, uint32_t>> all_hits(const Scene& scene, const View& view, int x, int y,
                                                  double slack) {
  std::vector<std::pair<double, uint32_t>> hits;
  for (uint32_t i = 0; i < scene.triangles.size(); ++i)
    if (const auto w = test::exact_hit(scene, i, view.eye(), view.ray_direction(x + 0.5, y + 0.5), slack))
      if (*w >= view.near()) hits.emplace_back(*w, i);
  std::sort(hits.begin(), hits.end());
  return hits;
}

TEST(DepthLayers, AreTheSurfacesAlongEachPixelsRayInTheirOrder) {
  const Scene scene = test::triangle_soup(60, 1.5f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true, .layers = true});
  const View view(Camera{"c", vec3(0, 0, 5), vec3(0)}, {.width = 61, .height = 37}, scene.bounds);
  const GBuffer first = make_gbuffer(tracer, view, kDepth | kDepthDerivatives | kPrimitive);
  const DepthLayers layers = make_depth_layers(tracer, first, 5);
  int compared = 0;
  for (int y = 0; y < 37; ++y)
    for (int x = 0; x < 61; ++x) {
      const auto hits = all_hits(scene, view, x, y, 0.0);
      // Rays within rounding of an edge may go either way.
      if (hits.size() != all_hits(scene, view, x, y, 1e-5).size() ||
          hits.size() != all_hits(scene, view, x, y, -1e-5).size())
        continue;
      for (size_t k = 0; k < 5; ++k) {
        const uint32_t got = k == 0 ? first.primitive(x, y) : layers.further[k - 1].primitive(x, y);
        ASSERT_EQ(got, k < hits.size() ? hits[k].second : kNoPrimitive)
            << x << "," << y << " layer " << k << " seed " << kSeed;
        if (k >= hits.size()) continue;
        const GBuffer& g = k == 0 ? first : layers.further[k - 1];
        // A float of device depth: half an ulp of 1 at most.
        EXPECT_NEAR(g.depth(x, y), view.device_depth(hits[k].first), 0x1p-24 * 1.001);
        const uvec3& tri = scene.triangles[got];
        const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
        const bool front = glm::dot(glm::cross(b - a, c - a), view.ray_direction(x + 0.5, y + 0.5)) < 0.0;
        EXPECT_EQ(layers.shows_front(static_cast<size_t>(y * 61 + x), static_cast<int>(k)), front);
        ++compared;
      }
    }
  EXPECT_GT(compared, 1000);
}

TEST(DepthLayers, CoincidentSurfacesEachHaveTheirLayer) {
  Scene scene = test::empty_scene();
  for (int i = 0; i < 4; ++i)
    test::add_rectangle(scene, vec3(-19.3f, -27.7f, 0), vec3(40, 0, 0), vec3(0, 44, 0));
  test::add_rectangle(scene, vec3(-19.3f, -27.7f, -2), vec3(40, 0, 0), vec3(0, 44, 0));
  const Tracer tracer(scene, {.robust = true, .layers = true});
  // No pixel centre lies on a diagonal, where both triangles of a quad may be hit.
  const View view(Camera{"c", vec3(0.1f, 0.2f, 5), vec3(0)}, {.width = 33, .height = 17}, scene.bounds);
  const GBuffer first = make_gbuffer(tracer, view, kDepth | kDepthDerivatives | kPrimitive);
  const DepthLayers layers = make_depth_layers(tracer, first, 6);
  for (size_t p = 0; p < first.primitive.size(); ++p) {
    std::set<uint32_t> quads{first.primitive[p] / 2};
    for (int k = 0; k < 3; ++k) quads.insert(layers.further[k].primitive[p] / 2);
    EXPECT_EQ(quads, (std::set<uint32_t>{0, 1, 2, 3})) << p;
    EXPECT_EQ(layers.further[3].primitive[p] / 2, 4u) << p;
    EXPECT_EQ(layers.further[4].primitive[p], kNoPrimitive) << p;
  }
}

}  // namespace
}  // namespace hybray
