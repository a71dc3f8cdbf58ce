// The march in lanes against the scalar one: verdict, pixel, proved distance and number of samples of every
// ray.
#include "core/ssrm/march_lanes.h"

#include "core/base/lanes.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

void expect_same(const MarchResults& lanes, const MarchResults& scalar, const std::string& what) {
  EXPECT_EQ(lanes.steps, scalar.steps) << what;
  size_t different = 0;
  for (size_t i = 0; i < scalar.size(); ++i)
    different += lanes.verdict[i] != scalar.verdict[i] || lanes.pixel[i] != scalar.pixel[i] ||
                 (!scalar.proved.empty() && lanes.proved[i] != scalar.proved[i]);
  EXPECT_EQ(different, 0u) << what << ", of " << scalar.size();
}

TEST(MarchLanes, EndAsTheScalarMarchDoesOnEveryInstructionSet) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  size_t rays = 0;
  for (const auto& [width, height] : {std::pair(333, 217), {640, 360}, {97, 3}, {64, 1}, {1, 1}})
    for (const DepthConvention convention : {DepthConvention::standard, DepthConvention::reversed}) {
      const View view(Camera{"c", vec3(0, 0.5f, 3), vec3(0)},
                      {.width = width, .height = height, .near = 0.5, .convention = convention},
                      scene.bounds);
      const test::MainView v(tracer, view);
      rays += v.rays.size();
      for (const uint64_t budget : {0, 1, 2, 7, 40}) {
        MarchResults scalar = v.march({.step_budget = budget});
        scalar.ask_proved();
        march_paper(v.depth(), v.screen_rays, v.rays.pixel, {.step_budget = budget}, scalar);
        for (const std::string& target : lanes_targets()) {
          use_lanes_target(target);
          MarchResults lanes;
          lanes.resize(v.rays.size());
          lanes.ask_proved();
          march_paper_lanes(v.depth(), v.screen_rays, v.rays.pixel, {.step_budget = budget}, lanes);
          expect_same(lanes, scalar, target + " " + std::to_string(width) + " " + std::to_string(budget));
        }
        use_lanes_target("");
      }
    }
  EXPECT_GT(rays, 50000u);
}

TEST(MarchLanes, AListMarchesItsRaysAsTheFullMarchDoesAndTouchesNoOther) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  const test::MainView v(tracer, View(Camera{"c", vec3(0, 0.5f, 3), vec3(0)},
                                      {.width = 333, .height = 217, .near = 0.5}, scene.bounds));
  const MarchResults full = v.march();
  constexpr uint64_t kSeed = 5;
  std::vector<uint32_t> list;
  for (uint32_t i = 0; i < full.size(); ++i)
    if (random_unit(i, 0, 0, kSeed) < 0.3) list.push_back(i);
  std::reverse(list.begin(), list.end());  // any order
  for (const std::vector<uint32_t>& which : {list, {list[7]}, std::vector<uint32_t>{}}) {
    for (const std::string& target : {std::string("scalar code"), std::string("lanes")}) {
      MarchResults some;
      some.resize(full.size());
      std::fill(some.pixel.begin(), some.pixel.end(), 77u);
      std::fill(some.verdict.begin(), some.verdict.end(), Verdict::budget);
      const MarchCode code = target == "lanes" ? MarchCode::lanes : MarchCode::scalar;
      march_paper_some(v.depth(), v.screen_rays, v.rays.pixel, which, {.code = code}, some);
      uint64_t steps = 0;
      std::vector<bool> listed(full.size());
      for (const uint32_t i : which) {
        listed[i] = true;
        march_paper_ray(v.depth(), v.screen_rays.get<float>(i), v.rays.pixel[i], {}, steps);
      }
      size_t wrong = 0;
      for (size_t i = 0; i < full.size(); ++i)
        wrong += some.verdict[i] != (listed[i] ? full.verdict[i] : Verdict::budget) ||
                 some.pixel[i] != (listed[i] ? full.pixel[i] : 77u);
      EXPECT_EQ(wrong, 0u) << target << ", " << which.size() << " listed, seed " << kSeed;
      EXPECT_EQ(some.steps, steps) << target;
    }
  }
}

}  // namespace
}  // namespace hybray::ssrm
