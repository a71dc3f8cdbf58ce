#include "core/ssrm/hit_checks.h"

#include "core/base/parallel.h"
#include "core/metrics/verdict_table.h"
#include "tests/core/curve_truth.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr HitCheck kChecks[] = {HitCheck::triangle, HitCheck::continuity, HitCheck::conservative,
                                HitCheck::strict};
constexpr uint64_t kSeed = 72;

// A mirror floor before a wall.
Scene floor_and_wall() {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12), 3);
  test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, 0), vec3(0, 12, 0), 5);
  return scene;
}

// Bounds that no ray is in front of, so that every pixel of a path is looked at.
void bound_nothing(SlantedBounds& bounds) {
  for (size_t i = 0; i < bounds.depth.size(); ++i) bounds.set(i, -1e6f, -1e6f, vec2(0.0f));
  bounds.build();
}

struct Checked {
  const Tracer tracer;
  const View view;
  const test::MainView main;
  const truth::RayTruth truth;
  const MarchResults marched;

  Checked(const Scene& scene, const Camera& camera, int width, int height,
          DepthConvention convention = DepthConvention::reversed)
      : tracer(scene, {.robust = true}),
        view(camera, {.width = width, .height = height, .convention = convention}, scene.bounds),
        main(tracer, view),
        truth(truth::trace_truth(tracer, main.rays, view)),
        marched(main.march()) {}

  enum class Bounds { tight, nowhere_clear };
  MarchResults check(HitCheck how, CheckCounts* counts = nullptr, Bounds bounds = Bounds::tight) const {
    MarchResults results = marched;
    const DepthView depth = main.depth();
    PathCheck path(depth, main.rays.size());
    if (bounds == Bounds::tight)
      bound_neighbourhood(depth, path.neighbourhood);
    else
      bound_nothing(path.neighbourhood);
    const CheckCounts c =
        check_hits({depth, main.gbuffer, tracer.scene()}, &path, main.rays, main.screen_rays, how, results);
    if (counts) *counts = c;
    return results;
  }
  metrics::VerdictTable judge(const MarchResults& results,
                              std::vector<metrics::HitClass>* classes = nullptr) const {
    return metrics::judge(results, main.depth(), main.screen_rays, main.rays, truth, main.gbuffer,
                          tracer.scene(), {}, classes);
  }
};

TEST(HitChecks, ARightHitOfAPlanarWallIsNeverRejected) {
  const Scene scene = floor_and_wall();
  for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const Checked c(scene, Camera{"c", vec3(0.3f, 2, 3.5f), vec3(0, 1.5f, -8)}, 320, 200, convention);
    std::vector<metrics::HitClass> classes;
    EXPECT_GT(c.judge(c.marched, &classes).right, 5000u);
    for (const HitCheck how : kChecks) {
      const MarchResults results = c.check(how);
      for (size_t i = 0; i < results.size(); ++i)
        if (classes[i] == metrics::HitClass::right) {
          EXPECT_EQ(results.verdict[i], Verdict::hit) << label(how) << " ray " << i;
        }
    }
  }
}

// A slanted board before the wall: its edges end between pixel centres, and rays that pass behind its plane
// there meet it although the pixel shows the wall.
Scene board_before_wall() {
  Scene scene = floor_and_wall();
  test::add_rectangle(scene, vec3(-1.9f, 0.6f, -5.5f), vec3(2.7f, 0.9f, 0.2f), vec3(-0.3f, 1.4f, 0.1f));
  return scene;
}

TEST(HitChecks, StrictFindsTheEdgesOfABoardThatNoPixelCentreOfThePathShows) {
  const Scene scene = board_before_wall();
  const Checked c(scene, Camera{"c", vec3(0.3f, 2, 3.5f), vec3(0, 1.5f, -8)}, 480, 300);
  const metrics::VerdictTable before = c.judge(c.marched), after = c.judge(c.check(HitCheck::strict));
  EXPECT_GT(before.hits() - before.right, 20u) << "the march alone must be wrong somewhere";
  EXPECT_GT(after.hits(), before.hits() * 95 / 100);
  // Every surface here is large and stored beside every path that meets it.
  EXPECT_EQ(after.hits() - after.right, 0u);
  EXPECT_LT(c.judge(c.check(HitCheck::conservative)).through, before.through);
}

