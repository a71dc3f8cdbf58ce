// The experiment `ssrm_layers`, point by point.
#include "harness/experiments/ssrm_layers.h"

#include "harness/experiments/ssrm.h"
#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class SsrmLayersTest : public testing::Test {
 protected:
  Row run(const Experiment& experiment, const std::map<std::string, Value>& changes, bool timing = false) {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : experiment.parameters) point.parameters[p.name] = p.default_value;
    point.parameters["scene"] = std::string("sphere");
    point.parameters["resolution"] = std::string("160x90");
    for (const auto& [name, value] : changes) point.parameters.at(name) = value;
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, timing, 0});
    point.parameters["camera"] = workspace.scene(point.text("scene")).cameras.at(0).name;
    return experiment.run(point, workspace);
  }
  Row run(const std::map<std::string, Value>& changes, bool timing = false) {
    return run(ssrm_layers_experiment(), changes, timing);
  }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }

  const test::TemporaryFolder folder_;
};

constexpr const char* kShares[] = {"alpha",
                                   "miss_fraction",
                                   "unknown_offscreen_fraction",
                                   "unknown_behind_fraction",
                                   "unknown_viewer_fraction",
                                   "unknown_correction_fraction",
                                   "unknown_budget_fraction",
                                   "unknown_rejected_fraction"};

TEST_F(SsrmLayersTest, SharesSumToOneAndFalseHitsPartition) {
  const Row row = run({{"guard_band", 0.1}});
  double sum = 0.0;
  for (const char* name : kShares) sum += number(row, name);
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(number(row, "precision") + number(row, "false_hit_fraction"), 1.0, 1e-12);
  EXPECT_NEAR(number(row, "alpha_gain"), number(row, "alpha") / number(row, "single_alpha"), 1e-12);
  EXPECT_GT(number(row, "band_hit_fraction"), 0.0);
}

TEST_F(SsrmLayersTest, OneLayerWithoutABandIsThePapersMarch) {
  const Row row = run({{"layers", int64_t{1}},
                       {"guard_band", 0.0},
                       {"march_on", false},
                       {"confirm", false},
                       {"min_max", false}});
  const Row paper = run(ssrm_experiment(), {{"marcher", std::string("paper")}});
  for (const char* name : kShares) EXPECT_EQ(number(row, name), number(paper, name)) << name;
  for (const char* name : {"precision", "recall", "alpha_max", "steps_per_ray"})
    EXPECT_EQ(number(row, name), number(paper, name)) << name;
  EXPECT_EQ(number(row, "single_alpha"), number(paper, "alpha"));
  EXPECT_EQ(number(row, "single_precision"), number(paper, "precision"));
  EXPECT_EQ(number(row, "single_steps_per_ray"), number(paper, "steps_per_ray"));
  EXPECT_EQ(number(row, "further_hit_fraction"), 0.0);
  EXPECT_EQ(number(row, "band_hit_fraction"), 0.0);
}

TEST_F(SsrmLayersTest, EveryCellItFillsIsADeclaredColumn) {
  std::set<std::string> declared;
  for (const Column& column : ssrm_layers_experiment().columns) declared.insert(column.name);
  EXPECT_EQ(declared.size(), ssrm_layers_experiment().columns.size()) << "no name twice";
  std::set<std::string> filled;
  for (const auto& [name, value] : run({{"repeats", int64_t{2}}, {"guard_band", 0.1}}, true)) {
    EXPECT_TRUE(declared.count(name)) << name;
    filled.insert(name);
  }
  EXPECT_EQ(filled, declared);
}

}  // namespace
}  // namespace hybray
