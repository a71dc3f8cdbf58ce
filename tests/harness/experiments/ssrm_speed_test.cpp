// The experiment `ssrm_speed`, point by point, against what the core says of the same frame.
#include "harness/experiments/ssrm_speed.h"

#include "core/gbuffer/reflection_rays.h"
#include "core/ssrm/predictor.h"
#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using ssrm::Verdict;

constexpr int kWidth = 160, kHeight = 90;

// The main view of the scene's first camera, and its reflection rays.
struct Frame {
  Scene scene = load_scene(default_scene_paths(HYBRAY_PROJECT_DIR), "sphere");
  Tracer tracer{scene, {.robust = true}};
  View view;
  GBuffer gbuffer;
  DepthPyramid pyramid{kWidth, kHeight};
  SlantedPyramid slanted{kWidth, kHeight};
  RayStream rays;
  ssrm::ScreenRays screen_rays;

  static Camera seen_from(Camera camera, const vec3& step) {
    camera.eye += step, camera.target += step;
    return camera;
  }
  explicit Frame(const vec3& step = vec3(0.0f))
      : view(seen_from(scene.cameras.at(0), step), {.width = kWidth, .height = kHeight, .near = 0.1},
             scene.bounds),
        gbuffer(make_gbuffer(tracer, view, kDepth | kDepthDerivatives | kShadingNormal | kPrimitive)) {
    pyramid.build(gbuffer.depth, view.depth_sign(), view.background_depth());
    slanted.build(gbuffer.depth, gbuffer.depth_derivatives, view.depth_sign(), view.background_depth());
    rays = make_reflection_rays(gbuffer, scene).rays;
    screen_rays = ssrm::project_rays(rays, view, scene.bounds);
  }
  ssrm::DepthView depth() const { return {pyramid, gbuffer.depth_derivatives, view.depth_sign(), &slanted}; }
};

double hits_in(const ssrm::MarchResults& results) {
  return static_cast<double>(std::count(results.verdict.begin(), results.verdict.end(), Verdict::hit));
}

class SsrmSpeedTest : public testing::TestWithParam<ssrm::Marcher> {
 protected:
  Row run(std::map<std::string, Value> changes, bool timing = false) {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : ssrm_speed_experiment().parameters) point.parameters[p.name] = p.default_value;
    point.parameters["scene"] = std::string("sphere");
    point.parameters["camera"] = frame_.scene.cameras.at(0).name;
    point.parameters["resolution"] = std::to_string(kWidth) + "x" + std::to_string(kHeight);
    point.parameters["marcher"] = std::string(GetParam() == ssrm::Marcher::plane ? "plane" : "paper");
    for (const auto& [name, value] : changes) point.parameters.at(name) = value;
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, timing, 0});
    return ssrm_speed_experiment().run(point, workspace);
  }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }

  // The scalar reference: the experiment marches in lanes.
  ssrm::MarchResults march(const Frame& frame) const {
    ssrm::MarchResults results;
    results.resize(frame.rays.size());
    ssrm::march(frame.depth(), frame.screen_rays, frame.rays.pixel, {.marcher = GetParam()}, results);
    return results;
  }

  const Frame frame_;
  const test::TemporaryFolder folder_;
};

TEST_P(SsrmSpeedTest, CountsWhatTheScalarMarchFinds) {
  const ssrm::MarchResults full = march(frame_);
  const auto n = static_cast<double>(full.size());
  const Row row = run({});
  EXPECT_EQ(std::get<int64_t>(row.at("rays")), static_cast<int64_t>(full.size()));
  EXPECT_EQ(number(row, "alpha"), hits_in(full) / n);
  EXPECT_EQ(number(row, "steps_per_ray"), static_cast<double>(full.steps) / n);
  EXPECT_GT(number(row, "alpha"), 0.1);
}