TEST(HitChecks, TheDistanceOfACheckedHitIsTheTracers) {
  const Scene scene = board_before_wall();
  const Checked c(scene, Camera{"c", vec3(0.3f, 2, 3.5f), vec3(0, 1.5f, -8)}, 320, 200);
  const MarchResults results = c.check(HitCheck::strict);
  int compared = 0;
  for (size_t i = 0; i < results.size(); ++i) {
    if (results.verdict[i] != Verdict::hit) continue;
    const double t = c.truth.hits.t[i];
    EXPECT_EQ(c.main.gbuffer.primitive[results.pixel[i]] / 2, c.truth.hits.primitive[i] / 2)
        << "the pixel must store what was met, or the other half of the same cell";
    // Both are rounded to float; Embree's own t is good to a few units of the coordinates, 16 m at most.
    EXPECT_NEAR(results.distance[i], t, 8 * 0x1p-24 * (16.0 + t)) << i;
    ++compared;
  }
  EXPECT_GT(compared, 5000);
}

TEST(HitChecks, AnAnalyticSphereIsMetAtItsClosedForm) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  const dvec3 center(0.2, 1.1, -3.0);
  append_analytic(scene, analytic_sphere("ball", 0, center, 1.0));
  const Checked c(scene, Camera{"c", vec3(0, 1.2f, 2.0f), vec3(0.2f, 0.6f, -3)}, 320, 180);
  const uint32_t ball = static_cast<uint32_t>(scene.triangle_count());
  for (const HitCheck how : {HitCheck::triangle, HitCheck::strict}) {
    const MarchResults results = c.check(how);
    int compared = 0;
    for (size_t i = 0; i < results.size(); ++i) {
      if (results.verdict[i] != Verdict::hit || c.main.gbuffer.primitive[results.pixel[i]] != ball) continue;
      const dvec3 s = dvec3(c.main.rays.origin(i)) - center, d(c.main.rays.direction(i));
      const double a = glm::dot(d, d), b = glm::dot(s, d), q = b * b - a * (glm::dot(s, s) - 1.0);
      ASSERT_GE(q, 0.0);
      EXPECT_NEAR(results.distance[i], (-b - std::sqrt(q)) / a, 1e-6);
      ++compared;
    }
    EXPECT_GT(compared, 500) << label(how);
    const metrics::VerdictTable table = c.judge(results);
    EXPECT_EQ(table.right, table.hits());
  }
}

TEST(HitChecks, ACurveIsMetWhereItsDistanceIsZero) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  RoundCurve post;
  post.control = {vec4(0.2f, -0.1f, -3, 0.5f), vec4(0.2f, 0.9f, -3, 0.45f), vec4(0.4f, 1.6f, -3, 0.35f),
                  vec4(0.8f, 2.2f, -3, 0.2f)};
  append_curve(scene, post);
  const Checked c(scene, Camera{"c", vec3(0, 1.2f, 2.0f), vec3(0.2f, 0.6f, -3)}, 160, 90);
  const auto curve = static_cast<uint32_t>(scene.first_curve());
  const test::CurveTruth truth(post);
  for (const HitCheck how : {HitCheck::triangle, HitCheck::strict}) {
    const MarchResults results = c.check(how);
    int compared = 0;
    for (size_t i = 0; i < results.size(); ++i) {
      if (results.verdict[i] != Verdict::hit || c.main.gbuffer.primitive[results.pixel[i]] != curve) continue;
      const auto t =
          truth.first_hit(dvec3(c.main.rays.origin(i)), dvec3(c.main.rays.direction(i)), 20.0, 1.6);
      ASSERT_TRUE(t.has_value()) << i;
      EXPECT_NEAR(results.distance[i], *t, 2e-6) << i;
      ++compared;
    }
    EXPECT_GT(compared, 60) << label(how);
    const metrics::VerdictTable table = c.judge(results);
    EXPECT_EQ(table.right, table.hits());
  }
}

