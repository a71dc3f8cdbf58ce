// The experiment `ssrm`, point by point, without the command line.
#include "harness/experiments/ssrm.h"

#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace hybray {
namespace {

class SsrmTest : public testing::Test {
 protected:
  // A row with the defaults of the declaration, but for `changes`.
  Row run(std::map<std::string, Value> changes, bool timing = false) {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : ssrm_experiment().parameters) point.parameters[p.name] = p.default_value;
    point.parameters["scene"] = std::string("sphere");
    point.parameters["resolution"] = std::string("160x90");
    for (const auto& [name, value] : changes) point.parameters.at(name) = value;
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, timing, 0});
    if (std::get<std::string>(point.parameters["camera"]) == "*")
      point.parameters["camera"] = workspace.scene(point.text("scene")).cameras.at(0).name;
    return ssrm_experiment().run(point, workspace);
  }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }
  static int64_t integer(const Row& row, const std::string& name) { return std::get<int64_t>(row.at(name)); }

  std::vector<bool> black_pixels(const std::string& name) {
    const auto input = OIIO::ImageInput::open((folder_ / name).string());
    if (!input) throw std::runtime_error(name + ": " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<uint8_t> values(static_cast<size_t>(spec.image_pixels()) *
                                static_cast<size_t>(spec.nchannels));
    input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, values.data());
    std::vector<bool> black;
    for (size_t i = 0; i < values.size(); i += static_cast<size_t>(spec.nchannels))
      black.push_back(values[i] + values[i + 1] + values[i + 2] == 0);
    return black;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(SsrmTest, AlphaMissAndUnknownsSumToOneAndFalseHitsPartition) {
  for (const char* scene : {"sphere", "atrium"}) {
    const Row row = run({{"scene", std::string(scene)}});
    double sum = number(row, "alpha") + number(row, "miss_fraction");
    for (const char* reason : {"offscreen", "behind", "viewer", "correction", "budget", "rejected"})
      sum += number(row, std::string("unknown_") + reason + "_fraction");
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(number(row, "precision") + number(row, "false_hit_fraction"), 1.0, 1e-12);
    EXPECT_NEAR(
        number(row, "phantom_fraction") + number(row, "early_fraction") + number(row, "through_fraction"),
        number(row, "false_hit_fraction"), 1e-12);
    EXPECT_EQ(integer(row, "rays") + integer(row, "paths_skipped"), 160 * 90);
    EXPECT_GT(number(row, "alpha"), 0.1);
    // A right HIT is on a surface that the screen shows; its exact point may still be hidden, along
    // silhouettes, which are a few pixels in a hundred here.
    EXPECT_LE(number(row, "alpha") * number(row, "precision"), number(row, "alpha_max") + 0.02);
  }
}

TEST_F(SsrmTest, EveryCellItFillsIsADeclaredColumn) {
  std::set<std::string> declared;
  for (const Column& column : ssrm_experiment().columns) declared.insert(column.name);
  EXPECT_EQ(declared.size(), ssrm_experiment().columns.size()) << "no name twice";
  for (const char* marcher : {"paper", "plane"}) {
    const Row row = run({{"repeats", int64_t{2}}, {"marcher", std::string(marcher)}}, true);
    for (const auto& [name, value] : row) EXPECT_TRUE(declared.count(name)) << name;
    for (const std::string& name : declared) {
      const bool of_plane = name == "bounds" || name == "ascent";
      if (name != "level0_margin_ulp") {
        EXPECT_EQ(row.count(name) != 0, !of_plane || row.at("marcher") == Value(std::string("plane")))
            << name;
      }
    }
  }
}

TEST_F(SsrmTest, TimesObeyTheirOwnDefinitions) {
  const Row row = run({{"repeats", int64_t{5}}}, true);
  const double alpha = number(row, "alpha"), ss = number(row, "t_ss_ms"), hw = number(row, "t_hw_ms");
  // Both estimates are linear in T_SS and T_HW, but the median of sums is not the sum of medians: allow the
  // spread of both.
  const double slack = number(row, "t_ss_spread_ms") + number(row, "t_hw_spread_ms") + 1e-9;
  EXPECT_NEAR(number(row, "t_sequential_ms"), ss + (1 - alpha) * hw, slack);
  EXPECT_NEAR(number(row, "t_partitioned_ms"), alpha * ss + (1 - alpha) * hw, slack);
  for (const char* name :
       {"speedup_sequential", "speedup_partitioned", "speedup_measured", "speedup_measured_vs_single"}) {
    EXPECT_GT(number(row, name), 0.0);
    EXPECT_LE(number(row, std::string(name) + "_low"), number(row, name));
    EXPECT_GE(number(row, std::string(name) + "_high"), number(row, name));
  }
  EXPECT_EQ(integer(row, "repeats"), 5);
}

TEST_F(SsrmTest, WithoutTimingNothingIsTimed) {
  const Row row = run({});
  EXPECT_FALSE(row.count("t_ss_ms") || row.count("speedup_measured") || row.count("repeats"));
}

TEST_F(SsrmTest, DifferencedDerivativesMakeMoreFalseHits) {
  const Row plane = run({{"scene", std::string("atrium")}, {"resolution", std::string("320x180")}});
  const Row difference = run({{"scene", std::string("atrium")},
                              {"resolution", std::string("320x180")},
                              {"derivatives", std::string("difference")}});
  EXPECT_GT(number(difference, "false_hit_fraction"), 3.0 * number(plane, "false_hit_fraction"));
  EXPECT_EQ(integer(difference, "buffers_skipped"), integer(plane, "buffers_skipped") + 1);
}

TEST_F(SsrmTest, BothDepthConventionsGiveNearlyTheSameVerdicts) {
  const Row reversed = run({{"scene", std::string("atrium")}});
  const Row standard = run({{"scene", std::string("atrium")}, {"depth_convention", std::string("standard")}});
  // Standard depth keeps about 1e-7 / (dz/dpixel ~ 1e-5) = 1 % of a pixel at these distances: some rays near
  // a border change.
  EXPECT_NEAR(number(reversed, "alpha"), number(standard, "alpha"), 0.01);
}

TEST_F(SsrmTest, AViewOfNothingHasEmptyCellsInsteadOfNumbers) {
  // A near plane beyond everything: no pixel sees anything.
  const Row row = run({{"near", 1000.0}, {"far", 2000.0}}, true);
  EXPECT_EQ(integer(row, "rays"), 0);
  EXPECT_EQ(integer(row, "paths_skipped"), 160 * 90);
  for (const char* name : {"alpha", "precision", "recall", "steps_per_ray"})
    EXPECT_TRUE(std::holds_alternative<std::monostate>(row.at(name))) << name;
  EXPECT_FALSE(row.count("t_ss_ms"));
}

TEST_F(SsrmTest, RunsAtOnePixel) {
  const Row row = run({{"resolution", std::string("1x1")}}, true);
  EXPECT_LE(integer(row, "rays"), 1);
}

TEST_F(SsrmTest, WritesThePictureOnlyWhenAsked) {
  run({});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pictures"));
  const Row row = run({{"picture", true}, {"camera", std::string("*")}});
  const std::string name =
      "sphere_" + std::get<std::string>(row.at("camera")) + "_160x90_0123456789abcdef.png";
  EXPECT_GT(std::filesystem::file_size(folder_ / ("pictures/" + name)), 500u);
}

TEST_F(SsrmTest, ThePicturesOfVerdictsAndOfTheMainViewAreBlackWhereNoRayWasMade) {
  const Row row = run({{"picture", true}, {"camera", std::string("*")}});
  const std::string stem =
      "pictures/sphere_" + std::get<std::string>(row.at("camera")) + "_160x90_0123456789abcdef";
  const std::vector<bool> verdicts = black_pixels(stem + ".png"), view = black_pixels(stem + "_view.png");
  EXPECT_EQ(verdicts, view);
  EXPECT_EQ(std::count(view.begin(), view.end(), true), integer(row, "paths_skipped"));
  EXPECT_GT(integer(row, "rays"), 0);
}

TEST_F(SsrmTest, VectorLanesGiveTheRowOfTheScalarMarch) {
  for (const char* marcher : {"paper", "plane"})
    for (const int64_t budget : {0, 5}) {
      std::map<std::string, Value> point{
          {"scene", std::string("atrium")}, {"step_budget", budget}, {"marcher", std::string(marcher)}};
      const Row lanes = run(point);
      EXPECT_EQ(std::get<std::string>(lanes.at("march_code")), "lanes");
      point["march_code"] = std::string("scalar");
      Row scalar = run(point);
      scalar["march_code"] = std::string("lanes");
      EXPECT_EQ(lanes, scalar);
    }
}

TEST_F(SsrmTest, ABudgetMovesRaysToUnknownBudget) {
  const Row row = run({{"step_budget", int64_t{5}}});
  EXPECT_GT(number(row, "unknown_budget_fraction"), 0.05);
  EXPECT_LE(number(row, "steps_per_ray"), 5.0);
}

}  // namespace
}  // namespace hybray
