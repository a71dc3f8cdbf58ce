// The experiments `ssrm_rays` and `ssrm_breakeven`, point by point, without the command line.
#include "harness/experiments/ssrm.h"
#include "harness/experiments/ssrm_breakeven.h"
#include "harness/experiments/ssrm_rays.h"
#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class RayKindsTest : public testing::Test {
 protected:
  Row run(const Experiment& experiment, std::map<std::string, Value> changes, bool timing = false) {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : experiment.parameters) point.parameters[p.name] = p.default_value;
    point.parameters["scene"] = std::string("sphere");
    point.parameters["camera"] = std::string("front");
    point.parameters["resolution"] = std::string("160x90");
    for (const auto& [name, value] : changes)
      if (point.parameters.contains(name)) point.parameters.at(name) = value;
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, timing, 0});
    return experiment.run(point, workspace);
  }
  Row rays(const std::map<std::string, Value>& changes, bool timing = false) {
    return run(ssrm_rays_experiment(), changes, timing);
  }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }
  static int64_t integer(const Row& row, const std::string& name) { return std::get<int64_t>(row.at(name)); }
  static std::string text(const char* t) { return t; }

  const test::TemporaryFolder folder_;
};

TEST_F(RayKindsTest, OneMirrorBounceIsWhatTheExperimentSsrmMeasures) {
  const Row old = run(ssrm_experiment(), {{"march_code", text("lanes")}}), row = rays({});
  for (const auto& [name, value] : old)
    if (row.contains(name)) {
      EXPECT_EQ(row.at(name), value) << name;
    }
  EXPECT_EQ(row.at("alpha"), old.at("alpha"));
  EXPECT_EQ(row.at("alpha_bounce_1"), old.at("alpha"));
}

TEST_F(RayKindsTest, RoughReflectionsAtRoughnessZeroAreMirrors) {
  const Row mirror = rays({}), rough = rays({{"ray_kind", text("rough")}, {"roughness", 0.0}});
  EXPECT_EQ(rough.at("rays"), mirror.at("rays"));
  // Directions may differ by a rounding: single rays at borders.
  EXPECT_NEAR(number(rough, "alpha"), number(mirror, "alpha"), 1e-3);
  EXPECT_NEAR(number(rough, "precision"), number(mirror, "precision"), 1e-3);
}

TEST_F(RayKindsTest, OcclusionVerdictsAreHeldAgainstTracedTruth) {
  for (const auto& [scene, camera] : {std::pair{"sphere", "front"}, {"atrium", "nave"}}) {
    const Row mirror = rays({{"scene", text(scene)}, {"camera", text(camera)}});
    for (const char* kind : {"ambient", "shadow"}) {
      const Row row = rays({{"scene", text(scene)},
                            {"camera", text(camera)},
                            {"ray_kind", text(kind)},
                            {"rays_per_pixel", int64_t{2}}});
      EXPECT_GT(number(row, "alpha"), 0.005) << scene << ' ' << kind;
      // False hits come of the same planes as those of mirror rays of this view, but here a wrong distance
      // does not make one. The rays are others, so a point less may be.
      EXPECT_GT(number(row, "precision"), number(mirror, "precision") - 0.01) << scene << ' ' << kind;
      // What is resolved cannot be more than what is occluded, and false hits.
      EXPECT_LE(number(row, "alpha") * number(row, "precision"), number(row, "truly_hit_fraction") + 1e-12);
      EXPECT_TRUE(std::holds_alternative<std::monostate>(row.at("recall")));
    }
  }
}

TEST_F(RayKindsTest, LongerAmbientRaysAreOccludedMoreOften) {
  double before = 0.0;
  for (double length : {0.1, 0.5, 2.0}) {
    const Row row = rays({{"ray_kind", text("ambient")}, {"length", length}});
    EXPECT_GT(number(row, "truly_hit_fraction"), before);
    before = number(row, "truly_hit_fraction");
    EXPECT_EQ(number(row, "length_m"), length);
  }
}

