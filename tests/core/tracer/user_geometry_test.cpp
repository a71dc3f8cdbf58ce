// Analytic surfaces through the tracer, against intersections in double that are written out here.
#include "core/base/hash.h"
#include "core/scene/primitive_hit.h"
#include "core/scene/surface_point.h"
#include "core/tracer/tracer.h"
#include "tests/core/field_truth.h"
#include "tests/core/test_scenes.h"

#include <array>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 20243;
constexpr double kNone = 1e30;

const dvec3 kBall(0.5, 0.25, -0.5), kTube(-0.75, 0.0, 0.5), kBowl(0.25, -1.0, 0.75);
constexpr double kBallRadius = 0.5, kTubeRadius = 0.4, kTubeLow = -0.8, kTubeHigh = 0.6, kBowlFocus = 0.25,
                 kBowlRim = 0.7;

// Two triangles, then the three surfaces: primitive ids 2, 3 and 4.
Scene surfaces() {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-2, -1.5f, 2), vec3(4, 0, 0), vec3(0, 0, -4));
  append_analytic(scene, analytic_sphere("ball", 0, kBall, kBallRadius));
  append_analytic(scene, analytic_cylinder("tube", 0, kTube, kTubeRadius, kTubeLow, kTubeHigh));
  append_analytic(scene, analytic_paraboloid("bowl", 0, kBowl, kBowlFocus, kBowlRim));
  return scene;
}

// Smallest t >= 0 with a t^2 + b t + c = 0 that `keep` accepts, by the schoolbook formula.
template <class Keep>
double smallest_root(double a, double b, double c, const Keep& keep) {
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) return kNone;
  const double root = std::sqrt(discriminant);
  for (const double t : {(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)})
    if (t >= 0.0 && keep(t)) return t;
  return kNone;
}

std::array<double, 5> closed_forms(const Scene& scene, const dvec3& o, const dvec3& d) {
  std::array<double, 5> t;
  for (uint32_t i = 0; i < 2; ++i) t[i] = test::exact_hit(scene, i, o, d).value_or(kNone);
  const dvec3 b = o - kBall, c = o - kTube, p = o - kBowl;
  t[2] = smallest_root(glm::dot(d, d), 2.0 * glm::dot(b, d), glm::dot(b, b) - kBallRadius * kBallRadius,
                       [](double) { return true; });
  const double across = d.x * d.x + d.z * d.z;
  t[3] =
      smallest_root(across, 2.0 * (c.x * d.x + c.z * d.z), c.x * c.x + c.z * c.z - kTubeRadius * kTubeRadius,
                    [&](double s) { return o.y + s * d.y >= kTubeLow && o.y + s * d.y <= kTubeHigh; });
  t[4] = smallest_root(across, 2.0 * (p.x * d.x + p.z * d.z) - 4.0 * kBowlFocus * d.y,
                       p.x * p.x + p.z * p.z - 4.0 * kBowlFocus * p.y,
                       [&](double s) { return std::hypot(p.x + s * d.x, p.z + s * d.z) <= kBowlRim; });
  return t;
}

// Every third ray is aimed to touch the ball, every fifth starts inside of it.
void random_ray(uint64_t i, vec3& origin, vec3& direction) {
  const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 4, kSeed) - 1.0; };
  dvec3 o = 1.4 * dvec3(unit(0), unit(1), unit(2)), d = glm::normalize(dvec3(unit(3), unit(4), unit(5)));
  if (i % 5 == 0) o = kBall + 0.5 * kBallRadius * dvec3(unit(0), unit(1), unit(2));
  const dvec3 to = kBall - o;
  if (i % 3 == 0 && glm::length(to) > kBallRadius) {
    // Points of the ball where the view is tangent lie on a cone about `to`.
    const double sine = kBallRadius / glm::length(to) * (1.0 + 1e-5 * unit(6));
    const dvec3 axis = glm::normalize(to), side = glm::normalize(glm::cross(axis, d));
    d = std::sqrt(1.0 - sine * sine) * axis + sine * side;
  }
  origin = vec3(o), direction = vec3(d);
}

