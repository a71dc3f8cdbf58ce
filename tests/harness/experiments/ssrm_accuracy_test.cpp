// The experiment `ssrm_accuracy`, point by point, without the command line.
#include "harness/experiments/ssrm_accuracy.h"

#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class SsrmAccuracyTest : public testing::Test {
 protected:
  Row run(std::map<std::string, Value> changes, bool timing = false) {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : ssrm_accuracy_experiment().parameters)
      point.parameters[p.name] = p.default_value;
    point.parameters["scene"] = std::string("atrium");
    point.parameters["camera"] = std::string("nave");
    point.parameters["resolution"] = std::string("320x180");
    for (const auto& [name, value] : changes) point.parameters.at(name) = value;
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, timing, 0});
    return ssrm_accuracy_experiment().run(point, workspace);
  }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }

  const test::TemporaryFolder folder_;
};

TEST_F(SsrmAccuracyTest, StrictChecksTradeAlphaForFarFewerFalseHits) {
  const Row none = run({}), triangle = run({{"check", std::string("triangle")}}),
            strict = run({{"check", std::string("strict")}});
  EXPECT_EQ(number(none, "unknown_rejected_fraction"), 0.0);
  EXPECT_LT(number(triangle, "false_hit_fraction"), 0.5 * number(none, "false_hit_fraction"));
  EXPECT_LT(number(strict, "false_hit_fraction"), 0.5 * number(triangle, "false_hit_fraction"));
  for (const Row& row : {triangle, strict}) {
    EXPECT_EQ(number(row, "alpha_unchecked"), number(none, "alpha"));
    EXPECT_NEAR(number(row, "alpha") + number(row, "unknown_rejected_fraction"), number(none, "alpha"),
                1e-12);
    EXPECT_LE(number(row, "rejected_right_fraction"), number(row, "unknown_rejected_fraction"));
  }
}

TEST_F(SsrmAccuracyTest, AThickerSlabFindsMoreAndErrsMore) {
  for (const char* marcher : {"dda", "hiz"}) {
    const Row thin = run({{"marcher", std::string(marcher)}, {"thickness", 0.05}}),
              thick = run({{"marcher", std::string(marcher)}, {"thickness", 10.0}});
    EXPECT_GT(number(thick, "alpha"), number(thin, "alpha")) << marcher;
    EXPECT_GT(number(thick, "false_hit_fraction"), number(thin, "false_hit_fraction")) << marcher;
    EXPECT_EQ(number(thin, "thickness_m"), 0.05);
    EXPECT_EQ(thin.count("stride_px"), std::string(marcher) == "dda" ? 1u : 0u);
    EXPECT_EQ(thin.count("confidence"), std::string(marcher) == "hiz" ? 1u : 0u);
  }
}

TEST_F(SsrmAccuracyTest, EveryCellIsADeclaredColumnAndTimesAreFilled) {
  std::set<std::string> declared;
  for (const Column& column : ssrm_accuracy_experiment().columns) declared.insert(column.name);
  EXPECT_EQ(declared.size(), ssrm_accuracy_experiment().columns.size());
  std::set<std::string> filled;
  for (const auto& [marcher, check] : std::map<std::string, std::string>{
           {"paper", "strict"}, {"level0", "triangle"}, {"dda", "continuity"}, {"hiz", "conservative"}})
    for (const auto& [name, value] : run({{"marcher", marcher},
                                          {"check", check},
                                          {"resolution", std::string("96x54")},
                                          {"repeats", int64_t{2}}},
                                         true)) {
      EXPECT_TRUE(declared.count(name)) << name;
      filled.insert(name);
    }
  EXPECT_EQ(filled, declared);
}

TEST_F(SsrmAccuracyTest, RunsAtOnePixelAndOnViewsOfNothing) {
  for (const char* marcher : {"paper", "level0", "dda", "hiz"}) {
    const std::map<std::string, Value> changes{{"marcher", std::string(marcher)},
                                               {"check", std::string("strict")}};
    auto pixel = changes, nothing = changes;
    pixel["resolution"] = std::string("1x1");
    nothing["near"] = 1000.0, nothing["far"] = 2000.0;
    EXPECT_LE(std::get<int64_t>(run(pixel, true).at("rays")), 1);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(run(nothing, true).at("alpha")));
  }
}

}  // namespace
}  // namespace hybray
