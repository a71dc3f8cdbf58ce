#include "core/tracer/tracer.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

// Rays from one point into a soup of triangles, each with a length of its own, and whether a brute-force
// search in double finds a triangle nearer than that; rays that come within rounding of an edge or of their
// end are left out.
struct Shot {
  RayStream rays;
  std::vector<float> lengths;
  std::vector<uint8_t> occluded;
};

Shot shoot(const Scene& scene, size_t wanted) {
  Shot shot;
  for (uint32_t i = 0; shot.lengths.size() < wanted; ++i) {
    const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 0, 5) - 1.0; };
    const dvec3 way(unit(0), unit(1), unit(2));
    if (glm::dot(way, way) < 0.01) continue;
    const vec3 o(0.3f, -0.2f, 0.1f), d(glm::normalize(way));
    const auto length = static_cast<float>(0.05 + 2.0 * random_unit(i, 3, 0, 5));
    bool strict = false, loose = false;
    for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
      const auto inside = test::exact_hit(scene, t, dvec3(o), dvec3(d), -1e-4);
      const auto about = test::exact_hit(scene, t, dvec3(o), dvec3(d), 1e-4);
      strict |= inside && *inside < 0.9999 * static_cast<double>(length);
      loose |= about && *about < 1.0001 * static_cast<double>(length);
    }
    if (strict != loose) continue;
    shot.rays.resize(shot.rays.size() + 1);
    shot.rays.set(shot.rays.size() - 1, o, d, i);
    shot.lengths.push_back(length);
    shot.occluded.push_back(strict);
  }
  return shot;
}

TEST(Occlusion, OfListedRaysIsThatOfABruteForceSearchInEveryMode) {
  const Scene scene = test::triangle_soup(150, 0.4f, 1.5f, 21);
  const Tracer tracer(scene, {});
  const Shot shot = shoot(scene, 1003);  // no multiple of a packet
  const auto blocked = std::count(shot.occluded.begin(), shot.occluded.end(), 1);
  EXPECT_GT(blocked, 100);
  EXPECT_LT(blocked, 900);
  std::vector<uint32_t> third;
  for (uint32_t i = 1; i < shot.rays.size(); i += 3) third.push_back(i);
  for (TraceMode mode : kAllTraceModes) {
    std::vector<uint8_t> all(shot.rays.size(), 7), some(shot.rays.size(), 7);
    tracer.occlude(shot.rays, shot.lengths, all, mode);
    EXPECT_EQ(all, shot.occluded) << label(mode);
    tracer.occlude_some(shot.rays, shot.lengths, third, some, mode);
    for (size_t i = 0; i < some.size(); ++i)
      EXPECT_EQ(some[i], i % 3 == 1 ? shot.occluded[i] : 7) << label(mode) << ' ' << i;
  }
}

TEST(Occlusion, WithoutLengthsAsksForAnyHit) {
  const Scene scene = test::triangle_soup(150, 0.4f, 1.5f, 21);
  const Tracer tracer(scene, {});
  const Shot shot = shoot(scene, 300);
  HitStream hits;
  hits.resize(shot.rays.size());
  tracer.trace(shot.rays, hits, TraceMode::single);
  std::vector<uint8_t> occluded(shot.rays.size());
  tracer.occlude(shot.rays, {}, occluded, TraceMode::packet8);
  for (size_t i = 0; i < occluded.size(); ++i)
    EXPECT_EQ(occluded[i] != 0, hits.primitive[i] != kNoPrimitive) << i;
}

}  // namespace
}  // namespace hybray
