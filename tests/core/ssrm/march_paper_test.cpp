#include "core/ssrm/march_paper.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

constexpr uint64_t kSeed = 64;

TEST(MarchPaper, FindsTheWallThatTheFloorReflects) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-10, 0, 4), vec3(20, 0, 0), vec3(0, 0, -12));
  test::add_rectangle(scene, vec3(-10, 0, -8), vec3(20, 0, 0), vec3(0, 12, 0));
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 2, 3.5f), vec3(0, 1.5f, -8)}, {.width = 160, .height = 100},
                  scene.bounds);
  const test::MainView v(tracer, view);
  const MarchResults results = v.march();
  int right = 0;
  for (size_t i = 0; i < v.rays.size(); ++i) {
    if (v.gbuffer.primitive[v.rays.pixel[i]] > 1) continue;  // from the floor only
    const double t = (-8.0 - v.rays.oz[i]) / v.rays.dz[i];
    const dvec3 p = dvec3(v.rays.origin(i)) + t * dvec3(v.rays.direction(i));
    const dvec2 pixel = view.project(p);
    if (!(v.rays.dz[i] < 0.0f) || p.y > 11.0 || std::abs(p.x) > 9.5 || pixel.y < 2.0 || pixel.x < 2.0 ||
        pixel.x > 158.0)
      continue;
    EXPECT_EQ(results.verdict[i], Verdict::hit) << i;
    if (results.verdict[i] != Verdict::hit) continue;
    // The accepted pixel is the one that holds the true point, or the neighbour on the other side of a border
    // within rounding of it.
    EXPECT_NEAR(results.pixel[i] % 160 + 0.5, pixel.x, 0.501);
    EXPECT_NEAR(results.pixel[i] / 160 + 0.5, pixel.y, 0.501);
    ++right;
  }
  EXPECT_GT(right, 2000);
}

TEST(MarchPaper, EndsInEveryVerdictThatHasACause) {
  const Scene scene = test::triangle_soup(60, 1.5f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  // A near plane amid the triangles, so that rays toward the viewer reach it before they leave the screen.
  const View view(Camera{"c", vec3(0, 0, 3), vec3(0)}, {.width = 320, .height = 200, .near = 2.0},
                  scene.bounds);
  const test::MainView v(tracer, view);
  std::array<size_t, kVerdicts> counts{};
  const MarchResults results = v.march();
  for (size_t i = 0; i < results.size(); ++i) {
    ++counts[static_cast<size_t>(results.verdict[i])];
    EXPECT_EQ(results.verdict[i] == Verdict::hit, results.pixel[i] != kNoPixel);
  }
  for (Verdict verdict : {Verdict::hit, Verdict::miss, Verdict::offscreen, Verdict::viewer, Verdict::behind,
                          Verdict::correction})
    EXPECT_GT(counts[static_cast<size_t>(verdict)], 0u) << label(verdict);
  EXPECT_EQ(counts[static_cast<size_t>(Verdict::budget)], 0u);
}

TEST(MarchPaper, AnExhaustedBudgetIsUnknownAndNeverAHit) {
  const Scene scene = test::triangle_soup(60, 1.5f, 2.0f, kSeed);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 3), vec3(0)}, {.width = 320, .height = 200}, scene.bounds);
  const test::MainView v(tracer, view);
  const MarchResults free = v.march(), bounded = v.march({.step_budget = 6});
  size_t stopped = 0;
  for (size_t i = 0; i < free.size(); ++i) {
    stopped += bounded.verdict[i] == Verdict::budget;
    if (bounded.verdict[i] != Verdict::budget) {
      EXPECT_EQ(bounded.pixel[i], free.pixel[i]);
    }
  }
  EXPECT_GT(stopped, free.size() / 20);
  EXPECT_LE(bounded.steps, 6 * v.rays.size());
  EXPECT_LT(bounded.steps, free.steps);
}

TEST(MarchPaper, ABackgroundPixelIsNeverHit) {
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-3, 0, 3), vec3(6, 0, 0), vec3(0, 0, -6));  // a floor under nothing
  const Tracer tracer(scene, {.robust = true});
  for (DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
    const View view(Camera{"c", vec3(0, 1, 5), vec3(0, 1, 0)},
                    {.width = 200, .height = 200, .convention = convention}, scene.bounds);
    const MarchResults results = test::MainView(tracer, view).march();
    EXPECT_GT(results.size(), 2000u);
    for (Verdict verdict : results.verdict)
      EXPECT_TRUE(verdict == Verdict::miss || verdict == Verdict::offscreen) << label(verdict);
  }
}

}  // namespace
}  // namespace hybray::ssrm
