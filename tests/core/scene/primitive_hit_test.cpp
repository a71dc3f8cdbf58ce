#include "core/scene/primitive_hit.h"

#include "core/base/hash.h"
#include "core/tracer/tracer.h"
#include "tests/core/test_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 71;

vec3 random_vector(uint32_t i, uint32_t sample) {
  const auto unit = [&](uint32_t d) {
    return static_cast<float>(2.0 * random_unit(i, d, sample, kSeed) - 1.0);
  };
  return vec3(unit(0), unit(1), unit(2));
}

TEST(PrimitiveHit, TheNearestOverAllPrimitivesIsWhatTheTracerFinds) {
  Scene scene = test::triangle_soup(40, 1.0f, 2.0f, kSeed);
  append_analytic(scene, analytic_sphere("ball", 0, dvec3(0.3, 0.2, -0.4), 0.7));
  const Tracer tracer(scene, {.robust = true});
  int hits = 0, edge_cases = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    const vec3 origin = 3.0f * random_vector(i, 0), direction = glm::normalize(random_vector(i, 1) - origin);
    std::optional<double> nearest;
    for (uint32_t p = 0; p < scene.primitive_count(); ++p) {
      const auto t = primitive_hit(scene, p, dvec3(origin), dvec3(direction));
      if (t && (!nearest || *t < *nearest)) nearest = t;
    }
    const Hit traced = tracer.intersect(origin, direction);
    // The tracer works in float: a ray within rounding of an edge may fall on either side of it.
    if (traced.valid() != nearest.has_value() ||
        (nearest && std::abs(traced.t - *nearest) > 1e-4 * *nearest)) {
      ++edge_cases;
      continue;
    }
    hits += traced.valid();
  }
  EXPECT_LE(edge_cases, 1) << "seed " << kSeed;
  EXPECT_GT(hits, 1500);
}

TEST(PrimitiveHit, ALineThroughTheEdgeOfTwoTrianglesMeetsAtLeastOneOfThem) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-1.1f, -0.7f, 0.3f), vec3(2.3f, 0.1f, 0.4f), vec3(-0.2f, 1.9f, 0.3f));
  const dvec3 a(scene.positions[scene.triangles[0].x]), c(scene.positions[scene.triangles[0].z]);
  for (uint32_t i = 0; i < 20000; ++i) {
    // Through a point of the diagonal, exact to double rounding only.
    const dvec3 on_edge = a + random_unit(i, 3, 0, kSeed) * (c - a);
    const dvec3 origin = on_edge + dvec3(5.0f * random_vector(i, 2));
    const dvec3 direction = on_edge - origin;
    EXPECT_TRUE(primitive_hit(scene, 0, origin, direction) || primitive_hit(scene, 1, origin, direction))
        << "seed " << kSeed << " line " << i;
  }
}

TEST(PrimitiveHit, NothingBehindTheOriginOrInThePlaneItselfIsMet) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-1, -1, 0), vec3(2, 0, 0), vec3(0, 2, 0));
  EXPECT_DOUBLE_EQ(primitive_hit(scene, 0, dvec3(0.25, 0.0, 2), dvec3(0, 0, -1)).value(), 2.0);
  EXPECT_FALSE(primitive_hit(scene, 0, dvec3(0.25, 0.0, 2), dvec3(0, 0, 1)));
  EXPECT_FALSE(primitive_hit(scene, 0, dvec3(-2, 0, 0), dvec3(1, 0, 0)));
}

}  // namespace
}  // namespace hybray
