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

TEST(DearScenes, HaveTheWantedNumberOfSoundTriangles) {
  for (const Make make : {Make(foliage)})
    for (const uint32_t wanted : {uint32_t{1} << 13, uint32_t{1} << 16}) {
      const Scene scene = make({wanted, 1});
      EXPECT_NEAR(static_cast<double>(scene.triangle_count()), wanted, 0.03 * wanted) << scene.name;
      test::expect_sound_triangles(scene);
    }
}

TEST(DearScenes, AreTheSameForTheSameParametersAndOthersForAnotherSeed) {
  for (const Make make : {Make(foliage)}) {
    const uint32_t count = 1u << 13;
    EXPECT_EQ(make({count, 1}).content_hash, make({count, 1}).content_hash);
    EXPECT_NE(make({count, 1}).content_hash, make({count, 2}).content_hash);
  }
}

TEST(DearScenes, HaveCamerasInsideThatSeeTheirDearPrimitives) {
  for (const Make make : {Make(foliage)}) {
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
        dear += scene.is_analytic(hit.primitive) || scene.is_cut_out(hit.primitive);
      }
      EXPECT_GT(hits, 1000) << scene.name << " " << camera.name;
      EXPECT_GT(dear, 150) << scene.name << " " << camera.name;
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

}  // namespace
}  // namespace hybray::procedural
