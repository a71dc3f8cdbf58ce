// Every marcher on every scene against its exhaustive twin, which walks through all pixels.
#include "core/truth/march_level0.h"
#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <iostream>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

struct Size {
  int width, height;
};
constexpr Size kSizes[] = {{1280, 720}, {1919, 1079}, {333, 217}, {64, 1}, {1, 1}};

// An exhaustive march takes seconds a camera at the largest sizes, and the plane marcher's twice as long,
// with its closer look at every pixel: that many cameras see them, the others the smaller ones.
bool is_marched(const Size& size, size_t camera, Marcher marcher) {
  if (marcher == Marcher::plane) return size.width <= 1000 || (size.width <= 1280 && camera < 2);
  return size.width <= 1280 || camera < 2;
}

class MarchScenes : public testing::TestWithParam<std::tuple<const char*, Marcher>> {};

// Labels (verdict and pixel) must be those of the exhaustive marcher of the same arithmetic, ray for ray;
// against double precision only rays within rounding of a decision may differ, at most 2 in 100,000 of all
// rays together.
TEST_P(MarchScenes, AgreesWithTheExhaustiveMarcher) {
  const auto [name, marcher] = GetParam();
  const ScenePaths paths = test::scene_paths();
  if (find_scene(paths, name).state != SceneState::available) {
    if (test::scenes_required())
      FAIL() << "scene " << name << " is required here (HYBRAY_REQUIRE_SCENES=1) but was not found";
    GTEST_SKIP() << "scene " << name << " was not found: set HYBRAY_SCENE_PATH to the folder that holds it";
  }
  const Scene scene = load_scene(paths, name);
  const Tracer tracer(scene, {.robust = true});
  size_t compared = 0, different = 0;
  for (size_t c = 0; c < scene.cameras.size(); ++c)
    for (const Size& size : kSizes) {
      if (!is_marched(size, c, marcher)) continue;
      const auto convention =
          (c + static_cast<size_t>(size.width)) % 2 ? DepthConvention::standard : DepthConvention::reversed;
      const View view(scene.cameras[c],
                      {.width = size.width, .height = size.height, .convention = convention}, scene.bounds);
      const test::MainView v(tracer, view);
      const MarchResults marched = v.march({.marcher = marcher});
      const MarchResults same =
          truth::march_level0<float>(v.depth(), v.screen_rays, v.rays.pixel, 1, marcher);
      ASSERT_EQ(marched.verdict, same.verdict)
          << scene.cameras[c].name << " " << size.width << "x" << size.height;
      ASSERT_EQ(marched.pixel, same.pixel)
          << scene.cameras[c].name << " " << size.width << "x" << size.height;
      MarchResults lanes;
      lanes.resize(v.rays.size());
      march(v.depth(), v.screen_rays, v.rays.pixel, {.code = MarchCode::lanes, .marcher = marcher}, lanes);
      ASSERT_EQ(lanes.verdict, marched.verdict);
      ASSERT_EQ(lanes.pixel, marched.pixel);
      ASSERT_EQ(lanes.steps, marched.steps);
      if (v.rays.size() > 5000) {
        EXPECT_LT(marched.steps, same.steps / 2) << "the hierarchy must save steps";
      }

      const MarchResults exact =
          truth::march_level0<double>(v.depth(), v.screen_rays, v.rays.pixel, 1, marcher);
      for (size_t i = 0; i < exact.size(); ++i) {
        if (exact.verdict[i] == marched.verdict[i] && exact.pixel[i] == marched.pixel[i]) continue;
        ++different;
        EXPECT_LT(truth::first_difference_margin(v.depth(), v.screen_rays, i, v.rays.pixel[i], marcher), 16.0)
            << scene.cameras[c].name << " " << size.width << "x" << size.height << " ray " << i;
      }
      compared += exact.size();
    }
  RecordProperty("rays_compared", std::to_string(compared));
  RecordProperty("rays_different", std::to_string(different));
  std::cout << name << ": " << different << " of " << compared
            << " rays labelled differently in double precision\n";
  EXPECT_LE(static_cast<double>(different), 2e-5 * static_cast<double>(compared));
  EXPECT_GT(compared, 1000000u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MarchScenes,
                         testing::Combine(testing::Values("sphere", "atrium", "street", "sponza", "bistro"),
                                          testing::Values(Marcher::paper, Marcher::plane)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) == Marcher::paper ? "Paper" : "Plane");
                         });

}  // namespace
}  // namespace hybray::ssrm
