#include "core/ssrm/next_bounce.h"

#include "core/ssrm/predictor.h"
#include "core/truth/ray_truth.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

// Two parallel mirrors, floor y = 0 and ceiling y = 4, 40 m square, seen lengthwise by a camera between.
class ParallelMirrors : public testing::TestWithParam<Marcher> {
 protected:
  static constexpr double kHeight = 4.0, kHalf = 20.0;
  static Scene corridor() {
    Scene scene = test::empty_scene();
    test::add_rectangle(scene, vec3(-20, 0, 20), vec3(40, 0, 0), vec3(0, 0, -40));
    test::add_rectangle(scene, vec3(-20, 4, -20), vec3(40, 0, 0), vec3(0, 0, 40));
    return scene;
  }
  const Scene scene_ = corridor();
  const Tracer tracer_{scene_, {.robust = true}};
  const View view_{
      Camera{"c", vec3(1, 1.7f, 18), vec3(0, 1.9f, -20)}, {.width = 180, .height = 120}, scene_.bounds};
  const test::MainView v_{tracer_, view_};
};

TEST_P(ParallelMirrors, SendEveryPathWhereTheClosedFormDoes) {
  RayStream rays = v_.rays;
  ScreenRays screen_rays = v_.screen_rays;
  size_t resolved = 0, traced = 0, checked = 0;
  for (int bounce = 1; bounce <= 3; ++bounce) {
    MarchResults results;
    results.resize(rays.size());
    march(v_.depth(), screen_rays, rays.pixel, {.marcher = GetParam()}, results);
    HitStream hits;
    hits.resize(rays.size());
    tracer_.trace(rays, hits, TraceMode::single);
    const NextBounce next = next_bounce(v_.gbuffer, scene_, v_.depth(), rays, screen_rays, results, hits);
    EXPECT_EQ(next.about_geometric_normal, 0u);
    size_t j = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      // From mirror to mirror a ray goes kHeight / |dy| far.
      const dvec3 o(rays.origin(i)), d(rays.direction(i));
      const double wall = d.y > 0.0 ? kHeight : 0.0;
      const dvec3 p = o + d * ((wall - o.y) / d.y);
      const double beyond = std::max(std::abs(p.x), std::abs(p.z)) - kHalf;
      const bool goes_on = results.verdict[i] == Verdict::hit || hits.primitive[i] != kNoPrimitive;
      const double w = view_.view_depth(p), pixel = w / view_.focal() / std::abs(d.y);
      // Pixels at the rim show the mirror at their centre and not all over: within two of them either may be.
      if (std::abs(beyond) > 2.0 * pixel + 0.05) {
        EXPECT_EQ(goes_on, beyond < 0.0) << bounce << ' ' << i;
      }
      if (!goes_on) continue;
      if (beyond > 0.0) {
        ++j;
        continue;
      }
      ASSERT_LT(j, next.rays.size());
      const dvec3 at(next.rays.origin(j)), to(next.rays.direction(j));
      // Screen rays are rounded to 2^-24: on 180 pixels 1e-5 pixels, each at most w / focal / sin(angle) long
      // on the mirror; twice that, and the offset off the surface of 2^-19 of 40 m.
      const double slack = 2e-5 * pixel + 1e-4;
      EXPECT_NEAR(glm::length(at - p), 0.0, slack * (1.0 + w)) << bounce << ' ' << i;
      EXPECT_NEAR(glm::length(to - dvec3(d.x, -d.y, d.z)), 0.0, 1e-6) << bounce << ' ' << i;
      EXPECT_GT(d.y > 0.0 ? kHeight - at.y : at.y, 0.0) << "off the mirror, toward the other";
      ++(results.verdict[i] == Verdict::hit ? resolved : traced);
      ++checked, ++j;
    }
    EXPECT_EQ(j, next.rays.size());
    rays = next.rays, screen_rays = next.screen_rays;
  }
  // Both ways into the next bounce were taken.
  EXPECT_GT(resolved, 300u);
  EXPECT_GT(traced, 300u);
}

TEST_P(ParallelMirrors, MarchFromTracedHitsThatTheViewShowsAndFromNoOthers) {
  MarchResults none;  // as if nothing had been resolved
  none.resize(v_.rays.size());
  std::fill(none.verdict.begin(), none.verdict.end(), Verdict::offscreen);
  std::fill(none.pixel.begin(), none.pixel.end(), kNoPixel);
  HitStream hits;
  hits.resize(v_.rays.size());
  tracer_.trace(v_.rays, hits, TraceMode::single);
  const truth::RayTruth truth = truth::trace_truth(tracer_, v_.rays, view_);
  const NextBounce next = next_bounce(v_.gbuffer, scene_, v_.depth(), v_.rays, v_.screen_rays, none, hits);
  MarchResults results;
  results.resize(next.rays.size());
  march(v_.depth(), next.screen_rays, next.rays.pixel, {.marcher = GetParam()}, results);
  size_t j = 0, differ = 0, unseen = 0;
  for (size_t i = 0; i < v_.rays.size(); ++i) {
    if (hits.primitive[i] == kNoPrimitive) continue;
    const bool marched = std::isfinite(next.screen_rays.l_end[j]);
    differ += marched != (truth.visible[i] != 0);
    unseen += !marched;
    if (!marched) {
      EXPECT_EQ(results.verdict[j], Verdict::offscreen);
    }
    ++j;
  }
  EXPECT_EQ(j, next.rays.size());
  EXPECT_EQ(unseen, next.unseen);
  EXPECT_GT(unseen, 0u);
  // The mirrors consist of two triangles each: a pixel that the diagonal crosses shows one of them. About one
  // in a row does.
  EXPECT_LE(differ, static_cast<size_t>(4 * (180 + 120)));
  // The lanes treat rays that are not marched in the same way.
  MarchResults lanes;
  lanes.resize(next.rays.size());
  const MarchOptions options{.code = MarchCode::lanes, .marcher = GetParam()};
  march(v_.depth(), next.screen_rays, next.rays.pixel, options, lanes);
  EXPECT_EQ(lanes.verdict, results.verdict);
  EXPECT_EQ(lanes.pixel, results.pixel);
  // Runs of this stream are no tiles; what a predictor marches of it ends the same all the same.
  const DepthView depth = v_.depth();
  Prediction prediction;
  march_by_sample({depth, next.screen_rays, next.rays.pixel, options}, 0.4, lanes, prediction);
  EXPECT_GT(prediction.marched, next.rays.size() / 10);
  EXPECT_LT(prediction.marched, next.rays.size());
  size_t wrong = 0, left = 0;
  for (size_t i = 0; i < results.size(); ++i) {
    left += lanes.verdict[i] == Verdict::budget;
    wrong += lanes.verdict[i] != Verdict::budget &&
             (lanes.verdict[i] != results.verdict[i] || lanes.pixel[i] != results.pixel[i]);
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(left + prediction.marched, next.rays.size());
}

INSTANTIATE_TEST_SUITE_P(Marchers, ParallelMirrors, testing::Values(Marcher::paper, Marcher::plane),
                         [](const auto& test) {
                           return std::string(test.param == Marcher::plane ? "Plane" : "Paper");
                         });

}  // namespace
}  // namespace hybray::ssrm