TEST_P(SsrmSpeedTest, PredictsAsTheCoreDoesBySample) {
  const ssrm::DepthView depth = frame_.depth();
  for (const double least : {0.2, 0.7}) {
    ssrm::MarchResults results;
    results.resize(frame_.rays.size());
    ssrm::Prediction prediction;
    ssrm::march_by_sample({depth, frame_.screen_rays, frame_.rays.pixel, {.marcher = GetParam()}}, least,
                          results, prediction);
    const auto n = static_cast<double>(results.size());
    const Row row = run({{"predictor", std::string("sample")}, {"least_chance_single", least}});
    EXPECT_EQ(number(row, "alpha_predicted_single"), hits_in(results) / n);
    EXPECT_EQ(number(row, "predicted_single_fraction"), (n - static_cast<double>(prediction.marched)) / n);
    EXPECT_LT(number(row, "predicted_single_fraction"), 1.0);
    EXPECT_GT(number(row, "predicted_single_fraction"), 0.0);
  }
}

TEST_P(SsrmSpeedTest, PredictsAsTheCoreDoesAlongThePath) {
  const double least = 0.4, path_step = 0.03;
  ssrm::ChanceHistory history;
  ssrm::Prediction prediction;
  ssrm::MarchResults results;
  for (const int before : {2, 1, 0}) {
    const Frame then(vec3(frame_.view.right() * (-path_step * before)));
    const ssrm::DepthView depth = then.depth();
    results.resize(then.rays.size());
    ssrm::march_by_history({depth, then.screen_rays, then.rays.pixel, {.marcher = GetParam()}}, then.view,
                           least, history, results, prediction);
  }
  const auto n = static_cast<double>(results.size());
  const Row row = run({{"least_chance", least}, {"path_step", path_step}, {"path_frames", int64_t{2}}});
  EXPECT_EQ(number(row, "alpha_predicted"), hits_in(results) / n);
  EXPECT_EQ(number(row, "predicted_fraction"), (n - static_cast<double>(prediction.marched)) / n);
  EXPECT_GT(number(row, "predicted_fraction"), 0.0);
}

TEST_P(SsrmSpeedTest, APredictedMarchFindsNoMoreThanTheWhole) {
  for (const char* predictor : {"sample", "history"}) {
    const Row row =
        run({{"predictor", std::string(predictor)}, {"least_chance", 0.0}, {"least_chance_single", 1.5}});
    EXPECT_EQ(number(row, "alpha_predicted"), number(row, "alpha")) << "what costs nothing is done";
    EXPECT_EQ(number(row, "predicted_fraction"), 0.0);
    EXPECT_EQ(number(row, "alpha_predicted_single"), 0.0) << "what never pays is not";
    EXPECT_EQ(number(row, "predicted_single_fraction"), 1.0);
    const Row some = run({{"predictor", std::string(predictor)}});
    for (const char* end : {"", "_single"}) {
      EXPECT_LE(number(some, std::string("alpha_predicted") + end), number(some, "alpha"));
      EXPECT_LE(number(some, std::string("alpha_predicted") + end),
                1.0 - number(some, std::string("predicted") + end + "_fraction"))
          << "only marched rays are HITs";
    }
  }
}

TEST_P(SsrmSpeedTest, TheExactSegmentChangesNothingAndItsMissesAreTrue) {
  const Row row = run({});
  EXPECT_EQ(number(row, "segment_exact_changed_fraction"), 0.0);
  EXPECT_EQ(number(row, "segment_exact_changed_timed_fraction"), 0.0);
  EXPECT_GT(number(row, "certified_miss_fraction"), 0.0);
  EXPECT_EQ(number(row, "certified_false_fraction"), 0.0);
  EXPECT_LE(number(row, "certified_miss_fraction"), 1.0 - number(row, "alpha"));
}

