// The scenes made for caustics: triangle counts, clean geometry, normals outward, and lamps that are seen or
// not as their names say.
#include "core/base/error.h"
#include "core/optics/surface_optics.h"
#include "core/scene/closed_bodies.h"
#include "core/scene/procedural/generators.h"
#include "core/tracer/tracer.h"
#include "tests/core/scene/sound_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace hybray::procedural {
namespace {

class CausticScene : public testing::TestWithParam<Generator> {
 protected:
  static Scene make(uint32_t triangles, uint32_t seed = 1) { return GetParam().generate({triangles, seed}); }
};

TEST_P(CausticScene, HasTheWantedNumberOfTrianglesToWithinThreePerCent) {
  for (const uint32_t wanted : {1u << 13, 10000u, 1u << 14, 50000u, 1u << 18, 1u << 20}) {
    const auto got = static_cast<double>(make(wanted).triangle_count());
    EXPECT_LE(std::abs(got - wanted), 0.03 * wanted) << "wanted " << wanted << ", got " << got;
  }
  const uint32_t standard = GetParam().default_triangles;
  EXPECT_NEAR(static_cast<double>(make(0).triangle_count()), standard, 0.03 * standard);
}

TEST_P(CausticScene, RefusesANumberOfTrianglesItCannotMake) {
  EXPECT_THROW(make(1), InputError);
  EXPECT_THROW(make(0xffffffffu), InputError);
}

TEST_P(CausticScene, IsTheSameForTheSameParameters) {
  EXPECT_EQ(make(0).content_hash, make(0).content_hash);
  EXPECT_NE(make(0).content_hash, make(3u << 13).content_hash);
}

TEST_P(CausticScene, HasOnlyFiniteVerticesAndNoDegenerateTriangle) {
  test::expect_sound_triangles(make(0));
}

TEST_P(CausticScene, ShadingNormalsFollowTheSurfaceWhereItIsSmooth) {
  const Scene scene = make(0);
  const optics::OpticsTable table = optics::make_optics(scene);
  size_t steep = 0, specular = 0;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const double cosine = glm::dot(geometric_normal(scene, t), dvec3(scene.normals[scene.triangles[t][k]]));
      ASSERT_GT(cosine, 0.0);
      if (!table.materials[scene.triangle_material[t]].specular) continue;
      ++specular;
      if (cosine < 0.7) ++steep;  // 45 degrees: only where rims are folded from a few triangles
    }
  EXPECT_GT(specular, 0u);
  EXPECT_LE(static_cast<double>(steep), 0.03 * static_cast<double>(specular));
}

// The medium that lies behind the interfaces fills a positive volume: normals point out of it.
TEST_P(CausticScene, BodiesCloseAndTheirNormalsPointOutward) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const Scene scene = make(0, seed);
    EXPECT_NO_THROW(check_closed_bodies(scene));
    for (const SceneObject& object : scene.objects) {
      const Material& m = scene.materials[object.material];
      Scene alone;
      alone.materials = {m};
      append_mesh(alone, object_mesh(scene, object), mat4(1.0f), 0, object.name);
      if (m.transmission == 0.0f || m.thin_walled || !find_body_faults(alone).empty()) continue;
      double volume = 0.0;
      const dvec3 origin(alone.positions[0]);
      for (const uvec3& tri : alone.triangles) {
        const dvec3 a = dvec3(alone.positions[tri.x]) - origin, b = dvec3(alone.positions[tri.y]) - origin;
        volume += glm::dot(a, glm::cross(b, dvec3(alone.positions[tri.z]) - origin)) / 6.0;
      }
      EXPECT_GT(volume, 0.0) << object.name;
    }
  }
}

TEST_P(CausticScene, GroundsAreMatteSoThatNothingButTheirColourIsSeenInThem) {
  const Scene scene = make(0);
  const optics::OpticsTable table = optics::make_optics(scene);
  EXPECT_TRUE(table.any_specular);
  for (const SceneObject& object : scene.objects) {
    const bool ground =
        object.name == "floor" || object.name == "wall" || object.name.starts_with("bottom_tiles");
    EXPECT_FALSE(ground && table.materials[object.material].specular) << object.name;
  }
}

TEST_P(CausticScene, CamerasAndLightsStandInTheOpen) {
  for (const uint32_t count : {1u << 13, 0u}) {
    const Scene scene = make(count);
    const Tracer tracer(scene, {});
    EXPECT_GE(scene.cameras.size(), 3u);
    EXPECT_GE(scene.lights.size(), 1u);
    // Above whatever lies below, whose front is seen: neither under the floor nor in a body.
    const auto expect_open = [&](const std::string& name, const vec3& at) {
      const Hit hit = tracer.intersect(at, vec3(0.0f, -1.0f, 0.0f));
      ASSERT_TRUE(hit.valid()) << name;
      EXPECT_GT(geometric_normal(scene, hit.primitive).y, 0.0) << name;
      EXPECT_GT(hit.t, 0.03f) << name;
    };
    for (const Camera& camera : scene.cameras) {
      SCOPED_TRACE(camera.name);
      // Most of what is in view belongs to the scene.
      const vec3 axis = glm::normalize(camera.target - camera.eye);
      const Hit hit = tracer.intersect(camera.eye, axis);
      ASSERT_TRUE(hit.valid());
      EXPECT_LT(glm::dot(geometric_normal(scene, hit.primitive), dvec3(axis)), 0.0);
    }
    for (const Light& light : scene.lights)
      if (light.kind != LightKind::directional && GetParam().name != std::string("prism"))
        expect_open(light.name, light.position);
  }
}

