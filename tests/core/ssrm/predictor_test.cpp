// The predictor changes which rays are marched, never what a marched ray finds.
#include "core/ssrm/predictor.h"

#include "tests/core/ssrm/main_view.h"
#include "tests/core/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace hybray::ssrm {
namespace {

MarchResults empty_results(size_t rays) {
  MarchResults r;
  r.resize(rays);
  // Whatever an earlier frame has left.
  std::fill(r.verdict.begin(), r.verdict.end(), Verdict::rejected);
  std::fill(r.pixel.begin(), r.pixel.end(), 77u);
  return r;
}

// Which rays the prediction says it has marched; fails where it names one twice.
std::vector<bool> marched_rays(const Prediction& p, size_t rays) {
  std::vector<bool> marched(rays);
  for (const uint32_t run : p.runs)
    for (size_t i = kRun * run; i < std::min(kRun * (run + 1), rays); ++i) {
      EXPECT_FALSE(marched[i]) << "twice";
      marched[i] = true;
    }
  for (const uint32_t i : p.sample) marched[i] = true;
  return marched;
}

void expect_marched_as_in_full(const MarchResults& results, const Prediction& p, const MarchResults& full,
                               const std::string& what) {
  const std::vector<bool> marched = marched_rays(p, full.size());
  EXPECT_EQ(static_cast<size_t>(std::count(marched.begin(), marched.end(), true)), p.marched) << what;
  size_t wrong = 0;
  for (size_t i = 0; i < full.size(); ++i)
    wrong += results.verdict[i] != (marched[i] ? full.verdict[i] : Verdict::budget) ||
             results.pixel[i] != (marched[i] ? full.pixel[i] : kNoPixel);
  EXPECT_EQ(wrong, 0u) << what;
}

size_t hits(const MarchResults& r) {
  return static_cast<size_t>(std::count(r.verdict.begin(), r.verdict.end(), Verdict::hit));
}

View moved(const Scene& scene, int width, int height, float right) {
  Camera camera = scene.cameras.at(0);
  const View view(camera, {.width = width, .height = height}, scene.bounds);
  const vec3 step(view.right() * static_cast<double>(right));
  camera.eye += step, camera.target += step;
  return View(camera, {.width = width, .height = height}, scene.bounds);
}

struct Case {
  int width, height;
  Marcher marcher;
  MarchCode code;
};
class PredictorTest : public testing::TestWithParam<Case> {};

TEST_P(PredictorTest, NeverChangesTheVerdictOfAMarchedRay) {
  const auto& [width, height, marcher, code] = GetParam();
  for (const char* name : {"sphere", "atrium", "street"}) {
    const Scene scene = load_scene(test::scene_paths(), name);
    const Tracer tracer(scene, {.robust = true});
    for (const double least : {0.0, 0.3, 0.8, 1.0, 1.5}) {
      ChanceHistory history;
      Prediction prediction;
      for (int frame = 0; frame < 3; ++frame) {
        const View view = moved(scene, width, height, 0.05f * static_cast<float>(frame));
        const test::MainView v(tracer, view);
        const DepthView depth = v.depth();
        const MarchInput input{depth, v.screen_rays, v.rays.pixel, {.code = code, .marcher = marcher}};
        const MarchResults full = v.march({.marcher = marcher});
        const std::string what = std::string(name) + " at " + std::to_string(least);
        MarchResults results = empty_results(full.size());
        march_by_history(input, view, least, history, results, prediction);
        expect_marched_as_in_full(results, prediction, full, what + " by history");
        if (least == 0.0 || (frame == 0 && least <= 1.0)) {
          EXPECT_EQ(prediction.marched, full.size()) << "a free march is always worth it, and a new one too";
        }
        if (least > 1.0) {
          EXPECT_EQ(prediction.marched, 0u);
        }
        if (frame > 0) continue;
        results = empty_results(full.size());
        march_by_sample(input, least, results, prediction);
        expect_marched_as_in_full(results, prediction, full, what + " by sample");
        if (least == 0.0) {
          EXPECT_EQ(results.steps, full.steps) << "every ray once";
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PredictorTest,
                         testing::Values(Case{333, 217, Marcher::paper, MarchCode::lanes},
                                         Case{333, 217, Marcher::plane, MarchCode::lanes},
                                         Case{333, 217, Marcher::plane, MarchCode::scalar},
                                         Case{64, 1, Marcher::paper, MarchCode::lanes},
                                         Case{1, 1, Marcher::plane, MarchCode::lanes}),
                         [](const auto& test) {
                           const Case& c = test.param;
                           return std::to_string(c.width) + "x" + std::to_string(c.height) +
                                  (c.marcher == Marcher::plane ? "Plane" : "Paper") +
                                  (c.code == MarchCode::lanes ? "Lanes" : "Scalar");
                         });

// Of what a perfect predictor would save, by a cost model: tracing a ray costs 1, its march `cost`.
double saved(const MarchResults& full, const MarchResults& results, const Prediction& p, double cost) {
  const auto n = static_cast<double>(full.size()), all = static_cast<double>(hits(full)),
             found = static_cast<double>(hits(results)), marched = static_cast<double>(p.marched);
  return (cost * (n - marched) - (all - found)) / (cost * (n - all));
}

// At a size at which a tile is small against what the scene holds.
TEST(Predictor, SavesMoreThanHalfOfWhatAPerfectPredictorSaves) {
  const Scene scene = load_scene(test::scene_paths(), "atrium");
  const Tracer tracer(scene, {.robust = true});
  std::map<std::pair<Marcher, double>, ChanceHistory> histories;
  constexpr int kFrames = 5;
  for (int frame = 0; frame < kFrames; ++frame) {
    const View view = moved(scene, 1280, 720, 0.02f * static_cast<float>(frame));
    const test::MainView v(tracer, view);
    const DepthView depth = v.depth();
    for (const Marcher marcher : {Marcher::paper, Marcher::plane}) {
      const MarchInput input{
          depth, v.screen_rays, v.rays.pixel, {.code = MarchCode::lanes, .marcher = marcher}};
      const MarchResults full = v.march(input.options);
      MarchResults results = empty_results(full.size());
      for (const double cost : {0.3, 0.5}) {
        const std::string what = "frame " + std::to_string(frame) + ", cost " + std::to_string(cost) +
                                 (marcher == Marcher::plane ? ", plane" : ", paper");
        const double least = least_chance(1.0, cost, cost);
        EXPECT_DOUBLE_EQ(least, cost);
        Prediction prediction;
        march_by_history(input, view, least, histories[{marcher, cost}], results, prediction);
        if (frame > 0) {
          EXPECT_GT(saved(full, results, prediction, cost), 0.5) << what;
        }
        if (frame + 1 < kFrames) continue;
        march_by_sample(input, least, results, prediction);
        EXPECT_GT(saved(full, results, prediction, cost), 0.5) << what << ", by sample";
        // Whoever knows each run's share of HITs saves the most.
        std::vector<uint8_t> worth(runs_of(full.size()));
        for (size_t i = 0; i < full.size(); ++i) worth[i / kRun] += full.verdict[i] == Verdict::hit;
        for (size_t run = 0; run < worth.size(); ++run)
          worth[run] = worth[run] >= least * static_cast<double>(std::min(kRun, full.size() - kRun * run));
        Prediction best;
        MarchResults of_best = empty_results(full.size());
        march_runs(input, worth, of_best, best);
        expect_marched_as_in_full(of_best, best, full, what);
        EXPECT_GE(saved(full, of_best, best, cost), saved(full, results, prediction, cost)) << what;
      }
    }
  }
}

TEST(Predictor, ASecondFrameOfTheSameViewMarchesTheRunsAroundWhichTheFirstHit) {
  const Scene scene = load_scene(test::scene_paths(), "atrium");
  const Tracer tracer(scene, {.robust = true});
  const View view(scene.cameras.at(0), {.width = 320, .height = 184}, scene.bounds);
  const test::MainView v(tracer, view);
  const DepthView depth = v.depth();
  const MarchInput input{depth, v.screen_rays, v.rays.pixel, {.code = MarchCode::lanes}};
  const MarchResults full = v.march();
  constexpr int kAcross = 320 / 8, kDown = 184 / 8;
  // By run: the block of its 16th ray, and its share of HITs; by block: sums over such runs.
  std::vector<size_t> block_of(runs_of(full.size()));
  std::vector<double> sum_of(static_cast<size_t>(kAcross) * kDown), runs_in(sum_of.size());
  for (size_t run = 0; run < block_of.size(); ++run) {
    const size_t begin = 64 * run, end = std::min(begin + 64, full.size());
    const uint32_t pixel = v.rays.pixel[std::min(begin + 15, end - 1)];
    block_of[run] = pixel / 320 / 8 * kAcross + pixel % 320 / 8;
    const auto hit = std::count(full.verdict.begin() + static_cast<ptrdiff_t>(begin),
                                full.verdict.begin() + static_cast<ptrdiff_t>(end), Verdict::hit);
    sum_of[block_of[run]] += static_cast<double>(hit) / static_cast<double>(end - begin);
    runs_in[block_of[run]] += 1.0;
  }
  ChanceHistory history;
  Prediction prediction;
  MarchResults results = empty_results(full.size());
  constexpr double kLeast = 0.4;
  march_by_history(input, view, kLeast, history, results, prediction);
  march_by_history(input, view, kLeast, history, results, prediction);
  const std::vector<bool> marched = marched_rays(prediction, full.size());
  size_t checked = 0;
  for (size_t run = 0; run < block_of.size(); ++run) {
    const int bx = static_cast<int>(block_of[run]) % kAcross, by = static_cast<int>(block_of[run]) / kAcross;
    double sum = 0.0, weights = 0.0;
    for (int y = std::max(0, by - 1); y <= std::min(kDown - 1, by + 1); ++y)
      for (int x = std::max(0, bx - 1); x <= std::min(kAcross - 1, bx + 1); ++x) {
        const double w = 1.0 / (1 << (std::abs(x - bx) + std::abs(y - by)));
        const auto block = static_cast<size_t>(y * kAcross + x);
        weights += w * runs_in[block], sum += w * sum_of[block];
      }
    // Chances are kept in parts of 1 / 255, rounded down.
    if (std::abs(sum / weights - kLeast) < 1.0 / 255.0) continue;
    const bool explored = (run + 1) % kExplore == 0;
    EXPECT_EQ(marched[kRun * run], explored || sum / weights >= kLeast) << run;
    ++checked;
  }
  EXPECT_GT(checked, block_of.size() / 2);
}

TEST(Predictor, TheLeastChanceBalancesTraceAndMarch) {
  // At that chance p tracing all costs what marching all and tracing the rest does.
  const double c = 110.0, m = 48.0, n = 36.0, p = least_chance(c, m, n), rest = 120.0;
  EXPECT_NEAR(p * c + (1 - p) * rest, p * m + (1 - p) * (n + rest), 1e-9);
  EXPECT_TRUE(std::isinf(least_chance(30.0, 30.0, 20.0)));
}

}  // namespace
}  // namespace hybray::ssrm
