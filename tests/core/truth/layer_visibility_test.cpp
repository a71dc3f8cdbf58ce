#include "core/truth/layer_visibility.h"

#include "tests/core/test_scenes.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

struct Probe {
  vec3 origin, direction;
};

std::vector<uint8_t> layers_of(const Tracer& tracer, const View& view, const std::vector<Probe>& probes,
                               int layers) {
  RayStream rays;
  rays.resize(probes.size());
  for (size_t i = 0; i < probes.size(); ++i)
    rays.set(i, probes[i].origin, glm::normalize(probes[i].direction), 0);
  HitStream hits;
  hits.resize(rays.size());
  tracer.trace(rays, hits, TraceMode::single);
  return layers_of_hits(tracer, rays, hits, view, layers);
}

// Sheets at z = -2, -4 and -6, seen from the origin along -z.
TEST(LayerVisibility, CountsTheSheetsBetweenTheEyeAndTheHit) {
  Scene scene = test::empty_scene();
  for (const float z : {-2.0f, -4.0f, -6.0f})
    test::add_rectangle(scene, vec3(-50, -50, z), vec3(100, 0, 0), vec3(0, 100, 0));
  const Tracer tracer(scene, {.robust = true, .layers = true});
  const View view(Camera{"c", vec3(0), vec3(0, 0, -1)}, {.width = 64, .height = 64}, scene.bounds);
  const vec3 away(0.1f, 0.05f, -1), back(0.1f, 0.05f, 1);
  const std::vector<Probe> probes = {
      {vec3(0.1f, 0, -1), away},      // the first sheet
      {vec3(0.1f, 0, -3), back},      // the same, from behind
      {vec3(0.1f, 0, -3), away},      // the second
      {vec3(0.1f, 0, -5), back},      // the second, from behind
      {vec3(0.1f, 0, -5), away},      // the third
      {vec3(0.1f, 0, -7), away},      // nothing
      {vec3(30.0f, 0, -3), away},     // the second, beside the view
      {vec3(0.1f, 0, -1), {1, 0, 0}}  // nothing
  };
  EXPECT_EQ(layers_of(tracer, view, probes, 3),
            (std::vector<uint8_t>{0, 0, 1, 1, 2, kNotSeen, kNotSeen, kNotSeen}));
  EXPECT_EQ(layers_of(tracer, view, probes, 2),
            (std::vector<uint8_t>{0, 0, 1, 1, kNotSeen, kNotSeen, kNotSeen, kNotSeen}));
}

// Against a count by brute force, in double, of the triangles on the line of sight.
TEST(LayerVisibility, CountsWhatBruteForceCounts) {
  const Scene scene = test::triangle_soup(120, 1.0f, 2.0f, 9);
  const Tracer tracer(scene, {.robust = true, .layers = true});
  const View view(Camera{"c", vec3(0, 0, 6), vec3(0)}, {.width = 64, .height = 64, .near = 0.5},
                  scene.bounds);
  constexpr uint64_t kSeed = 4;
  std::vector<Probe> probes;
  for (uint64_t i = 0; i < 3000; ++i) {
    const auto unit = [&](uint32_t d) { return static_cast<float>(2.0 * random_unit(i, d, 0, kSeed) - 1.0); };
    probes.push_back({2.0f * vec3(unit(0), unit(1), unit(2)), vec3(unit(3), unit(4), unit(5) + 1e-3f)});
  }
  for (const int layers : {1, 3, 8}) {
    const std::vector<uint8_t> found = layers_of(tracer, view, probes, layers);
    size_t different = 0, seen = 0;
    for (size_t i = 0; i < probes.size(); ++i) {
      const dvec3 o(probes[i].origin), d(glm::normalize(probes[i].direction));
      double nearest = 1e30;
      for (uint32_t t = 0; t < scene.triangle_count(); ++t)
        nearest = std::min(nearest, test::exact_hit(scene, t, o, d).value_or(1e30));
      uint8_t expected = kNotSeen;
      if (nearest < 1e30) {
        const dvec3 point = o + nearest * d;
        const dvec2 p = view.project(point);
        const bool inside = p.x >= 0 && p.x < 64 && p.y >= 0 && p.y < 64 && view.view_depth(point) > 0.5;
        const dvec3 sight = glm::normalize(point - view.eye());
        const double length = glm::distance(point, view.eye());
        int between = 0;
        for (uint32_t t = 0; t < scene.triangle_count(); ++t)
          between += test::exact_hit(scene, t, view.eye(), sight).value_or(1e30) <
                     length * (1.0 - kVisibilityTolerance);
        if (inside && between < layers) expected = static_cast<uint8_t>(between);
      }
      different += found[i] != expected;
      seen += expected != kNotSeen;
    }
    // Points within the tolerance of another triangle, or rays within rounding of an edge.
    EXPECT_LE(different, 3u) << layers;
    EXPECT_GT(seen, 300u);
  }
}

}  // namespace
}  // namespace hybray::truth