// One round: every median is the time of that round.
TEST_P(SsrmSpeedTest, ThePartsOfTheOraclesGapAddUp) {
  const Row row = run({{"repeats", int64_t{1}}}, true);
  const double alpha = number(row, "alpha");
  for (const std::string end : {"", "_single"}) {
    const auto ms = [&](const std::string& stem) { return number(row, stem + "_ms"); };
    const double formula = alpha * ms("t_ss") + (1.0 - alpha) * ms("t_hw" + end);
    EXPECT_NEAR(ms("t_partitioned" + end), formula, 1e-9 * formula);
    EXPECT_NEAR(number(row, "gap" + end), ms("t_oracle" + end) / formula - 1.0, 1e-9);
    EXPECT_NEAR(number(row, "gap" + end), number(row, "oracle_partitioned" + end + "_ratio") - 1.0, 1e-9);
    double sum = 0.0, size = 0.0;
    for (const char* part : {"pyramid", "march_listed", "march_apart", "march_dearer", "trace_listed",
                             "trace_apart", "trace_dearer", "rest"}) {
      const double share = number(row, std::string("gap_") + part + end);
      sum += share, size += std::abs(share);
    }
    EXPECT_NEAR(sum, number(row, "gap" + end), 1e-9 * size);
    // Two of them by their definition.
    EXPECT_NEAR(number(row, "gap_march_dearer" + end),
                (ms("t_ss_hits") - alpha * (ms("t_ss_hits") + ms("t_ss_others"))) / formula, 1e-9 * size);
    EXPECT_NEAR(
        number(row, "gap_trace_apart" + end),
        (1.0 - alpha) * (ms("t_hw_hits" + end) + ms("t_hw_others" + end) - ms("t_hw_listed" + end)) / formula,
        1e-9 * size);
    if (row.count("break_even_chance" + end)) {
      const double rays = static_cast<double>(std::get<int64_t>(row.at("rays")));
      const double c = ms("t_hw_hits" + end) / (alpha * rays), m = ms("t_ss_hits") / (alpha * rays),
                   n = ms("t_ss_others") / ((1.0 - alpha) * rays);
      const double p = number(row, "break_even_chance" + end);
      EXPECT_NEAR(p * (c - m), (1.0 - p) * n, 1e-9 * (c + n)) << "the march costs what it saves";
    }
  }
}

TEST_P(SsrmSpeedTest, EveryCellItFillsIsADeclaredColumn) {
  std::set<std::string> declared, filled;
  for (const Column& column : ssrm_speed_experiment().columns) declared.insert(column.name);
  EXPECT_EQ(declared.size(), ssrm_speed_experiment().columns.size()) << "no name twice";
  for (const bool segment : {false, true})
    for (const auto& [name, value] : run({{"repeats", int64_t{2}}, {"remaining_segment", segment}}, true)) {
      EXPECT_TRUE(declared.count(name)) << name;
      filled.insert(name);
    }
  for (const std::string& name : declared) {
    // Empty where the oracle saves nothing that could be measured.
    if (name.find("efficiency") == std::string::npos && name.find("break_even") == std::string::npos) {
      EXPECT_TRUE(filled.count(name)) << name;
    }
  }
  const Row untimed = run({{"remaining_segment", false}});
  EXPECT_FALSE(untimed.count("t_ss_ms") || untimed.count("repeats") ||
               untimed.count("certified_miss_fraction"));
}

TEST_P(SsrmSpeedTest, RunsOnViewsOfNothing) {
  const Row row = run({{"near", 1000.0}, {"far", 2000.0}}, true);
  EXPECT_EQ(std::get<int64_t>(row.at("rays")), 0);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(row.at("alpha_predicted")));
}

INSTANTIATE_TEST_SUITE_P(Marchers, SsrmSpeedTest, testing::Values(ssrm::Marcher::paper, ssrm::Marcher::plane),
                         [](const auto& test) {
                           return std::string(test.param == ssrm::Marcher::plane ? "Plane" : "Paper");
                         });

}  // namespace
}  // namespace hybray
