// Which texels a map holds, the flux that they stand for, and what drops out.
#include "core/caustics/visibility_map.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

constexpr double kPi = std::numbers::pi;

Light spot_light(const vec3& position, const vec3& direction, float inner, float outer, float intensity) {
  Light light = point_light(position, intensity);
  light.kind = LightKind::spot;
  light.direction = glm::normalize(direction);
  light.inner_cone_angle = inner, light.outer_cone_angle = outer;
  return light;
}

Light sun(const vec3& direction, float irradiance) {
  Light light = point_light(vec3(0.0f), irradiance);
  light.kind = LightKind::directional;
  light.direction = glm::normalize(direction);
  return light;
}

// A ball of radius 1 with centre (0, 1.5, 0) over a floor, under `light`.
Scene ball_scene(const Material& material, const Light& light) {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.5f));
  const uint32_t m = add_material(scene, material);
  add_floor(scene, 4.0f);
  append_analytic(scene, analytic_sphere("ball", m, dvec3(0.0, 1.5, 0.0), 1.0));
  scene.lights.push_back(light);
  update_content_hash(scene);
  return scene;
}

VisibilityMap map_of(const Prepared& p, int resolution, uint32_t light = 0) {
  return make_visibility_map(p.tracer, p.caustic.optics, p.caustic.targets, light, resolution);
}

// Half the width of a 4.5 sigma interval of a disc's area counted by texel centres, in texels, for a disc
// `diameter` texels wide: each of its columns ends at two places that fall anywhere within a texel, with
// variance 1/12 each.
double border_error(double diameter) {
  return 4.5 * std::sqrt(diameter * 2.0 / 12.0);
}

TEST(VisibilityMap, CoversTheSolidAngleOfABallFromAPointLight) {
  const Prepared p(
      ball_scene(mirror(vec3(1.0f)), point_light(vec3(0.0f, 5.5f, 0.0f), 20.0f, vec3(1.0f, 0.5f, 0.0f))));
  const double angle = std::asin(1.0 / 4.0);
  const double expected = 20.0 * 0.5 * 2.0 * kPi * (1.0 - std::cos(angle));
  for (const int resolution : {64, 256, 1024}) {
    const VisibilityMap map = map_of(p, resolution);
    const double texels_across = 2.0 * std::tan(angle) * resolution / 2.0;
    const double texel_flux = 20.0 * 0.5 * 4.0 / (static_cast<double>(resolution) * resolution);
    EXPECT_NEAR(map.covered_flux, expected, border_error(texels_across) * texel_flux) << resolution;
    ASSERT_EQ(map.frames.size(), 1u);
    EXPECT_EQ(map.texels_total, 6ull * static_cast<uint64_t>(resolution) * static_cast<uint64_t>(resolution));
    EXPECT_GE(map.texels_traced, map.texels.size());
    EXPECT_LT(map.texels_traced, map.texels_total / 10);
  }
}

TEST(VisibilityMap, CoversABallFromSpotAndDirectionalLights) {
  const vec3 position(2.0f, 4.5f, 1.0f), to_ball = vec3(0.0f, 1.5f, 0.0f) - position;
  const double distance = glm::length(dvec3(to_ball)), angle = std::asin(1.0 / distance);
  // The ball inside the inner cone: full intensity everywhere.
  {
    const Prepared p(ball_scene(mirror(vec3(1.0f)), spot_light(position, to_ball, 0.4f, 0.5f, 7.0f)));
    const VisibilityMap map = map_of(p, 400);
    const double texel = 2.0 * std::tan(0.5) / 400;
    EXPECT_NEAR(map.covered_flux, 7.0 * 2.0 * kPi * (1.0 - std::cos(angle)),
                7.0 * texel * texel * border_error(2.0 * std::tan(angle) / texel));
    EXPECT_EQ(map.texels_total, 400u * 400u);
  }
  {
    const Prepared p(ball_scene(mirror(vec3(1.0f)), sun(vec3(0.3f, -1.0f, 0.2f), 3.0f)));
    const VisibilityMap map = map_of(p, 400);
    EXPECT_NEAR(map.covered_flux, 3.0 * kPi, 3.0 * 0.005 * 0.005 * 1.01 * border_error(400.0));
    EXPECT_EQ(map.texels_total, 400u * 400u);
  }
  // A spot whose cone lies within the ball: the flux of the falloff, in the cone's own closed form. With
  // s = (cos - cos_outer) / (cos_inner - cos_outer) and inner = 0: 2 pi I (1 - cos_outer) / 3.
  {
    const float outer = 0.15f;
    const Prepared p(ball_scene(mirror(vec3(1.0f)), spot_light(position, to_ball, 0.0f, outer, 7.0f)));
    const double c = std::cos(static_cast<double>(outer));
    ASSERT_GT(1.0 - c, 1e-3);
    // The falloff is smooth up to its border: midpoints err by the second order of 1/200.
    EXPECT_NEAR(map_of(p, 400).covered_flux / (2.0 * kPi * 7.0 * (1.0 - c) / 3.0), 1.0, 1e-3);
  }
}