TEST(UserGeometry, AllModesFindTheHitsOfTheClosedForms) {
  const Scene scene = surfaces();
  constexpr size_t kRays = 20011;
  const auto rays = std::make_unique<RayBatch<kRays>>();
  for (size_t i = 0; i < kRays; ++i) {
    vec3 origin, direction;
    random_ray(i, origin, direction);
    rays->set(i, origin, direction);
  }
  for (const bool robust : {false, true}) {
    const Tracer tracer(scene, {.robust = robust});
    for (const TraceMode mode : kAllTraceModes) {
      const auto batch = std::make_unique<HitBatch<kRays>>();
      const HitBatch<kRays>& hits = *batch;
      tracer.intersect_batch(rays->lanes(), kRays, batch->lanes(), mode);
      std::array<int, 5> met{};
      int undecided = 0;
      for (size_t i = 0; i < kRays; ++i) {
        const auto truth = closed_forms(scene, dvec3(rays->origin(i)), dvec3(rays->direction(i)));
        const auto best = std::min_element(truth.begin(), truth.end());
        const uint32_t primitive = *best < kNone ? static_cast<uint32_t>(best - truth.begin()) : kNoPrimitive;
        if (hits[i].primitive != primitive) {
          ++undecided;  // counted below
          continue;
        }
        if (primitive == kNoPrimitive) continue;
        ++met[primitive];
        // The tracer's t is the double rounded to float, and triangles are met in float.
        EXPECT_NEAR(hits[i].t, *best, primitive >= 2 ? 2e-7 * std::max(1.0, *best) : 1e-5)
            << label(mode) << " ray " << i << " seed " << kSeed;
      }
      // The schoolbook formula and ours may differ on lines that touch to within 1e-15, and triangles in
      // float near an edge: none of 20,000 by expectation 1e-3.
      EXPECT_LE(undecided, 1) << label(mode);
      for (const int count : met) EXPECT_GT(count, 200) << label(mode);
    }
  }
}

TEST(UserGeometry, SingleRaysTheAllThreadTraceAndOcclusionAgreeWithTheBatch) {
  const Scene scene = surfaces();
  const Tracer tracer(scene, {.robust = true});
  constexpr size_t kRays = 3000;
  RayStream rays;
  rays.resize(kRays);
  for (size_t i = 0; i < kRays; ++i) {
    vec3 o, d;
    random_ray(i, o, d);
    rays.set(i, o, d, static_cast<uint32_t>(i));
  }
  HitStream hits;
  hits.resize(kRays);
  tracer.trace(rays, hits, TraceMode::packet8);
  for (size_t i = 0; i < kRays; ++i) {
    const Hit hit = tracer.intersect(rays.origin(i), rays.direction(i));
    EXPECT_EQ(hit.primitive, hits.primitive[i]) << i;
    if (!hit.valid() || hit.primitive < 2) continue;
    EXPECT_EQ(hit.t, hits.t[i]) << i;
    EXPECT_TRUE(tracer.occluded(rays.origin(i), rays.direction(i), 0.0f, 1.001f * hit.t)) << i;
    EXPECT_FALSE(tracer.occluded(rays.origin(i), rays.direction(i), 0.0f, 0.999f * hit.t)) << i;
  }
}

TEST(UserGeometry, TheIntervalPicksTheFarRoot) {
  Scene scene = test::empty_scene();
  append_analytic(scene, analytic_sphere("ball", 0, dvec3(0), 1.0));  // and no triangle at all
  const Tracer tracer(scene, {});
  const vec3 o(0, 0, 3), d(0, 0, -1);
  EXPECT_FLOAT_EQ(tracer.intersect(o, d).t, 2.0f);
  EXPECT_FLOAT_EQ(tracer.intersect(o, d, 2.5f).t, 4.0f);
  EXPECT_FALSE(tracer.intersect(o, d, 2.5f, 3.5f).valid());
  EXPECT_TRUE(tracer.occluded(o, d, 2.5f, 4.5f));
  EXPECT_FALSE(tracer.occluded(o, d, 2.5f, 3.5f));
  EXPECT_EQ(tracer.intersect(o, d).primitive, 0u);
}

TEST(UserGeometry, ARayThatLeavesASurfacePointDoesNotMeetItAgain) {
  for (const double far : {0.0, 50.0}) {
    Scene scene = test::empty_scene();
    append_analytic(scene, analytic_sphere("ball", 0, {far, 1.5, 0.0}, 1.0));
    const Tracer tracer(scene, {});
    for (uint64_t i = 0; i < 5000; ++i) {
      const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 5, kSeed) - 1.0; };
      const dvec3 target = dvec3(far, 1.5, 0.0) + 0.9 * glm::normalize(dvec3(unit(0), unit(1), unit(2)));
      const vec3 o(static_cast<float>(far + 4.0 * unit(3)), 4.0f, static_cast<float>(4.0 * unit(4)));
      const vec3 d(glm::normalize(target - dvec3(o)));
      const Hit hit = tracer.intersect(o, d);
      ASSERT_TRUE(hit.valid());
      const SurfacePoint p =
          surface_point(scene, hit.primitive, hit.u, hit.v, dvec3(o) + double(hit.t) * dvec3(d));
      const dvec3 outside = p.position + p.offset * p.geometric_normal;
      const dvec3 mirrored = dvec3(d) - 2.0 * glm::dot(dvec3(d), p.geometric_normal) * p.geometric_normal;
      EXPECT_FALSE(tracer.intersect(vec3(outside), vec3(mirrored)).valid()) << i;
      // Straight on, through the ball: one more meeting, at the length of the chord.
      const dvec3 inside = p.position - p.offset * p.geometric_normal;
      const Hit next = tracer.intersect(vec3(inside), d);
      ASSERT_TRUE(next.valid()) << i;
      const double chord = -2.0 * glm::dot(dvec3(d), p.geometric_normal);
      EXPECT_NEAR(next.t, chord, 1e-3) << i;
    }
  }
}