TEST(HitChecks, OnlyHitsChangeAndTheyBecomeRejectedAndAreCounted) {
  const Scene scene = test::triangle_soup(300, 0.6f, 2.0f, kSeed);
  const Checked c(scene, Camera{"c", vec3(0, 0, 5), vec3(0)}, 333, 217);
  for (const HitCheck how : kChecks) {
    CheckCounts counts;
    const MarchResults results = c.check(how, &counts);
    uint64_t hits = 0, rejected = 0;
    for (size_t i = 0; i < results.size(); ++i) {
      EXPECT_EQ(results.verdict[i] == Verdict::hit, results.pixel[i] != kNoPixel);
      if (c.marched.verdict[i] != Verdict::hit) {
        EXPECT_EQ(results.verdict[i], c.marched.verdict[i]);
        continue;
      }
      ++hits;
      EXPECT_TRUE(results.verdict[i] == Verdict::hit || results.verdict[i] == Verdict::rejected);
      rejected += results.verdict[i] == Verdict::rejected;
    }
    EXPECT_EQ(counts.checked, hits);
    EXPECT_EQ(counts.rejected, rejected);
    EXPECT_GT(rejected, 0u) << label(how);
    EXPECT_LT(rejected, hits) << label(how);
    EXPECT_EQ(counts.steps > 0, checks_path(how));
  }
}

TEST(HitChecks, OneThreadAndAllGiveTheSame) {
  const Scene scene = test::triangle_soup(300, 0.6f, 2.0f, kSeed);
  const Checked c(scene, Camera{"c", vec3(0, 0, 5), vec3(0)}, 333, 217);
  for (const HitCheck how : kChecks) {
    CheckCounts many, one;
    const MarchResults all = c.check(how, &many);
    const ThreadLimit limit(1);
    const MarchResults alone = c.check(how, &one);
    EXPECT_EQ(all.verdict, alone.verdict);
    EXPECT_EQ(all.pixel, alone.pixel);
    EXPECT_EQ(all.distance, alone.distance);
    EXPECT_EQ(many.steps, one.steps);
  }
}

TEST(HitChecks, ACreaseIsContinuousAndAStepToTheFrontIsNot) {
  Scene scene = test::empty_scene();
  // A roof whose ridge faces the viewer, and a board far in front of its right half.
  test::add_rectangle(scene, vec3(-6, -3, -8), vec3(6, 0, 3), vec3(0, 6, 0));
  test::add_rectangle(scene, vec3(0, -3, -5), vec3(6, 0, -3), vec3(0, 6, 0));
  test::add_rectangle(scene, vec3(1.02f, -3, 0), vec3(6, 0, 0), vec3(0, 6, 0));
  const Checked c(scene, Camera{"c", vec3(0, 0, 3), vec3(0, 0, -8)}, 128, 64);
  const GBuffer& g = c.main.gbuffer;
  int creases = 0, steps = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x + 1 < 128; ++x) {
      const uint32_t left = g.primitive(x, y) / 2, right = g.primitive(x + 1, y) / 2;
      if (g.primitive(x, y) == kNoPrimitive || g.primitive(x + 1, y) == kNoPrimitive) continue;
      const bool step = left != 2 && right == 2;
      EXPECT_EQ(continuous_or_behind(c.main.depth(), {x, y}, {x + 1, y}), !step) << x << " " << y;
      EXPECT_TRUE(continuous_or_behind(c.main.depth(), {x + 1, y}, {x, y})) << "what lies behind is no doubt";
      creases += left == 0 && right == 1;
      steps += step;
    }
  EXPECT_GT(creases, 20);
  EXPECT_GT(steps, 20);
}