// Whether the light shines along `direction` at all, from its cone alone.
bool shines(const Light& light, const dvec3& direction) {
  if (light.kind != LightKind::spot) return true;
  return std::acos(std::min(1.0, glm::dot(direction, glm::normalize(dvec3(light.direction))))) <
         static_cast<double>(light.outer_cone_angle);
}

TEST(VisibilityMap, TexelsAreThoseWhoseCentresSeeASpecularSurfaceThatIsLit) {
  for (const Light& light :
       {point_light(vec3(0.3f, 3.0f, 0.4f), 5.0f), point_light(vec3(-0.8f, 0.4f, 0.9f), 5.0f),
        spot_light(vec3(0.0f, 4.0f, 0.5f), vec3(0.1f, -1.0f, 0.0f), 0.1f, 0.45f, 5.0f),
        spot_light(vec3(0.9f, 2.0f, 1.5f), vec3(0.1f, -1.0f, 0.0f), 0.1f, 1.2f, 5.0f),
        sun(vec3(0.2f, -1.0f, 0.3f), 5.0f)}) {
    Scene scene = mixed_scene();
    scene.lights = {light};
    update_content_hash(scene);
    const Prepared p(std::move(scene));
    const VisibilityMap map = map_of(p, 90);
    size_t active = 0, edge = 0;
    const Bounds3 around{light.position - 9.0f, light.position + 9.0f};
    const std::vector<LightFrame> frames = light.kind == LightKind::directional
                                               ? std::vector<LightFrame>{map.frames.at(0).frame}
                                               : light_frames(light, {&around, 1}, around, 90);
    for (const LightFrame& frame : frames) {
      const auto own = std::find_if(map.frames.begin(), map.frames.end(),
                                    [&](const MapFrame& f) { return f.frame.forward == frame.forward; });
      for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 90; ++x) {
          const dvec3 direction = frame.ray_direction(x + 0.5, y + 0.5);
          const Hit hit = p.tracer.intersect(vec3(frame.ray_origin(x + 0.5, y + 0.5)), vec3(direction));
          const bool expected = hit.valid() && shines(light, direction) &&
                                p.caustic.optics.materials[p.scene.material_of(hit.primitive)].specular;
          const bool is = own != map.frames.end() && own->active(x, y);
          // Packets and single rays may round an edge differently.
          edge += is != expected;
          active += is;
        }
    }
    EXPECT_LE(edge, 2u);
    EXPECT_GT(active, 500u);
    EXPECT_EQ(map.texels.size(), active);
    EXPECT_LE(map.texels_traced, map.texels_total);
    EXPECT_EQ(map.texels_total, frames.size() * 90 * 90);

    // The list is the active texels, each once.
    std::set<std::tuple<int, int, int>> listed;
    for (const MapTexel& t : map.texels) {
      EXPECT_TRUE(listed.emplace(t.frame, t.x, t.y).second);
      ASSERT_LT(t.frame, map.frames.size());
      EXPECT_EQ(map.frames[t.frame].active(t.x, t.y), 1);
      EXPECT_TRUE(t.reflect >= 0.0f && t.reflect <= 1.0f);
    }
    for (const MapFrame& f : map.frames)
      EXPECT_GT(std::ranges::count(f.active.values(), 1), 0) << "empty frames are dropped";
  }
}