TEST_F(RayKindsTest, BouncesAddUp) {
  const Row row = rays({{"mirror_depth", int64_t{3}}, {"resolution", text("333x217")}}),
            one = rays({{"resolution", text("333x217")}});
  EXPECT_EQ(row.at("alpha_bounce_1"), one.at("alpha"));
  EXPECT_EQ(integer(row, "rays_bounce_1") + integer(row, "rays_bounce_2") + integer(row, "rays_bounce_3"),
            integer(row, "rays"));
  EXPECT_FALSE(row.contains("alpha_bounce_4"));
  double resolved = 0.0;
  for (const char* b : {"1", "2", "3"}) {
    resolved += number(row, std::string("alpha_bounce_") + b) *
                static_cast<double>(integer(row, std::string("rays_bounce_") + b));
    EXPECT_GT(number(row, std::string("precision_bounce_") + b), 0.95) << b;
  }
  EXPECT_NEAR(resolved, number(row, "alpha") * static_cast<double>(integer(row, "rays")), 1e-6 * resolved);
}

TEST_F(RayKindsTest, EveryCellTheyFillIsADeclaredColumn) {
  for (const Experiment* experiment : {&ssrm_rays_experiment(), &ssrm_breakeven_experiment()}) {
    std::set<std::string> declared, filled;
    for (const Column& column : experiment->columns) declared.insert(column.name);
    EXPECT_EQ(declared.size(), experiment->columns.size()) << "no name twice";
    for (const char* kind : {"mirror", "rough", "ambient", "shadow"})
      for (const auto& [name, value] : run(*experiment,
                                           {{"ray_kind", text(kind)},
                                            {"light", text("sun")},
                                            {"mirror_depth", int64_t{4}},
                                            {"repeats", int64_t{2}}},
                                           true))
        filled.insert(name);
    EXPECT_EQ(filled, declared) << experiment->name;
  }
}

TEST_F(RayKindsTest, TheConditionalFormulaIsTheSumOfItsMeasuredParts) {
  const Row row = rays({{"repeats", int64_t{5}}}, true);
  const double alpha = number(row, "alpha"), ss = number(row, "t_ss_ms"), hw = number(row, "t_hw_ms"),
               left = number(row, "t_unresolved_ms");
  const double slack = number(row, "t_ss_spread_ms") + number(row, "t_hw_spread_ms") +
                       number(row, "t_unresolved_spread_ms") + 1e-9;
  // Medians of ratios against ratios of medians: within the spreads, twice since each stands above and below.
  EXPECT_NEAR(hw / number(row, "speedup_conditional"), ss + left, 2 * slack);
  EXPECT_NEAR(hw / number(row, "speedup_sequential"), ss + (1 - alpha) * hw, 2 * slack);
  EXPECT_NEAR(number(row, "unresolved_cost_ratio") * (1 - alpha) * hw, left, 2 * slack);
}

TEST_F(RayKindsTest, BreakEvenSaysWhatTheIntervalSays) {
  const Row row =
      run(ssrm_breakeven_experiment(), {{"tracer_mode", text("single")}, {"repeats", int64_t{5}}}, true);
  EXPECT_EQ(row.at("hw_mode"), Value(text("single")));
  for (const char* name : {"sequential", "partitioned", "conditional", "measured"}) {
    const std::string speedup = std::string("speedup_") + name;
    const std::string& pays = std::get<std::string>(row.at(std::string("pays_") + name));
    EXPECT_EQ(pays, number(row, speedup + "_low") > 1.0    ? "yes"
                    : number(row, speedup + "_high") < 1.0 ? "no"
                                                           : "unclear");
  }
}

TEST_F(RayKindsTest, RunAtOddSizesAndOnViewsOfNothing) {
  for (const char* size : {"1x1", "64x1"})
    for (const char* kind : {"mirror", "rough", "ambient", "shadow"})
      EXPECT_NO_THROW(
          rays({{"resolution", text(size)}, {"ray_kind", text(kind)}, {"repeats", int64_t{1}}}, true));
  const Row row = rays({{"near", 1000.0}, {"far", 2000.0}, {"mirror_depth", int64_t{2}}}, true);
  EXPECT_EQ(integer(row, "rays"), 0);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(row.at("alpha")));
}

TEST_F(RayKindsTest, TakeSeededCameras) {
  const Row row = rays({{"scene", text("atrium")}, {"camera", text("seeded/5")}}),
            again = rays({{"scene", text("atrium")}, {"camera", text("seeded/5")}});
  EXPECT_EQ(row, again);
  EXPECT_GT(number(row, "alpha"), 0.0);
}

}  // namespace
}  // namespace hybray
