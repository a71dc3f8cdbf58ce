// The march in lanes against the scalar one: verdict, pixel and number of samples of every ray.
#include "core/ssrm/march_lanes.h"

#include "core/base/lanes.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

void expect_same(const MarchResults& lanes, const MarchResults& scalar, const std::string& what) {
  EXPECT_EQ(lanes.steps, scalar.steps) << what;
  size_t different = 0;
  for (size_t i = 0; i < scalar.size(); ++i)
    different += lanes.verdict[i] != scalar.verdict[i] || lanes.pixel[i] != scalar.pixel[i];
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
        const MarchResults scalar = v.march({.step_budget = budget});
        for (const std::string& target : lanes_targets()) {
          use_lanes_target(target);
          MarchResults lanes;
          lanes.resize(v.rays.size());
          march_paper_lanes(v.depth(), v.screen_rays, v.rays.pixel, {.step_budget = budget}, lanes);
          expect_same(lanes, scalar, target + " " + std::to_string(width) + " " + std::to_string(budget));
        }
        use_lanes_target("");
      }
    }
  EXPECT_GT(rays, 50000u);
}

}  // namespace
}  // namespace hybray::ssrm
