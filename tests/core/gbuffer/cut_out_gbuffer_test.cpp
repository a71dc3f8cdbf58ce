// Cut-outs in the G-buffer.
#include "core/gbuffer/gbuffer.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(CutOutGBuffer, GapsOfACutOutShowWhatIsBehindThem) {
  Scene scene = test::empty_scene();
  scene.materials.push_back({});
  scene.materials[1].cut_out = CutOut::fern;
  test::add_rectangle(scene, vec3(-2, -2, -1), vec3(4, 0, 0), vec3(0, 4, 0));  // behind
  Mesh leaf;
  leaf.positions = {vec3(-1, -1, 0), vec3(1, -1, 0), vec3(-1, 1, 0)};
  leaf.triangles = {uvec3(0, 1, 2)};
  append_mesh(scene, leaf, mat4(1.0f), 1, "leaf");
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 3), vec3(0)}, {.width = 120, .height = 120}, scene.bounds);
  const GBuffer g = make_gbuffer(tracer, view, kDepth | kPrimitive);
  int there = 0, gaps = 0, wrong = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const dvec3 d = view.ray_direction(x + 0.5, y + 0.5), p = view.eye() - (view.eye().z / d.z) * d;
      const double u = 0.5 * (p.x + 1.0), v = 0.5 * (p.y + 1.0);
      if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
      const bool expected = is_there(CutOut::fern, u, v);
      (expected ? there : gaps) += 1;
      wrong += (g.primitive(x, y) == 2u) != expected;
      if (g.primitive(x, y) == 2u) {
        EXPECT_NEAR(g.depth(x, y), view.device_depth(3.0), 1e-7);
      }
      if (g.primitive(x, y) < 2u) {
        EXPECT_NEAR(g.depth(x, y), view.device_depth(4.0), 1e-7);
      }
    }
  EXPECT_GT(there, 500);
  EXPECT_GT(gaps, 500);
  EXPECT_LE(wrong, 1) << "pixel centres within float rounding of a rim: 3000 x 30 x 1e-6";
}

}  // namespace
}  // namespace hybray
