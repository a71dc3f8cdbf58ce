// The predictor changes which rays are marched, never what a marched ray finds.
#include "core/ssrm/predictor.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

struct Predicted {
  MarchResults results;
  Prediction prediction;
};

Predicted predicted(const test::MainView& v, const PredictorOptions& options,
                    const TileHistory& history = {}) {
  Predicted p;
  p.results.resize(v.rays.size());
  march_predicted(v.depth(), v.screen_rays, v.rays.pixel, {.code = MarchCode::lanes}, options, history,
                  p.results, p.prediction);
  return p;
}

size_t hits(const MarchResults& r) {
  return static_cast<size_t>(std::count(r.verdict.begin(), r.verdict.end(), Verdict::hit));
}

class PredictorTest : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(PredictorTest, NeverChangesTheVerdictOfAMarchedRay) {
  for (const char* name : {"sphere", "atrium", "street"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    const Tracer tracer(scene, {.robust = true});
    const View view(scene.cameras.at(0), {.width = GetParam().first, .height = GetParam().second},
                    scene.bounds);
    const test::MainView v(tracer, view);
    const MarchResults full = v.march();
    const TileHistory history = tile_history(full, v.rays.pixel, view.width(), view.height());
    for (const bool with_history : {false, true})
      for (const double cost : {0.0, 0.3, 0.8, 1.0}) {
        const Predicted p = predicted(v, {.march_cost = cost}, with_history ? history : TileHistory{});
        std::vector<bool> marched(full.size());
        for (const auto* list : {&p.prediction.sample, &p.prediction.worthwhile})
          for (const uint32_t i : *list) {
            EXPECT_FALSE(marched[i]) << "twice";
            marched[i] = true;
          }
        size_t wrong = 0;
        for (size_t i = 0; i < full.size(); ++i)
          wrong += p.results.verdict[i] != (marched[i] ? full.verdict[i] : Verdict::budget) ||
                   p.results.pixel[i] != (marched[i] ? full.pixel[i] : kNoPixel);
        EXPECT_EQ(wrong, 0u) << name << " at cost " << cost;
        if (cost == 0.0) {
          EXPECT_EQ(p.prediction.marched(), full.size()) << "a free march is always worth it";
        }
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PredictorTest,
                         testing::Values(std::pair(333, 217), std::pair(64, 1), std::pair(1, 1)),
                         [](const auto& test) {
                           return std::to_string(test.param.first) + "x" + std::to_string(test.param.second);
                         });

// By the cost model: a march costs `cost` traces, and each ray that is no HIT is traced.
TEST(Predictor, SavesMoreThanHalfOfWhatAPerfectPredictorSaves) {
  const Scene scene = load_scene(test::scene_paths(), "atrium");
  const Tracer tracer(scene, {.robust = true});
  const test::MainView v(tracer, View(scene.cameras.at(0), {.width = 640, .height = 360}, scene.bounds));
  const MarchResults full = v.march();
  for (const double cost : {0.3, 0.5}) {
    const Predicted p = predicted(v, {.march_cost = cost});
    const auto n = static_cast<double>(full.size()), found = static_cast<double>(hits(full));
    const double saved = cost * (n - static_cast<double>(p.prediction.marched())) -
                         (found - static_cast<double>(hits(p.results)));
    EXPECT_GT(saved, 0.5 * cost * (n - found)) << "at cost " << cost;
  }
}

TEST(TileHistory, IsTheShareOfHitsOfEachTile) {
  MarchResults r;
  r.resize(3);
  r.verdict = {Verdict::hit, Verdict::miss, Verdict::hit};
  const TileHistory h = tile_history(r, {0, 5, 17}, 33, 2);
  EXPECT_EQ(h.width, 3);
  EXPECT_EQ(h.chance, (std::vector<float>{0.5f, 1.0f, -1.0f}));
}

}  // namespace
}  // namespace hybray::ssrm