// Depth, at offset (dx, dy) from a pixel's centre, of the nearest plane seen in its 3x3 block.
double nearest_of_block(const DepthView& depth, int x, int y, double dx, double dy) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int ny = std::max(0, y - 1); ny <= std::min(depth.height() - 1, y + 1); ++ny)
    for (int nx = std::max(0, x - 1); nx <= std::min(depth.width() - 1, x + 1); ++nx) {
      const dvec2 d = double(depth.depth_sign) * dvec2(depth.derivatives(nx, ny));
      nearest = std::min(nearest, depth.pyramid.at(0, nx, ny) + d.x * (x + dx - nx) + d.y * (y + dy - ny));
    }
  return nearest;
}

TEST(NeighbourhoodBounds, AreNowhereBehindThePlanesOfTheBlockAndReachThemOnOneSurface) {
  const Scene scene = test::triangle_soup(60, 1.5f, 2.0f, kSeed);
  for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const Checked c(scene, Camera{"c", vec3(0, 0, 5), vec3(0)}, 65, 33, convention);
    const DepthView depth = c.main.depth();
    SlantedBounds bounds(65, 33);
    bound_neighbourhood(depth, bounds);
    int covered = 0, reached = 0;
    for (int y = 0; y < 33; ++y)
      for (int x = 0; x < 65; ++x) {
        const double center = bounds.depth(x, y);
        const dvec2 slope(bounds.slopes(x, y));
        double least = std::numeric_limits<double>::infinity();
        for (const double dx : {-0.5, 0.0, 0.5})
          for (const double dy : {-0.5, 0.0, 0.5}) {
            const double nearest = nearest_of_block(depth, x, y, dx, dy);
            EXPECT_EQ(std::isinf(nearest), std::isinf(center));
            if (std::isinf(center)) continue;
            const double gap = nearest - (center + slope.x * dx + slope.y * dy);
            EXPECT_GE(gap, -1e-15 * std::abs(nearest)) << x << " " << y;
            least = std::min(least, gap);
          }
        if (std::isinf(center)) continue;
        ++covered;
        // One rounding of the depth to float: no bound is lower than the planes ask for, but where they
        // cross.
        reached += least <= 0x1p-23 * std::abs(center);
      }
    EXPECT_GT(covered, 500);
    EXPECT_GT(reached, covered / 2);
  }
}

TEST(HitChecks, BoundsTakeNothingFromTheSearchOfEveryPixel) {
  for (const char* name : {"sphere", "street"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    for (const Camera& camera : scene.cameras)
      for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
        const Checked c(scene, camera, 211, 119, convention);
        for (const HitCheck how : {HitCheck::conservative, HitCheck::strict}) {
          CheckCounts few, many;
          const MarchResults bounded = c.check(how, &few),
                             everywhere = c.check(how, &many, Checked::Bounds::nowhere_clear);
          EXPECT_EQ(bounded.verdict, everywhere.verdict) << name << " " << camera.name << " " << label(how);
          EXPECT_EQ(bounded.pixel, everywhere.pixel) << name << " " << camera.name << " " << label(how);
          EXPECT_EQ(bounded.distance, everywhere.distance);
          EXPECT_LT(few.steps, many.steps);
        }
      }
  }
}

TEST(HitChecks, RunAtOnePixelAndOnALine) {
  const Scene scene = board_before_wall();
  for (const auto& [w, h] : {std::pair{1, 1}, {64, 1}, {1, 64}}) {
    const Checked c(scene, Camera{"c", vec3(0.3f, 2, 3.5f), vec3(0, 1.5f, -8)}, w, h);
    for (const HitCheck how : kChecks) EXPECT_EQ(c.check(how).size(), c.marched.size());
  }
}

}  // namespace
}  // namespace hybray::ssrm