TEST(VisibilityMap, TheListGoesTileByTile) {
  const Prepared p(ball_scene(mirror(vec3(1.0f)), point_light(vec3(0.0f, 4.0f, 0.0f), 1.0f)));
  const VisibilityMap map = map_of(p, 256);
  const auto tile = [](const MapTexel& t) { return std::tuple(t.frame, t.x / 8, t.y / 8); };
  std::set<std::tuple<int, int, int>> tiles;
  size_t runs = 0;
  for (size_t i = 0; i < map.texels.size(); ++i) {
    tiles.insert(tile(map.texels[i]));
    runs += i == 0 || tile(map.texels[i]) != tile(map.texels[i - 1]);
  }
  EXPECT_GT(tiles.size(), 100u);
  EXPECT_EQ(runs, tiles.size());
}

TEST(VisibilityMap, TheReflectShareIsFresnels) {
  // From 4 m above the centre, against a ball of radius 1.
  const Prepared p(ball_scene(glass(1.5f), point_light(vec3(0.0f, 5.5f, 0.0f), 1.0f)));
  const VisibilityMap map = map_of(p, 512);
  ASSERT_GT(map.texels.size(), 5000u);
  double nearest = 1.0, least = 1.0;
  for (const MapTexel& t : map.texels) {
    const dvec3 d = map.frames[t.frame].frame.ray_direction(t.x + 0.5, t.y + 0.5);
    // The angle of incidence from the sine rule in the triangle of light, centre and point.
    const double cosine = -d.y, sine = std::sqrt(1.0 - cosine * cosine), sin_i = 4.0 * sine;
    if (sin_i > 0.995) continue;  // the rounding of the grazing point is not small there
    const double i = std::asin(sin_i), r = std::asin(sin_i / 1.5);
    const double s = std::sin(i - r) / std::sin(i + r), q = std::tan(i - r) / std::tan(i + r);
    EXPECT_NEAR(t.reflect, sin_i > 1e-4 ? 0.5 * (s * s + q * q) : 0.04, 1e-4);
    if (sine < nearest) nearest = sine, least = t.reflect;
  }
  EXPECT_NEAR(least, 0.04, 1e-4);
  const Prepared metal(ball_scene(mirror(vec3(0.7f)), point_light(vec3(0.0f, 5.5f, 0.0f), 1.0f)));
  for (const MapTexel& t : map_of(metal, 64).texels) EXPECT_EQ(t.reflect, 1.0f);
}

TEST(VisibilityMap, ASceneWithoutSpecularMaterialBuildsNothing) {
  const Prepared p(ball_scene(matte(vec3(0.5f)), point_light(vec3(0.0f, 5.5f, 0.0f), 1.0f)));
  EXPECT_TRUE(p.caustic.targets.boxes.empty());
  PassSettings settings;
  settings.lights = {0};
  for (const EmissionKind kind : {EmissionKind::map, EmissionKind::uniform}) {
    settings.emission = kind;
    const MapSet set = make_maps(p.caustic, settings);
    EXPECT_TRUE(set.maps.empty());
    EXPECT_EQ(set.lights_skipped, 1u);
    EXPECT_EQ(set.texels_traced, 0u);
    EXPECT_EQ(set.texels_used, 0u);
  }
  const VisibilityMap map = map_of(p, 64);
  EXPECT_TRUE(map.frames.empty());
  EXPECT_EQ(map.texels_traced, 0u);
}

