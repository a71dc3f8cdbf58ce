// Rays that start where a march has proved emptiness, against the same rays from their origins, in Embree.
#include "core/ssrm/remaining_segment.h"

#include "core/ssrm/hybrid.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

TEST(RemainingSegment, ExactChangesNoHitAndNoCertifiedMissHitsAnything) {
  size_t started = 0, certified = 0, rays = 0;
  for (const char* name : {"sphere", "atrium", "street"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    const Tracer robust(scene, {.robust = true}), fast(scene, {});
    for (const Camera& camera : scene.cameras)
      for (const auto& [width, height] : {std::pair(333, 217), {64, 1}, {1, 1}})
        for (const DepthConvention convention : {DepthConvention::reversed, DepthConvention::standard}) {
          if (convention == DepthConvention::standard && width == 333) continue;
          const View view(camera, {.width = width, .height = height, .convention = convention}, scene.bounds);
          const test::MainView v(robust, view);
          const size_t n = v.rays.size();
          std::vector<uint32_t> all(n);
          for (uint32_t i = 0; i < n; ++i) all[i] = i;
          ExactSegments scalar(view, n), lanes(view, n);
          build_conservative(v.gbuffer, scene, scalar), build_conservative(v.gbuffer, scene, lanes);
          exact_segments(v.gbuffer, scene, v.rays, v.screen_rays, all, MarchCode::scalar, scalar);
          exact_segments(v.gbuffer, scene, v.rays, v.screen_rays, all, MarchCode::lanes, lanes);
          EXPECT_EQ(lanes.t_near, scalar.t_near);
          EXPECT_EQ(lanes.misses, scalar.misses);
          EXPECT_EQ(lanes.results.steps, scalar.results.steps);
          for (size_t i = 0; i < n; ++i) started += lanes.t_near[i] > 0.0f, certified += lanes.misses[i] != 0;
          rays += n;
          HitStream from_origin, from_there;
          from_origin.resize(n), from_there.resize(n);
          for (const Tracer* tracer : {&robust, &fast})
            for (const TraceMode mode : kAllTraceModes) {
              tracer->trace_some(v.rays, all, from_origin, mode);
              tracer->trace_some(v.rays, all, from_there, mode, lanes.t_near);
              size_t changed = 0, missed = 0;
              for (size_t i = 0; i < n; ++i) {
                changed += mode == TraceMode::single ? from_origin.t[i] != from_there.t[i]
                                                     : answers_differ(from_origin.t[i], from_there.t[i]);
                missed += lanes.misses[i] && from_origin.primitive[i] != kNoPrimitive;
              }
              EXPECT_EQ(changed, 0u) << name << " " << camera.name << " " << label(mode) << " " << width
                                     << " of " << n;
              EXPECT_EQ(missed, 0u) << name << " " << camera.name << " " << label(mode) << " " << width;
            }
        }
  }
  EXPECT_GT(started, rays / 20) << "of " << rays;
  EXPECT_GT(certified, 100u);
}

TEST(RemainingSegment, AnswersDifferByMoreThanRoundingOrByMissing) {
  const float miss = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(answers_differ(miss, miss));
  EXPECT_TRUE(answers_differ(2.0f, miss));
  EXPECT_TRUE(answers_differ(miss, 2.0f));
  EXPECT_FALSE(answers_differ(2.0f, std::nextafter(2.0f, 3.0f)));
  EXPECT_TRUE(answers_differ(2.0f, 2.0f + 0x1p-18f));
}

TEST(RemainingSegment, WhatAMarchProvedIsInFrontOfTheHitWhereOneSurfaceFillsTheView) {
  // A wall seen through a floor's mirror: the true distance is known, and no segment passes it.
  Scene scene = test::empty_scene();
  test::add_rectangle(scene, vec3(-20, 0, 20), vec3(40, 0, 0), vec3(0, 0, -40), 5);
  test::add_rectangle(scene, vec3(-20, 0, -6), vec3(40, 0, 0), vec3(0, 20, 0), 5);
  const Tracer tracer(scene, {.robust = true});
  const View view(Camera{"c", vec3(0.1f, 2.0f, 6.0f), vec3(0, 1.0f, -6)}, {.width = 160, .height = 120},
                  scene.bounds);
  const test::MainView v(tracer, view);
  std::vector<uint32_t> floor;
  for (uint32_t i = 0; i < v.rays.size(); ++i)
    if (v.gbuffer.primitive[v.rays.pixel[i]] < 50 && v.rays.dz[i] < 0.0f) floor.push_back(i);
  ASSERT_GT(floor.size(), 1000u);
  ExactSegments s(view, v.rays.size());
  build_conservative(v.gbuffer, scene, s);
  exact_segments(v.gbuffer, scene, v.rays, v.screen_rays, floor, MarchCode::lanes, s);
  double proved = 0.0;
  size_t count = 0;
  for (const uint32_t i : floor) {
    const double t = (-6.0 - v.rays.oz[i]) / v.rays.dz[i];  // where it meets the wall
    const double y = v.rays.oy[i] + t * v.rays.dy[i];
    if (y > 19.0) continue;
    ASSERT_LE(s.t_near[i], t);
    proved += s.t_near[i] / t, ++count;
  }
  EXPECT_GT(proved / static_cast<double>(count), 0.8) << "mean share of the way, " << count << " rays";
}

}  // namespace
}  // namespace hybray::ssrm
