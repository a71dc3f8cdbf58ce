// The marches in lanes against the scalar ones: verdict, pixel and number of samples of every ray.
#include "core/base/hash.h"
#include "core/base/lanes.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <optional>

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

struct Kind {
  const char* name;
  Marcher marcher;
  Ascent ascent;
};
constexpr Kind kKinds[] = {{"Paper", Marcher::paper, Ascent::iteration},
                           {"Plane", Marcher::plane, Ascent::parent},
                           {"PlaneByIteration", Marcher::plane, Ascent::iteration}};

class MarchLanes : public testing::TestWithParam<Kind> {};

TEST_P(MarchLanes, EndAsTheScalarMarchDoesOnEveryInstructionSet) {
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
        MarchOptions options{.step_budget = budget,
                             .marcher = GetParam().marcher,
                             .correct = budget != 2,
                             .ascent = GetParam().ascent};
        const auto proving = [&] {
          MarchResults results;
          results.resize(v.rays.size());
          results.ask_proved();
          march(v.depth(), v.screen_rays, v.rays.pixel, options, results);
          return results;
        };
        const MarchResults scalar = proving();
        options.code = MarchCode::lanes;
        for (const std::string& target : lanes_targets()) {
          use_lanes_target(target);
          expect_same(proving(), scalar, target + " " + std::to_string(width) + " " + std::to_string(budget));
        }
        use_lanes_target("");
      }
    }
  EXPECT_GT(rays, 50000u);
}

TEST_P(MarchLanes, AListMarchesItsRaysAsTheFullMarchDoesAndTouchesNoOther) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  const test::MainView v(tracer, View(Camera{"c", vec3(0, 0.5f, 3), vec3(0)},
                                      {.width = 333, .height = 217, .near = 0.5}, scene.bounds));
  MarchOptions options{.marcher = GetParam().marcher, .ascent = GetParam().ascent};
  const MarchResults full = v.march(options);
  constexpr uint64_t kSeed = 5;
  std::vector<uint32_t> list;
  for (uint32_t i = 0; i < full.size(); ++i)
    if (random_unit(i, 0, 0, kSeed) < 0.3) list.push_back(i);
  std::reverse(list.begin(), list.end());  // any order
  for (const std::vector<uint32_t>& which : {list, {list[7]}, std::vector<uint32_t>{}}) {
    std::vector<bool> listed(full.size());
    uint64_t steps = 0;
    for (const uint32_t i : which) {
      listed[i] = true;
      march_ray(v.depth(), v.screen_rays.get<float>(i), v.rays.pixel[i], options, steps);
    }
    for (const MarchCode code : {MarchCode::scalar, MarchCode::lanes}) {
      options.code = code;
      MarchResults some;
      some.resize(full.size());
      std::fill(some.pixel.begin(), some.pixel.end(), 77u);
      std::fill(some.verdict.begin(), some.verdict.end(), Verdict::budget);
      march_some(v.depth(), v.screen_rays, v.rays.pixel, which, options, some);
      size_t wrong = 0;
      for (size_t i = 0; i < full.size(); ++i)
        wrong += some.verdict[i] != (listed[i] ? full.verdict[i] : Verdict::budget) ||
                 some.pixel[i] != (listed[i] ? full.pixel[i] : 77u);
      EXPECT_EQ(wrong, 0u) << (code == MarchCode::lanes ? "lanes" : "scalar") << ", " << which.size()
                           << " listed, seed " << kSeed;
      EXPECT_EQ(some.steps, steps);
    }
  }
}