std::vector<Generator> caustic_scenes() {
  std::vector<Generator> found;
  for (const Generator& generator : generators())
    for (const char* name : {"atrium_lamps", "glass_ball", "metal_ring", "mirror_and_floor", "prism",
                             "water_pool", "wine_glass"})
      if (std::string(generator.name) == name) found.push_back(generator);
  return found;
}

INSTANTIATE_TEST_SUITE_P(All, CausticScene, testing::ValuesIn(caustic_scenes()),
                         [](const auto& each) { return std::string(each.param.name); });

// Whether a point is inside the camera's frame (16:9) and nothing stands before it.
bool is_seen(const Tracer& tracer, const Camera& camera, const vec3& point) {
  const dvec3 forward = glm::normalize(dvec3(camera.target) - dvec3(camera.eye));
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up))), up = glm::cross(right, forward);
  const dvec3 d = dvec3(point) - dvec3(camera.eye);
  const double half = std::tan(0.5 * glm::radians(static_cast<double>(camera.vertical_fov)));
  const double depth = glm::dot(d, forward);
  const bool in_frame = depth > 0.0 && std::abs(glm::dot(d, up)) < half * depth &&
                        std::abs(glm::dot(d, right)) < half * depth * 16.0 / 9.0;
  const auto distance = static_cast<float>(glm::length(d));
  return in_frame && !tracer.occluded(camera.eye, vec3(glm::normalize(d)), 0.0f, 0.999f * distance);
}

TEST(AtriumLamps, TheNaveSeesTheVisibleLampsAndNoneOfTheHiddenOnes) {
  for (const uint32_t count : {1u << 14, 0u, 1u << 20}) {
    const Scene scene = atrium_lamps({count, 1});
    const Tracer tracer(scene, {});
    const Camera& nave = find_camera(scene, "nave");
    ASSERT_EQ(scene.lights.size(), 16u);
    for (size_t i = 0; i < 16; ++i) {
      const std::string name = (i < 8 ? "visible_" : "hidden_") + std::to_string(i % 8);
      EXPECT_EQ(scene.lights[i].name, name);
      EXPECT_EQ(is_seen(tracer, nave, scene.lights[i].position), i < 8) << name;
    }
  }
}

TEST(AtriumLamps, EveryLampShinesOnGlassAndOnMetalNearby) {
  const Scene scene = atrium_lamps({});
  const Tracer tracer(scene, {});
  const optics::OpticsTable table = optics::make_optics(scene);
  for (const Light& lamp : scene.lights) {
    int glass = 0, metal = 0;
    constexpr int kRays = 20000;
    for (int i = 0; i < kRays; ++i) {  // a Fibonacci lattice
      const double y = 1.0 - 2.0 * (i + 0.5) / kRays, r = std::sqrt(1.0 - y * y), a = 2.399963229728653 * i;
      const Hit hit =
          tracer.intersect(lamp.position, vec3(static_cast<float>(r * std::cos(a)), static_cast<float>(y),
                                               static_cast<float>(r * std::sin(a))));
      if (!hit.valid() || hit.t > 2.0f) continue;
      const optics::SurfaceOptics& s = table.materials[scene.triangle_material[hit.primitive]];
      glass += s.interface ? 1 : 0;
      metal += s.specular && s.metal > 0.0 ? 1 : 0;
    }
    EXPECT_GT(glass, kRays / 500) << lamp.name;
    EXPECT_GT(metal, kRays / 1000) << lamp.name;
  }
}

// Snell's law at two faces that meet at 60 degrees, written out for the axis of the beam.
TEST(Prism, TheBeamMeetsTheFaceWhereItLeavesAtLessThanTheCriticalAngle) {
  const Scene scene = prism({});
  const Light& beam = scene.lights.front();
  ASSERT_EQ(beam.kind, LightKind::spot);
  const Tracer tracer(scene, {});
  const Hit hit = tracer.intersect(beam.position, beam.direction);
  ASSERT_TRUE(hit.valid());
  ASSERT_EQ(scene.materials[scene.triangle_material[hit.primitive]].name, "glass");
  const dvec3 n = geometric_normal(scene, hit.primitive), d(beam.direction);
  const double sine = std::sqrt(1.0 - glm::dot(n, d) * glm::dot(n, d));
  const double inside = std::asin(sine / 1.5);
  EXPECT_LT(1.5 * std::sin(glm::radians(60.0) - inside), 0.95);
}

}  // namespace
}  // namespace hybray::procedural