// Two triangles and a ball among bodies of each kind of field.
Scene fields() {
  using Shape = DistanceField::Shape;
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-2, -1.5f, 2), vec3(4, 0, 0), vec3(0, 0, -4));
  append_analytic(scene, analytic_sphere("ball", 0, {0.9, 0.9, 0.0}, 0.3));
  append_analytic(
      scene,
      analytic_field("ring", 0, {-0.7, 0.2, 0.3},
                     {.shape = Shape::torus, .radius = 0.5, .thickness = 0.15, .axis = {0.6, 0, 0.8}}));
  append_analytic(scene,
                  analytic_field("sheet", 0, {0.7, -0.6, -0.4},
                                 {.shape = Shape::gyroid, .radius = 0.6, .thickness = 0.3, .period = 0.5}));
  append_analytic(scene, analytic_field("figure", 0, {-0.4, -0.5, -0.8},
                                        {.shape = Shape::blob, .radius = 0.6, .thickness = 0.15}));
  return scene;
}

TEST(UserGeometry, AllModesMeetFieldsWhereSubdivisionByTheirBoundDoes) {
  const Scene scene = fields();
  constexpr size_t kRays = 3001;
  const auto rays = std::make_unique<RayBatch<kRays>>();
  std::vector<std::pair<double, uint32_t>> truth(kRays, {kNone, kNoPrimitive});
  for (size_t i = 0; i < kRays; ++i) {
    const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 8, kSeed) - 1.0; };
    const dvec3 from = 1.6 * dvec3(unit(0), unit(1), unit(2)), to = dvec3(unit(3), unit(4), unit(5));
    rays->set(i, vec3(from), vec3(glm::normalize(to - from)));
    const dvec3 o(rays->origin(i)), d(rays->direction(i));
    for (uint32_t p = 0; p < scene.primitive_count(); ++p) {
      std::optional<double> t;
      if (p < 3) {
        t = primitive_hit(scene, p, o, d);
      } else {
        const AnalyticSurface& s = scene.analytic_surface(p);
        t = test::first_sign_change([&](double a) { return value(s.field, o + a * d - s.center); }, 0.0, 6.0,
                                    1.0 + 1e-6, 1e-9, value(s.field, o - s.center) < 0.0);
      }
      if (t && *t < truth[i].first) truth[i] = {*t, p};
    }
  }
  for (const bool robust : {false, true}) {
    const Tracer tracer(scene, {.robust = robust});
    for (const TraceMode mode : kAllTraceModes) {
      const auto hits = std::make_unique<HitBatch<kRays>>();
      tracer.intersect_batch(rays->lanes(), kRays, hits->lanes(), mode);
      int differ = 0, met = 0;
      for (size_t i = 0; i < kRays; ++i) {
        const auto& [t, primitive] = truth[i];
        if ((*hits)[i].primitive != primitive) {
          ++differ;
          continue;
        }
        met += primitive != kNoPrimitive && primitive > 2;
        if (primitive == kNoPrimitive) continue;
        EXPECT_NEAR((*hits)[i].t, t, primitive > 2 ? 2e-7 * std::max(1.0, t) : 1e-5) << i;
        EXPECT_TRUE(
            tracer.occluded(rays->origin(i), rays->direction(i), 0.0f, static_cast<float>(1.001 * t + 1e-6)));
      }
      // Triangles in float near an edge.
      EXPECT_LE(differ, 1) << label(mode) << " seed " << kSeed;
      EXPECT_GT(met, 800) << label(mode);
    }
  }
}

TEST(UserGeometry, ARayThatLeavesAFieldDoesNotMeetItWhereItLeft) {
  const Scene scene = fields();
  const Tracer tracer(scene, {});
  int left = 0;
  for (uint64_t i = 0; i < 6000; ++i) {
    const auto unit = [&](uint32_t d) { return 2.0 * random_unit(i, d, 9, kSeed) - 1.0; };
    const vec3 o(dvec3(1.6 * unit(0), 1.6 * unit(1), 1.6 * unit(2)));
    const vec3 d(glm::normalize(dvec3(unit(3), unit(4), unit(5)) - dvec3(o)));
    const Hit hit = tracer.intersect(o, d);
    if (!hit.valid() || hit.primitive < 3) continue;
    const SurfacePoint p =
        surface_point(scene, hit.primitive, hit.u, hit.v, dvec3(o) + double(hit.t) * dvec3(d));
    const double cosine = glm::dot(dvec3(d), p.geometric_normal);
    if (cosine > -0.05) continue;  // from inside, or across a rim
    ++left;
    const Hit next = tracer.intersect(vec3(p.position + p.offset * p.geometric_normal),
                                      vec3(dvec3(d) - 2.0 * cosine * p.geometric_normal));
    EXPECT_FALSE(next.primitive == hit.primitive && next.t < 1e-3f) << i;
  }
  EXPECT_GT(left, 1500);
}

}  // namespace
}  // namespace hybray