TEST_P(MarchLanes, RunsMarchTheirRaysAsTheFullMarchDoesAndTouchNoOther) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  const test::MainView v(tracer, View(Camera{"c", vec3(0, 0.5f, 3), vec3(0)},
                                      {.width = 333, .height = 217, .near = 0.5}, scene.bounds));
  MarchOptions options{.marcher = GetParam().marcher, .ascent = GetParam().ascent};
  const MarchResults full = v.march(options);
  ASSERT_NE(full.size() % kRun, 0u) << "the last run is a short one";
  std::vector<uint32_t> some, all(runs_of(full.size()));
  for (uint32_t run = 0; run < all.size(); ++run) {
    all[run] = run;
    if (run % 3 != 1 || run + 1 == all.size()) some.push_back(run);
  }
  std::reverse(some.begin(), some.end());  // any order
  std::vector<std::string> targets = lanes_targets();
  targets.push_back("scalar");
  for (const RayChoice::Of of : {RayChoice::Of::runs, RayChoice::Of::rest_of_runs})
    for (const std::vector<uint32_t>& runs : {some, all, std::vector<uint32_t>{}})
      for (const std::string& target : targets) {
        options.code = target == "scalar" ? MarchCode::scalar : MarchCode::lanes;
        use_lanes_target(target == "scalar" ? "" : target);
        std::vector<bool> listed(full.size());
        for (const uint32_t run : runs)
          for (size_t i = kRun * run; i < std::min(kRun * (run + 1), full.size()); ++i) {
            const bool sampled = i == std::min(kRun * run + kSampleOfRun, full.size() - 1);
            listed[i] = of == RayChoice::Of::runs || !sampled;
          }
        MarchResults found;
        found.resize(full.size());
        std::fill(found.pixel.begin(), found.pixel.end(), 77u);
        std::fill(found.verdict.begin(), found.verdict.end(), Verdict::budget);
        march_chosen(v.depth(), v.screen_rays, v.rays.pixel, {of, runs}, options, found);
        size_t wrong = 0;
        uint64_t steps = 0;
        for (size_t i = 0; i < full.size(); ++i) {
          wrong += found.verdict[i] != (listed[i] ? full.verdict[i] : Verdict::budget) ||
                   found.pixel[i] != (listed[i] ? full.pixel[i] : 77u);
          if (listed[i]) march_ray(v.depth(), v.screen_rays.get<float>(i), v.rays.pixel[i], options, steps);
        }
        EXPECT_EQ(wrong, 0u) << runs.size() << " runs, " << target;
        EXPECT_EQ(found.steps, steps);
      }
  use_lanes_target("");
}

// Rays whose origin has been rounded away from their own pixel, as far from the world's origin: what they
// find means nothing, but it is on the screen, is no background pixel, and is the same on every instruction
// set.
TEST_P(MarchLanes, RaysThatStartBesideTheirPixelStayOnTheScreen) {
  const Scene scene = test::triangle_soup(300, 1.0f, 2.0f, 21);
  const Tracer tracer(scene, {.robust = true});
  test::MainView v(tracer, View(Camera{"c", vec3(0, 0.5f, 3), vec3(0)},
                                {.width = 61, .height = 37, .near = 0.5}, scene.bounds));
  constexpr uint64_t kSeed = 6;
  for (size_t i = 0; i < v.rays.size(); ++i) {
    v.screen_rays.ox[i] += static_cast<float>(200.0 * random_unit(i, 0, 0, kSeed) - 100.0);
    v.screen_rays.oy[i] += static_cast<float>(200.0 * random_unit(i, 1, 0, kSeed) - 100.0);
  }
  const auto expect_sound = [&](const MarchResults& results) {
    size_t stopped = 0;
    for (size_t i = 0; i < results.size(); ++i) {
      if (results.pixel[i] == kNoPixel) continue;
      ASSERT_LT(results.pixel[i], v.gbuffer.depth.size());
      ASSERT_NE(v.gbuffer.primitive[results.pixel[i]], kNoPrimitive);
      ++stopped;
    }
    EXPECT_GT(stopped, 20u);
  };
  for (const bool correct : {true, false}) {
    MarchOptions options{.marcher = GetParam().marcher, .correct = correct, .ascent = GetParam().ascent};
    expect_sound(v.march(options));
    options.code = MarchCode::lanes;
    std::optional<MarchResults> first;
    for (const std::string& target : lanes_targets()) {
      use_lanes_target(target);
      const MarchResults results = v.march(options);
      expect_sound(results);
      if (first)
        expect_same(results, *first, target);
      else
        first = results;
    }
    use_lanes_target("");
  }
}

INSTANTIATE_TEST_SUITE_P(Marchers, MarchLanes, testing::ValuesIn(kKinds),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace hybray::ssrm
