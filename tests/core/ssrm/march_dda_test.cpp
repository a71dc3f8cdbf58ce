#include "core/ssrm/march_dda.h"

#include "core/metrics/verdict_table.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr uint64_t kSeed = 73;

MarchResults march(const test::MainView& v, const DdaOptions& options) {
  MarchResults results;
  results.resize(v.rays.size());
  march_dda(v.depth(), v.gbuffer.view, v.rays, v.screen_rays, options, results);
  return results;
}

// The same walk in world space: points of the world ray, found by solving for the screen position, are
// projected, and their view depths compared. Nothing of the marcher's arithmetic is used. `margin`, metres or
// pixels, is set to how close the walk came to another outcome.
Verdict walk_in_the_world(const test::MainView& v, size_t i, const DdaOptions& options, uint32_t& pixel,
                          double& margin) {
  const View& view = v.gbuffer.view;
  const dvec3 o(v.rays.origin(i)), d(v.rays.direction(i));
  const dvec2 from = view.project(o);
  const double w0 = view.view_depth(o), w1 = glm::dot(d, view.forward());
  // Screen velocity at the origin; a point s pixels along the longer axis lies where a perspective line does.
  const dvec2 rate = view.focal() / w0 * dvec2(glm::dot(d, view.right()), glm::dot(d, view.down())) -
                     w1 / w0 * (from - 0.5 * dvec2(view.width(), view.height()));
  const double longer = std::max(std::abs(rate.x), std::abs(rate.y));
  const double l_end = v.screen_rays.l_end[i];
  const auto distance = [&](double l) { return l / (1.0 - l * w1 / w0); };
  const auto depth_at = [&](double l) { return view.view_depth(o + distance(l) * d); };
  margin = 1e30;
  double before = w0;
  for (int n = 1;; ++n) {
    const double l = n * options.stride / longer;
    margin = std::min(margin, std::abs(l - l_end) * longer);
    if (l_end < l) return v.screen_rays.end[i];
    const dvec2 p = view.project(o + distance(l) * d);
    for (const double c : {p.x, p.y}) margin = std::min(margin, std::abs(c - std::round(c)));
    if (p.x < 0 || p.y < 0 || p.x >= view.width() || p.y >= view.height()) return Verdict::offscreen;
    const double after = depth_at(std::min(l + 0.5 * options.stride / longer, l_end));
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    if (v.gbuffer.primitive(x, y) != kNoPrimitive) {
      const double surface = view.view_depth_of(v.gbuffer.depth(x, y));
      const double low = std::min(before, after), high = std::max(before, after);
      for (const double gap : {high - surface, surface + options.thickness - low})
        margin = std::min(margin, std::abs(gap));
      pixel = static_cast<uint32_t>(y * view.width() + x);
      if (high >= surface && low <= surface + options.thickness && pixel != v.rays.pixel[i])
        return Verdict::hit;
    }
    before = after;
  }
}

TEST(MarchDda, EqualsAWalkAlongTheWorldRay) {
  const Scene scene = test::triangle_soup(80, 1.2f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View view(Camera{"c", vec3(0, 0, 5), vec3(0)},
                    {.width = 333, .height = 217, .convention = convention}, scene.bounds);
    const test::MainView v(tracer, view);
    for (const DdaOptions& options : {DdaOptions{0.05, 1.0}, DdaOptions{0.5, 1.0}, DdaOptions{0.2, 3.0}}) {
      const MarchResults results = march(v, options);
      size_t compared = 0, hits = 0;
      for (size_t i = 0; i < v.rays.size(); ++i) {
        uint32_t pixel = kNoPixel;
        double margin = 0.0;
        const Verdict expected = walk_in_the_world(v, i, options, pixel, margin);
        // Screen rays are rounded to float: 2^-24 of some 300 pixels, and of 10 m at ten times the standard
        // convention's loss.
        if (margin < 1e-3) continue;
        ASSERT_EQ(results.verdict[i], expected) << "seed " << kSeed << " ray " << i;
        if (expected == Verdict::hit) {
          ASSERT_EQ(results.pixel[i], pixel) << "seed " << kSeed << " ray " << i;
        }
        ++compared;
        hits += expected == Verdict::hit;
      }
      EXPECT_GT(compared, v.rays.size() / 4);
      EXPECT_GT(hits, 300u);
    }
  }
}

