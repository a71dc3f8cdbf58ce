// Curves through the tracer, against each of them in double, which tests of their own hold against brute
// force.
#include "core/scene/curved_primitive.h"
#include "core/scene/primitive_hit.h"
#include "core/scene/surface_point.h"
#include "core/tracer/tracer.h"
#include "tests/core/curve_truth.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 90210;
constexpr uint32_t kCurves = 60;

double unit(uint64_t i, uint32_t d, uint32_t sample) {
  return 2.0 * random_unit(i, d, sample, kSeed) - 1.0;
}
vec3 vector(uint64_t i, uint32_t first, uint32_t sample) {
  return vec3(dvec3(unit(i, first, sample), unit(i, first + 1, sample), unit(i, first + 2, sample)));
}

// 25 triangles, a ball, then curves.
Scene thicket(double thickness = 0.03) {
  Scene scene = test::triangle_soup(25, 0.4f, 1.0f, kSeed);
  append_analytic(scene, analytic_sphere("ball", 0, {0.2, -0.4, 0.1}, 0.25));
  for (uint64_t i = 0; i < kCurves; ++i)
    append_curve(scene, test::random_curve([&](uint32_t d) { return unit(i, d, 1); }, thickness));
  return scene;
}

RayStream random_rays(size_t n) {
  RayStream rays;
  rays.resize(n);
  for (size_t i = 0; i < n; ++i)
    rays.set(i, 1.6f * vector(i, 0, 2), glm::normalize(0.8f * vector(i, 3, 2) - 1.6f * vector(i, 0, 2)),
             static_cast<uint32_t>(i));
  return rays;
}

struct Nearest {
  double t = std::numeric_limits<double>::infinity();
  uint32_t primitive = kNoPrimitive;
};

Nearest in_double(const Scene& scene, const dvec3& o, const dvec3& d) {
  Nearest best;
  for (uint32_t p = 0; p < scene.primitive_count(); ++p)
    if (const auto t = primitive_hit(scene, p, o, d); t && *t < best.t) best = {*t, p};
  return best;
}

class CurveModes : public testing::TestWithParam<TraceMode> {};

TEST_P(CurveModes, FindWhatALoopOverAllPrimitivesInDoubleFinds) {
  const Scene scene = thicket();
  const RayStream rays = random_rays(4003);
  std::vector<Nearest> truth(rays.size());
  for (size_t i = 0; i < rays.size(); ++i)
    truth[i] = in_double(scene, dvec3(rays.origin(i)), dvec3(rays.direction(i)));
  for (const bool robust : {false, true}) {
    const Tracer tracer(scene, {.robust = robust, .high_quality = !robust});
    HitStream hits;
    hits.resize(rays.size());
    tracer.trace(rays, hits, GetParam());
    std::vector<uint8_t> occluded(rays.size());
    tracer.occlude(rays, {}, occluded, GetParam());
    int other = 0, seen = 0, apart = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(occluded[i] != 0, hits.primitive[i] != kNoPrimitive) << i;
      if (hits.primitive[i] != truth[i].primitive) {
        ++other;
        continue;
      }
      if (truth[i].primitive == kNoPrimitive || !scene.is_curve(truth[i].primitive)) continue;
      ++seen;
      // Embree stops where its residuals reach about 16 roundings of the coordinates, 5e-6 here, across the
      // surface: along the ray, that over the cosine.
      const dvec3 o(rays.origin(i)), d(rays.direction(i)),
          n = geometric_normal(scene, truth[i].primitive, o + truth[i].t * d);
      apart += std::abs(hits.t[i] - truth[i].t) * std::max(0.05, std::abs(glm::dot(n, d))) > 1e-5;
    }
    // Rays within 5e-6 of an outline, 60 of them 0.03 apart: 60 x 2 x 1.5 x 5e-6 of about 4 square metres.
    EXPECT_LE(other, 5) << robust << " seed " << kSeed;
    EXPECT_LE(apart, 4) << robust << " seed " << kSeed;
    EXPECT_GT(seen, 800);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CurveModes, testing::ValuesIn(kAllTraceModes),
                         [](const auto& mode) { return std::string(label(mode.param)); });

TEST(CurveGeometry, TheIntervalPicksTheFarSideAndTheIdIsTheScenes) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-5, -5, -5), vec3(1, 0, 0), vec3(0, 1, 0));
  RoundCurve curve;
  for (size_t i = 0; i < 4; ++i) curve.control[i] = vec4(0.0f, static_cast<float>(i), 0.0f, 0.25f);
  append_curve(scene, curve);
  const Tracer tracer(scene, {});
  const vec3 o(0, 1.3f, 3), d(0, 0, -1);
  EXPECT_NEAR(tracer.intersect(o, d).t, 2.75, 1e-5);
  EXPECT_EQ(tracer.intersect(o, d).primitive, 2u);
  EXPECT_NEAR(tracer.intersect(o, d, 2.9f).t, 3.25, 1e-5);
  EXPECT_FALSE(tracer.intersect(o, d, 2.9f, 3.1f).valid());
  EXPECT_TRUE(tracer.occluded(o, d, 0.0f, 2.8f));
  EXPECT_FALSE(tracer.occluded(o, d, 0.0f, 2.7f));
}

// As reflection rays and paths leave it: lifted off by the offset of its point.
TEST(CurveGeometry, ARayThatLeavesACurveDoesNotMeetItAgain) {
  for (const double thickness : {0.03, 0.003}) {
    const Scene scene = thicket(thickness);
    const Tracer tracer(scene, {.robust = true});
    int left = 0, again = 0;
    for (uint64_t i = 0; i < 20000; ++i) {
      const auto number = static_cast<uint32_t>(scene.first_curve() + i % kCurves);
      const test::CurveTruth truth(scene.curve(number));
      const dvec4 at = truth.at(0.02 + 0.96 * random_unit(i, 0, 3, kSeed));
      const dvec3 target = dvec3(at) + 0.97 * at.w * dvec3(glm::normalize(vector(i, 1, 3)));
      const vec3 o = 1.6f * vector(i, 4, 3), d(glm::normalize(target - dvec3(o)));
      const Hit hit = tracer.intersect(o, d);
      if (hit.primitive != number) continue;
      const SurfacePoint p = surface_point(scene, number, hit.u, hit.v, dvec3(o) + double(hit.t) * dvec3(d));
      const double cosine = glm::dot(dvec3(d), p.geometric_normal);
      if (cosine >= 0.0) continue;  // met from inside, through an end
      ++left;
      const dvec3 mirrored = dvec3(d) - 2.0 * cosine * p.geometric_normal;
      const Hit next = tracer.intersect(vec3(p.position + p.offset * p.geometric_normal), vec3(mirrored));
      // A curve that bends toward the ray may be met again farther off.
      again += next.primitive == number && next.t < 4.0f * static_cast<float>(at.w);
    }
    EXPECT_GT(left, 8000);
    EXPECT_LE(again, left / 2000) << thickness;
  }
}

}  // namespace
}  // namespace hybray
