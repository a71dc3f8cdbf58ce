// What a light sees, against single rays.
#include "core/gbuffer/light_buffer.h"

#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

namespace hybray {
namespace {

Scene soup_and_ball() {
  Scene scene = test::triangle_soup(400, 0.7f, 3.0f, 5);
  append_analytic(scene, analytic_sphere("ball", 0, dvec3(0.5, -1.0, 0.3), 1.1));
  update_content_hash(scene);
  return scene;
}

Light light_of(LightKind kind) {
  Light light;
  light.kind = kind;
  light.position = vec3(0.2f, 4.0f, -0.3f);
  light.direction = glm::normalize(vec3(0.1f, -1.0f, 0.2f));
  light.outer_cone_angle = 0.6f;
  return light;
}

TEST(LightBuffer, HoldsWhatSingleRaysThroughTheCentresMeet) {
  const Scene scene = soup_and_ball();
  const Tracer tracer(scene, {.robust = true, .high_quality = false});
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional})
    for (const LightFrame& frame : light_frames(light_of(kind), {&scene.bounds, 1}, scene.bounds, 45)) {
      const LightBuffer buffer = make_light_buffer(tracer, frame);
      EXPECT_EQ(buffer.traced, frame.texels());
      int different = 0, seen = 0;
      for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
          const Hit hit = tracer.intersect(vec3(frame.ray_origin(x + 0.5, y + 0.5)),
                                           vec3(frame.ray_direction(x + 0.5, y + 0.5)));
          const LightTexel& texel = buffer.texels(x, y);
          // Packets may round an edge the other way.
          if (hit.primitive != texel.primitive) {
            ++different;
            continue;
          }
          if (!hit.valid()) {
            EXPECT_TRUE(std::isinf(texel.distance));
            continue;
          }
          ++seen;
          EXPECT_NEAR(texel.distance, hit.t, 1e-4f);
          EXPECT_NEAR(texel.u, hit.u, 1e-3f);
          EXPECT_NEAR(texel.v, hit.v, 1e-3f);
        }
      EXPECT_LE(different, 1);
      if (frame.forward.y < -0.5) {
        EXPECT_GT(seen, 300);
      }
    }
}

TEST(LightBuffer, TracesMarkedTilesAloneAndCountsTheirTexels) {
  const Scene scene = soup_and_ball();
  const Tracer tracer(scene, {.robust = true, .high_quality = false});
  // 45 texels: six tiles a side, the last one 5 texels wide.
  const LightFrame frame =
      light_frames(light_of(LightKind::directional), {&scene.bounds, 1}, scene.bounds, 45)[0];
  const LightBuffer full = make_light_buffer(tracer, frame);
  std::vector<uint8_t> tiles(36, 0);
  for (const size_t tile : {7u, 14u, 17u, 32u, 35u}) tiles[tile] = 1;
  const LightBuffer part = make_light_buffer(tracer, frame, tiles);
  EXPECT_EQ(part.traced, 64u + 64u + 40u + 40u + 25u);
  int copied = 0;
  for (int y = 0; y < 45; ++y)
    for (int x = 0; x < 45; ++x) {
      const bool marked = tiles[static_cast<size_t>(y / kMortonTile * 6 + x / kMortonTile)];
      EXPECT_EQ(part.texels(x, y).primitive, marked ? full.texels(x, y).primitive : kNoPrimitive);
      copied += marked && full.texels(x, y).primitive != kNoPrimitive;
    }
  EXPECT_GT(copied, 100);
  const LightBuffer none = make_light_buffer(tracer, frame, std::vector<uint8_t>(36, 0));
  EXPECT_EQ(none.traced, 0u);
}

TEST(LightBuffer, IsTheSameAtAnyNumberOfThreads) {
  const Scene scene = soup_and_ball();
  const Tracer tracer(scene, {.robust = true, .high_quality = false});
  const LightFrame frame = light_frames(light_of(LightKind::spot), {&scene.bounds, 1}, scene.bounds, 100)[0];
  const LightBuffer many = make_light_buffer(tracer, frame);
  const ThreadLimit limit(1);
  const LightBuffer one = make_light_buffer(tracer, frame);
  ASSERT_EQ(one.texels.values().size(), many.texels.values().size());
  EXPECT_EQ(
      std::memcmp(one.texels.values().data(), many.texels.values().data(), one.texels.values().size_bytes()),
      0);
}

}  // namespace
}  // namespace hybray
