// The procedural scenes to walk about in: triangle counts, determinism, clean geometry, and cameras with room
// around them. Those made for caustics have tests of their own.
#include "core/base/error.h"
#include "core/scene/procedural/generators.h"
#include "core/tracer/tracer.h"
#include "tests/core/scene/sound_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::procedural {
namespace {

class ProceduralScene : public testing::TestWithParam<Generator> {
 protected:
  static Scene make(uint32_t triangles, uint32_t seed = 1) { return GetParam().generate({triangles, seed}); }
};

TEST_P(ProceduralScene, HasTheWantedNumberOfTrianglesToWithinThreePerCent) {
  for (const uint32_t wanted :
       {1u << 10, 1500u, 1u << 12, 10000u, 1u << 14, 1u << 16, 1u << 18, 1u << 20, 1u << 21}) {
    const double got = static_cast<double>(make(wanted).triangle_count());
    EXPECT_LE(std::abs(got - wanted), 0.03 * wanted) << "wanted " << wanted << ", got " << got;
  }
  const double by_default = static_cast<double>(make(0).triangle_count());
  EXPECT_NEAR(by_default, GetParam().default_triangles, 0.03 * GetParam().default_triangles);
}

TEST_P(ProceduralScene, RefusesANumberOfTrianglesItCannotMake) {
  EXPECT_THROW(make(1), InputError);
  EXPECT_THROW(make(0xffffffffu), InputError);
}

TEST_P(ProceduralScene, IsTheSameForTheSameParametersAndAnotherForAnotherSeed) {
  const uint32_t count = 1u << 16;
  EXPECT_EQ(make(count).content_hash, make(count).content_hash);
  EXPECT_NE(make(count, 1).content_hash, make(count, 2).content_hash);
  EXPECT_NE(make(count).content_hash, make(2 * count).content_hash);
}

TEST_P(ProceduralScene, HasNoDegenerateTriangleAndOnlyFiniteVertices) {
  for (const uint32_t count : {1u << 10, 1u << 13, 0u}) test::expect_sound_triangles(make(count));
}

TEST_P(ProceduralScene, HasUnitShadingNormalsOnTheSideOfTheWinding) {
  for (const uint32_t count : {1u << 12, 0u}) {
    const Scene scene = make(count);
    for (const vec3& n : scene.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f);
    size_t against = 0;
    for (uint32_t t = 0; t < scene.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k)
        if (!(glm::dot(geometric_normal(scene, t), dvec3(scene.normals[scene.triangles[t][k]])) > 0.0))
          ++against;
    EXPECT_LE(against, scene.triangle_count() / 10000);
  }
}

TEST_P(ProceduralScene, KeepsItsPlaceAndItsCamerasAtAnyNumberOfTriangles) {
  const Scene reference = make(0);
  for (const uint32_t count : {1u << 10, 1u << 14, 1u << 19}) {
    const Scene scene = make(count);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(scene.bounds.lower[k], reference.bounds.lower[k], 0.02f * reference.bounds.diagonal());
      EXPECT_NEAR(scene.bounds.upper[k], reference.bounds.upper[k], 0.02f * reference.bounds.diagonal());
    }
    ASSERT_EQ(scene.cameras.size(), reference.cameras.size());
    for (size_t i = 0; i < scene.cameras.size(); ++i) {
      EXPECT_EQ(scene.cameras[i].name, reference.cameras[i].name);
      EXPECT_EQ(scene.cameras[i].eye, reference.cameras[i].eye);
    }
    EXPECT_EQ(scene.lights.size(), reference.lights.size());
  }
}

// Directions spread evenly over the sphere (a Fibonacci lattice).
std::vector<vec3> spread_directions(int count) {
  std::vector<vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / count, r = std::sqrt(1.0 - y * y), a = 2.399963229728653 * i;
    directions.emplace_back(static_cast<float>(r * std::cos(a)), static_cast<float>(y),
                            static_cast<float>(r * std::sin(a)));
  }
  return directions;
}

TEST_P(ProceduralScene, HasFourCamerasInsideWithRoomAroundThem) {
  for (const uint32_t count : {1u << 10, 1u << 15, 0u}) {
    const Scene scene = make(count);
    const Tracer tracer(scene, {});
    EXPECT_GE(scene.cameras.size(), 4u);
    for (const Camera& camera : scene.cameras) {
      SCOPED_TRACE(camera.name + " at " + std::to_string(scene.triangle_count()) + " triangles");
      for (int k = 0; k < 3; ++k) {
        EXPECT_GT(camera.eye[k], scene.bounds.lower[k]);
        EXPECT_LT(camera.eye[k], scene.bounds.upper[k]);
      }
      EXPECT_GE(camera.vertical_fov, 60.0f);
      EXPECT_LE(camera.vertical_fov, 75.0f);
      int hits = 0;
      for (const vec3& d : spread_directions(500)) {
        const Hit hit = tracer.intersect(camera.eye, d);
        if (!hit.valid()) continue;
        ++hits;
        EXPECT_GT(hit.t, 0.3f);
        // Seen from inside a closed object, every surface would show its back.
        const double facing = glm::dot(geometric_normal(scene, hit.primitive), dvec3(d));
        EXPECT_TRUE(hit.t >= 1.0f || facing < 0.0);
      }
      EXPECT_GT(hits, 250) << "little is around the camera";
    }
  }
}

TEST_P(ProceduralScene, ShowsFrontsAndNoTwoFacesInTheSamePlaceToItsCameras) {
  const Scene scene = make(0);
  const Tracer tracer(scene, {});
  int hits = 0, backs = 0, doubled = 0;
  for (const Camera& camera : scene.cameras)
    for (const vec3& d : spread_directions(20000)) {
      const Hit first = tracer.intersect(camera.eye, d);
      if (!first.valid()) continue;
      ++hits;
      const dvec3 normal = geometric_normal(scene, first.primitive);
      if (glm::dot(normal, dvec3(d)) > 0.0) ++backs;
      const Hit second = tracer.intersect(camera.eye, d, first.t * (1.0f + 2e-6f));
      if (second.valid() && second.t - first.t < 1e-4f * first.t &&
          glm::dot(normal, geometric_normal(scene, second.primitive)) > 0.999)
        ++doubled;
    }
  EXPECT_LE(backs, hits / 1000);
  EXPECT_LE(doubled, hits / 1000);
}

std::vector<Generator> places() {
  std::vector<Generator> found;
  for (const Generator& generator : generators())
    for (const char* name : {"sphere", "atrium", "street"})
      if (std::string(generator.name) == name) found.push_back(generator);
  return found;
}

INSTANTIATE_TEST_SUITE_P(All, ProceduralScene, testing::ValuesIn(places()),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace hybray::procedural