// The ball's scene with lights: 0 sees it, 1 is dark, 2 behind a wall, 3 a spot that turns away, 4 sees it, 5
// is a spot whose cone has no width.
Scene many_lights() {
  Scene scene = ball_scene(mirror(vec3(1.0f)), point_light(vec3(0.0f, 5.0f, 0.0f), 1.0f));
  add_sheet(scene, 0, vec3(-30.0f, -30.0f, -3.0f), vec3(60.0f, 0.0f, 0.0f), vec3(0.0f, 60.0f, 0.0f));
  scene.lights.push_back(point_light(vec3(0.0f, 5.0f, 1.0f), 0.0f));
  scene.lights.push_back(point_light(vec3(0.0f, 1.5f, -5.0f), 1.0f));
  scene.lights.push_back(spot_light(vec3(0.0f, 5.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f), 0.1f, 0.7f, 1.0f));
  scene.lights.push_back(sun(vec3(0.0f, -1.0f, 0.1f), 1.0f));
  scene.lights.push_back(spot_light(vec3(0.0f, 5.0f, 0.0f), vec3(0.0f, -1.0f, 0.0f), 0.0f, 0.0f, 1.0f));
  update_content_hash(scene);
  return scene;
}

TEST(VisibilityMap, LightsThatSeeNothingSpecularDropOutAndAreCounted) {
  const Prepared p(many_lights());
  const std::vector<uint32_t> lights = {0, 1, 2, 3, 4, 5};
  const auto make = [&](bool keep) {
    return make_visibility_maps(p.tracer, p.caustic.optics, p.caustic.targets, lights, 64, keep);
  };
  const MapSet set = make(false);
  ASSERT_EQ(set.maps.size(), 2u);
  EXPECT_EQ(set.maps[0].light, 0u);
  EXPECT_EQ(set.maps[1].light, 4u);
  EXPECT_EQ(set.lights_skipped, 4u);
  EXPECT_EQ(set.texels_used, set.maps[0].texels.size() + set.maps[1].texels.size());
  EXPECT_EQ(set.texels_total, (6u + 6u + 6u + 1u + 1u + 1u) * 64u * 64u);
  // Behind the wall the box is in view and its tiles are traced, in vain; dark and turned away cost nothing.
  EXPECT_GT(map_of(p, 64, 2).texels_traced, 0u);
  EXPECT_TRUE(map_of(p, 64, 2).texels.empty());
  EXPECT_EQ(map_of(p, 64, 1).texels_traced, 0u);
  EXPECT_EQ(map_of(p, 64, 3).texels_traced, 0u);
  EXPECT_EQ(map_of(p, 64, 5).texels_traced, 0u);
  // Kept without texels: all that emit.
  const MapSet kept = make(true);
  EXPECT_EQ(kept.maps.size(), 4u);
  EXPECT_EQ(kept.lights_skipped, 2u);
}

TEST(VisibilityMap, IsTheSameAtAnyNumberOfThreads) {
  const Prepared p(mixed_scene());
  const VisibilityMap many = map_of(p, 128);
  const ThreadLimit limit(1);
  const VisibilityMap one = map_of(p, 128);
  ASSERT_EQ(one.texels.size(), many.texels.size());
  for (size_t i = 0; i < one.texels.size(); ++i) {
    ASSERT_EQ(one.texels[i].x, many.texels[i].x);
    ASSERT_EQ(one.texels[i].y, many.texels[i].y);
    ASSERT_EQ(one.texels[i].frame, many.texels[i].frame);
    ASSERT_EQ(one.texels[i].reflect, many.texels[i].reflect);
  }
  EXPECT_EQ(one.covered_flux, many.covered_flux);
}

TEST(VisibilityMap, TakesOneTexelAndRefusesNone) {
  const Prepared p(ball_scene(mirror(vec3(1.0f)), point_light(vec3(0.0f, 5.0f, 0.0f), 1.0f)));
  const VisibilityMap map = map_of(p, 1);
  ASSERT_EQ(map.texels.size(), 1u);
  EXPECT_NEAR(map.covered_flux, 4.0 * kPi / 6.0, 1e-12);
  for (const int bad : {0, -1, 65536}) EXPECT_THROW(map_of(p, bad), InputError);
}

}  // namespace
}  // namespace hybray
