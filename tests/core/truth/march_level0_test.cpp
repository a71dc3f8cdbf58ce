#include "core/truth/march_level0.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

using ssrm::Verdict;

// The march written the other way round: every pixel of the screen is clipped against the ray by itself, in
// double; the first one along the ray whose stored depth the ray gets behind is the stop. Nothing is shared
// with the walk but the verdict names.
struct Stop {
  Verdict verdict = Verdict::miss;  // hit stands for "stopped at a pixel"
  uint32_t pixel = ssrm::kNoPixel;
  double slack = 1e30;  // how clear the decisions near the stop were, relative
};

Stop clip_every_pixel(const ssrm::DepthView& view, const ssrm::ScreenRay<double>& r, uint32_t own) {
  const int w = view.width(), h = view.height();
  Stop best;
  double first = r.l_end, screen_exit = 1e30;
  const auto edge = [&](double o, double d, double size) {
    screen_exit = std::min(screen_exit, ((d > 0 ? size : 0.0) - o) / d);
  };
  edge(r.ox, r.dx, w);
  edge(r.oy, r.dy, h);
  best.verdict = screen_exit < r.l_end ? Verdict::offscreen : r.end;
  best.slack = std::abs(screen_exit - r.l_end) / r.l_end;
  first = std::min(first, screen_exit);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const uint32_t index = static_cast<uint32_t>(y * w + x);
      if (index == own) continue;
      const double ax = (x - r.ox) / r.dx, bx = (x + 1 - r.ox) / r.dx, ay = (y - r.oy) / r.dy,
                   by = (y + 1 - r.oy) / r.dy;
      const double enter = std::max(std::min(ax, bx), std::min(ay, by)),
                   leave = std::min({std::max(ax, bx), std::max(ay, by), r.l_end});
      if (!(leave > enter) || leave <= 0.0) continue;
      const double farthest = r.oz + std::max(enter * r.dz, leave * r.dz), stored = view.pyramid.at(0, x, y);
      const double length = (leave - enter) / leave,
                   clearance = std::abs(farthest - stored) / (std::abs(stored) + 1e-30);
      if (enter <= first) best.slack = std::min({best.slack, length, std::isinf(stored) ? 1.0 : clearance});
      if (farthest > stored && enter < first) {
        first = enter;
        best.verdict = Verdict::hit;
        best.pixel = index;
      }
    }
  return best;
}

TEST(MarchLevel0, StopsWhereClippingEveryPixelByItselfStops) {
  const Scene scene = test::triangle_soup(80, 1.2f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0.2f, 0.1f, 3.5f), vec3(0)}, {.width = 48, .height = 33}, scene.bounds);
  const test::MainView v(tracer, view);
  int compared = 0, stopped = 0;
  for (size_t i = 0; i < v.rays.size(); ++i) {
    const auto ray = v.screen_rays.get<double>(i);
    const Stop expected = clip_every_pixel(v.depth(), ray, v.rays.pixel[i]);
    if (expected.slack < 1e-9) continue;  // too close to call in any arithmetic
    uint64_t steps = 0;
    std::vector<Decision> log;
    const ssrm::Correction got = march_level0_ray(v.depth(), ray, v.rays.pixel[i], steps, &log);
    const bool got_stop =
        got.verdict == Verdict::hit || got.verdict == Verdict::behind || got.verdict == Verdict::correction;
    EXPECT_EQ(got_stop, expected.verdict == Verdict::hit)
        << i << ssrm::label(got.verdict) << ssrm::label(expected.verdict);
    if (!got_stop) {
      EXPECT_EQ(got.verdict, expected.verdict) << i;
    }
    if (got.verdict == Verdict::hit) {
      // The accepted pixel is the stop or touches it.
      const int dx = static_cast<int>(got.pixel % 48) - static_cast<int>(expected.pixel % 48);
      const int dy = static_cast<int>(got.pixel / 48) - static_cast<int>(expected.pixel / 48);
      EXPECT_LE(std::max(std::abs(dx), std::abs(dy)), 1) << i;
    }
    ++compared;
    stopped += got_stop;
  }
  EXPECT_GT(compared, 800);
  EXPECT_GT(stopped, 300);
}

TEST(MarchLevel0, AStrideMarchesEveryNthRay) {
  const Scene scene = test::triangle_soup(80, 1.2f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0, 0, 3.5f), vec3(0)}, {.width = 48, .height = 33}, scene.bounds);
  const test::MainView v(tracer, view);
  const auto all = march_level0<double>(v.depth(), v.screen_rays, v.rays.pixel);
  const auto some = march_level0<double>(v.depth(), v.screen_rays, v.rays.pixel, 7);
  ASSERT_EQ(some.size(), (all.size() + 6) / 7);
  for (size_t j = 0; j < some.size(); ++j) EXPECT_EQ(some.verdict[j], all.verdict[7 * j]);
}

TEST(FirstDifferenceMargin, MeasuresHowCloseTheDecisionWasThatFloatGotWrong) {
  // One row of pixels; the ray leaves pixel 1 at l = 1.5 with a rise that float rounds across the stored
  // depth.
  DepthPyramid pyramid(8, 1);
  Image2D<float> depth(8, 1, 0.9f);
  const float dz = 0.1f;
  depth(1, 0) = static_cast<float>(
      1.5 * static_cast<double>(dz));  // rounded: the exact product lies within half an ulp
  pyramid.build(depth, 1, 1.0f);
  const Image2D<vec2> derivatives(8, 1);
  ssrm::ScreenRays rays;
  rays.resize(1);
  rays.ox[0] = 0.5f, rays.oy[0] = 0.5f, rays.oz[0] = 0.0f, rays.dx[0] = 1.0f, rays.dy[0] = 0x1p-126f,
  rays.dz[0] = dz;
  rays.l_end[0] = 100.0f;
  rays.end[0] = Verdict::miss;
  const double margin = first_difference_margin({pyramid, derivatives, 1}, rays, 0, 0);
  EXPECT_LE(margin, 0.5) << "the two marches part at the rounded comparison";
  depth(1, 0) = 0.5f;
  pyramid.build(depth, 1, 1.0f);
  EXPECT_TRUE(std::isinf(first_difference_margin({pyramid, derivatives, 1}, rays, 0, 0)))
      << "no decision is close";
}

}  // namespace
}  // namespace hybray::truth
