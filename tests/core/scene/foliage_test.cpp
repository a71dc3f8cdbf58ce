// The scenes whose rays are dear: what they are made of, and their cameras.
#include "core/scene/procedural/generators.h"
#include "core/tracer/tracer.h"
#include "tests/core/scene/sound_mesh.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace hybray::procedural {
namespace {

using Make = Scene (*)(const Parameters&);

TEST(DearScenes, HaveTheWantedNumberOfPrimitivesAndSoundTriangles) {
  for (const Make make : {Make(foliage), Make(meadow), Make(sculptures)})
    for (const uint32_t wanted : {uint32_t{1} << 13, uint32_t{1} << 16}) {
      const Scene scene = make({wanted, 1});
      EXPECT_NEAR(static_cast<double>(scene.primitive_count()), wanted, 0.03 * wanted) << scene.name;
      test::expect_sound_triangles(scene);
    }
}

TEST(DearScenes, AreTheSameForTheSameParametersAndOthersForAnotherSeed) {
  for (const Make make : {Make(foliage), Make(meadow), Make(sculptures)}) {
    const uint32_t count = 1u << 13;
    EXPECT_EQ(make({count, 1}).content_hash, make({count, 1}).content_hash);
    EXPECT_NE(make({count, 1}).content_hash, make({count, 2}).content_hash);
  }
}

TEST(DearScenes, HaveCamerasInsideThatSeeTheirDearPrimitives) {
  // Of 2000 directions: how many meet something, and something dear. The meadow has no walls, the court no
  // roof.
  struct Case {
    Make make;
    int hits, dear;
  };
  for (const auto& [make, least_hits, least_dear] :
       {Case{foliage, 1000, 150}, {meadow, 650, 150}, {sculptures, 1000, 40}}) {
    const Scene scene = make({});
    const Tracer tracer(scene, {});
    EXPECT_GE(scene.cameras.size(), 4u);
    for (const Camera& camera : scene.cameras) {
      int hits = 0, dear = 0, near = 0;
      for (int i = 0; i < 2000; ++i) {
        const double y = 1.0 - 2.0 * (i + 0.5) / 2000, r = std::sqrt(1.0 - y * y), a = 2.399963229728653 * i;
        const vec3 d(dvec3(r * std::cos(a), y, r * std::sin(a)));
        const Hit hit = tracer.intersect(camera.eye, d);
        if (!hit.valid()) continue;
        ++hits, near += hit.t < 0.2f;
        dear += !scene.is_triangle(hit.primitive) || scene.is_cut_out(hit.primitive);
      }
      EXPECT_GT(hits, least_hits) << scene.name << " " << camera.name;
      EXPECT_GT(dear, least_dear) << scene.name << " " << camera.name;
      EXPECT_LT(near, 10) << scene.name << " " << camera.name;
    }
  }
}

// A leaf's two triangles name its midrib as their second and third vertex, one of them the other way round.
TEST(Foliage, LeavesAreTrianglesThatShareTheirMidrib) {
  const Scene scene = foliage({1u << 14, 1});
  size_t leaves = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    if (!scene.is_cut_out(t)) continue;
    ASSERT_TRUE(scene.is_cut_out(t + 1));
    const uvec3 &left = scene.triangles[t], &right = scene.triangles[t + 1];
    EXPECT_EQ(scene.positions[left.y], scene.positions[right.z]);
    EXPECT_EQ(scene.positions[left.z], scene.positions[right.y]);
    ++leaves, ++t;
  }
  EXPECT_GT(2 * leaves, scene.triangle_count() / 2);
}

// append_curve() has checked each of them by itself.
TEST(Meadow, ItsCurvesStandInTheGroundAndAreMostOfIt) {
  const Scene scene = meadow({});
  EXPECT_GT(2 * scene.curves.size(), scene.primitive_count());
  const Tracer tracer(scene, {.robust = true});
  size_t rooted = 0;
  for (const RoundCurve& curve : scene.curves) {
    const vec3 foot(curve.control[0]), tip(curve.control[3]);
    EXPECT_GT(tip.y, foot.y);
    // From the sky, the ground lies above the foot, and so hides it.
    for (float from = 10.0f;;) {
      const Hit hit = tracer.intersect(vec3(foot.x, from, foot.z), vec3(0, -1, 0));
      if (!hit.valid()) break;
      from -= hit.t;
      if (scene.is_triangle(hit.primitive)) {
        rooted += from > foot.y - 0.005f;
        break;
      }
      from -= 1e-5f;
    }
  }
  EXPECT_GT(rooted, scene.curves.size() * 99 / 100);
}

}  // namespace
}  // namespace hybray::procedural