Scene floor_and_wall() {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, 0), vec3(0, 12, 0));
  return scene;
}
const Camera kBeforeTheWall{"c", vec3(0, 2, 3.5f), vec3(0, 1.5f, -8)};

TEST(MarchDda, FindsTheWallThatTheFloorReflectsAtTheRightDistance) {
  const Scene scene = floor_and_wall();
  const Tracer tracer(scene, {.robust = true});
  const View view(kBeforeTheWall, {.width = 160, .height = 100}, scene.bounds);
  const test::MainView v(tracer, view);
  const MarchResults results = march(v, {0.5, 1.0});
  int right = 0;
  for (size_t i = 0; i < v.rays.size(); ++i) {
    if (v.gbuffer.primitive[v.rays.pixel[i]] > 1 || !(v.rays.dz[i] < 0.0f)) continue;  // from the floor only
    const double t = (-8.0 - v.rays.oz[i]) / v.rays.dz[i];
    const dvec3 p = dvec3(v.rays.origin(i)) + t * dvec3(v.rays.direction(i));
    const dvec2 at = view.project(p);
    if (p.y > 11.0 || std::abs(p.x) > 9.5 || at.y < 2.0 || at.x < 2.0 || at.x > 158.0) continue;
    ASSERT_EQ(results.verdict[i], Verdict::hit) << i;
    // A sample stands for half a pixel to each side, so that the one before or after may be taken.
    EXPECT_NEAR(results.pixel[i] % 160 + 0.5, at.x, 1.01);
    EXPECT_NEAR(results.pixel[i] / 160 + 0.5, at.y, 1.01);
    ++right;
  }
  EXPECT_GT(right, 2000);
}

TEST(MarchDda, PassesBehindAThinBoardAndStopsInAThickOne) {
  Scene scene = floor_and_wall();
  test::add_rectangle(scene, vec3(-1, 1.0f, -3), vec3(2, 0, 0), vec3(0, 1.0f, 0));
  const Tracer tracer(scene, {.robust = true});
  const View view(kBeforeTheWall, {.width = 320, .height = 200}, scene.bounds);
  const test::MainView v(tracer, view);
  const auto on_board = [&](const MarchResults& r) {
    size_t n = 0;
    for (size_t i = 0; i < r.size(); ++i)
      n += r.verdict[i] == Verdict::hit && v.gbuffer.primitive[r.pixel[i]] / 2 == 2;
    return n;
  };
  // Rays that the floor sends under the board and up behind it lie up to 5 m behind its depth.
  const size_t thin = on_board(march(v, {0.05, 1.0})), thick = on_board(march(v, {6.0, 1.0}));
  EXPECT_GT(thin, 20u) << "some rays truly hit it";
  EXPECT_GT(thick, 2 * thin);
}

TEST(MarchDda, ABudgetEndsInBudgetAndStridesSaveSteps) {
  const Scene scene = floor_and_wall();
  const Tracer tracer(scene, {.robust = true});
  const test::MainView v(tracer, View(kBeforeTheWall, {.width = 160, .height = 100}, scene.bounds));
  const MarchResults bounded = march(v, {0.1, 1.0, 5}), fine = march(v, {0.1, 1.0}),
                     coarse = march(v, {0.1, 4.0});
  EXPECT_GT(std::count(bounded.verdict.begin(), bounded.verdict.end(), Verdict::budget), 1000);
  EXPECT_LE(bounded.steps, 5 * v.rays.size());
  EXPECT_EQ(std::count(fine.verdict.begin(), fine.verdict.end(), Verdict::budget), 0);
  EXPECT_LT(coarse.steps, fine.steps / 3);
}

TEST(MarchDda, EndsAtOnePixelAndOnALine) {
  const Scene scene = floor_and_wall();
  const Tracer tracer(scene, {.robust = true});
  for (const auto& [w, h] : {std::pair{1, 1}, {64, 1}, {1, 64}}) {
    const test::MainView v(tracer, View(kBeforeTheWall, {.width = w, .height = h}, scene.bounds));
    for (const Verdict verdict : march(v, {1e9, 1024.0}).verdict) EXPECT_NE(verdict, Verdict::budget);
  }
}

}  // namespace
}  // namespace hybray::ssrm
