#include "core/ssrm/confirm_hits.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

// Small triangles at random, so that many HITs lie on a plane beyond its triangle.
struct Soup {
  Scene scene = test::triangle_soup(400, 0.6f, 2.0f, 33);
  Tracer tracer{scene, {.robust = true, .layers = true}};
  View view{Camera{"c", vec3(0, 0.3f, 5), vec3(0)}, {.width = 240, .height = 160, .near = 0.5}, scene.bounds};
  test::MainView main{tracer, view};
  DepthLayers layers = make_depth_layers(tracer, main.gbuffer, 3);

  LayeredView layered() const { return {main.depth(), main.gbuffer.primitive, layers}; }
  LayerResults march() const {
    LayerResults results;
    results.resize(main.rays.size());
    march_layers(layered(), main.screen_rays, main.rays.pixel, {.free_space = FreeSpace::any}, results);
    return results;
  }
  double claimed(const LayerResults& results, size_t i) const {
    const int pixel = static_cast<int>(results.march.pixel[i]);
    return plane_distance(layered().plane(results.layer[i], pixel % 240, pixel / 240), main.depth(),
                          main.screen_rays, main.rays, view, i, results.march.pixel[i]);
  }
  // Whether the ray meets any of `triangles` (all: none given) within `share` of `distance`, by brute force.
  bool meets(size_t i, double distance, double share, const std::set<uint32_t>& triangles = {}) const {
    for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
      if (!triangles.empty() && !triangles.contains(t)) continue;
      const auto hit =
          test::exact_hit(scene, t, dvec3(main.rays.origin(i)), dvec3(main.rays.direction(i)), 1e-4);
      if (hit && std::abs(*hit - distance) <= share * distance) return true;
    }
    return false;
  }
};

TEST(ConfirmHits, KeepsWhatMeetsATriangleThereAndNothingThatMeetsNone) {
  const Soup soup;
  const LayerResults before = soup.march();
  LayerResults after = before;
  const uint64_t taken_back =
      confirm_late_hits(soup.layered(), soup.view, soup.scene, soup.main.rays, soup.main.screen_rays, after);
  uint64_t gone = 0, kept = 0;
  for (size_t i = 0; i < before.march.size(); ++i) {
    const bool was_late = before.march.verdict[i] == Verdict::hit && before.late[i];
    if (!was_late) {
      ASSERT_EQ(after.march.verdict[i], before.march.verdict[i]);
      ASSERT_EQ(after.march.pixel[i], before.march.pixel[i]);
      continue;
    }
    const double distance = soup.claimed(before, i);
    if (after.march.verdict[i] == Verdict::hit) {
      ++kept;
      EXPECT_TRUE(soup.meets(i, distance, 1.01 * kConfirmed)) << "kept without a triangle, ray " << i;
      continue;
    }
    ++gone;
    EXPECT_EQ(after.march.verdict[i], Verdict::correction);
    EXPECT_EQ(after.march.pixel[i], kNoPixel);
    // The one that the HIT names was not met, or it would have been kept.
    const uint32_t named = soup.layered().primitive_of(before.layer[i], before.march.pixel[i]);
    EXPECT_FALSE(soup.meets(i, distance, 0.99 * kConfirmed, {named})) << "ray " << i;
  }
  EXPECT_EQ(gone, taken_back);
  EXPECT_GT(gone, 50u);
  EXPECT_GT(kept, 500u);
}

TEST(ConfirmHits, ASecondLookTakesNothingMoreBack) {
  const Soup soup;
  LayerResults results = soup.march();
  confirm_late_hits(soup.layered(), soup.view, soup.scene, soup.main.rays, soup.main.screen_rays, results);
  EXPECT_EQ(confirm_late_hits(soup.layered(), soup.view, soup.scene, soup.main.rays, soup.main.screen_rays,
                              results),
            0u);
}

}  // namespace
}  // namespace hybray::ssrm
