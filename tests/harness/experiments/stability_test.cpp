// The experiment `stability`, point by point, without the command line.
#include "harness/experiments/stability.h"

#include "harness/experiments/stability_view.h"
#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class StabilityTest : public testing::Test {
 protected:
  Point point(std::map<std::string, Value> changes) {
    Point p{"0123456789abcdef", {}};
    for (const Parameter& parameter : stability_experiment().parameters)
      p.parameters[parameter.name] = parameter.default_value;
    p.parameters["scene"] = std::string("corner");
    p.parameters["camera"] = std::string("floor");
    p.parameters["resolution"] = std::string("160x90");
    for (const auto& [name, value] : changes) p.parameters.at(name) = value;
    return p;
  }
  Row run(std::map<std::string, Value> changes) {
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, false, nullptr});
    return stability_experiment().run(point(std::move(changes)), workspace);
  }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }
  static int64_t count(const Row& row, const std::string& name) { return std::get<int64_t>(row.at(name)); }

  const test::TemporaryFolder folder_;
};

TEST_F(StabilityTest, UndisturbedTheFrameIsWhatItShouldBe) {
  for (const char* marcher : {"paper", "plane"}) {
    const Row row = run({{"marcher", std::string(marcher)}});
    EXPECT_GT(count(row, "judged_rays"), 10000);
    EXPECT_GT(number(row, "exact_alpha"), 0.15);
    EXPECT_LT(number(row, "labels_flipped_fraction"), 1e-3);
    EXPECT_EQ(number(row, "pixels_changed_fraction"), 0.0);
    EXPECT_EQ(number(row, "lost_rays_fraction"), 0.0);
    EXPECT_EQ(count(row, "further_false_hits"), 0);
    EXPECT_EQ(count(row, "march_self_hits"), 0);
    EXPECT_EQ(count(row, "trace_self_hits"), 0);
    EXPECT_EQ(number(row, "trace_wrong_fraction"), 0.0);
    // Reversed float depth: 1/w to half an ulp.
    EXPECT_LT(number(row, "depth_error_max_fraction"), 0x1p-22);
    EXPECT_FALSE(row.count("incidence_deg"));
    EXPECT_FALSE(row.count("jitter_flipped_fraction"));
  }
}

// Relative error of view depth in fixed point: half a step times w (f - n) / (f n), f >> n. The corner's far
// end is some 14 m away.
TEST_F(StabilityTest, FixedPointDepthErrsByItsFormula) {
  const Row row = run({{"depth_format", std::string("unorm16")}, {"far_near_ratio", 1e4}});
  Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, false, nullptr});
  const stability_parts::StableView view(point({{"far_near_ratio", 1e4}}), workspace.robust_tracer("corner"));
  EXPECT_NEAR(view.settings.far / view.settings.near, 1e4, 1e-6);
  const double per_metre = 0.5 / 65535.0 / view.settings.near;
  EXPECT_LT(number(row, "depth_error_max_fraction"), 1.3 * per_metre * view.settings.far);
  EXPECT_GT(number(row, "depth_error_fraction"), 0.5 * per_metre * 3.0);
  EXPECT_GT(number(row, "labels_flipped_fraction"), 0.05) << "a step of 16-bit depth is metres there";
}

TEST_F(StabilityTest, FarFromTheOriginOnlyCoordinatesRelativeToTheEyeHold) {
  const Row base = run({{"origin", std::string("camera")}});
  const Row world = run({{"offset", 1e7}}),
            relative = run({{"offset", 1e7}, {"origin", std::string("camera")}});
  EXPECT_GT(number(world, "labels_flipped_fraction"), 0.5);
  for (const char* column :
       {"alpha", "labels_flipped_fraction", "depth_error_fraction", "trace_wrong_fraction"})
    EXPECT_EQ(number(relative, column), number(base, column)) << column;
  EXPECT_LT(number(relative, "labels_flipped_fraction"), 1e-3);
}

TEST_F(StabilityTest, APowerOfTwoInScaleChangesNothing) {
  const Row one = run({}), large = run({{"scene_scale", 0x1p20}}), small = run({{"scene_scale", 0x1p-17}});
  for (const char* column :
       {"alpha", "labels_flipped_fraction", "depth_error_fraction", "direction_error_deg"}) {
    EXPECT_EQ(number(one, column), number(large, column)) << column;
    EXPECT_EQ(number(one, column), number(small, column)) << column;
  }
}

TEST_F(StabilityTest, AFixedRayOffsetFailsWhereTheSceneIsSmallAndScaledOnesDoNot) {
  const Row fixed = run({{"scene_scale", 1e-5}, {"ray_offset", std::string("fixed")}}),
            scaled = run({{"scene_scale", 1e-5}});
  EXPECT_GT(number(fixed, "trace_wrong_fraction"), 0.1) << "0.1 mm is the size of the scene";
  EXPECT_EQ(number(scaled, "trace_wrong_fraction"), 0.0);
}

TEST_F(StabilityTest, TurnsTheCameraToTheAskedForIncidence) {
  Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, false, nullptr});
  const Tracer& robust = workspace.robust_tracer("corner");
  const Camera& floor = find_camera(robust.scene(), "floor");
  for (const double degrees : {0.0, 45.0, 80.0, 89.9, 89.99}) {
    const Camera turned = stability_parts::at_incidence(robust, floor, degrees);
    const dvec3 toward_eye = dvec3(turned.eye) - dvec3(turned.target);
    EXPECT_NEAR(glm::length(toward_eye), glm::distance(dvec3(floor.eye), dvec3(floor.target)), 1e-5);
    EXPECT_NEAR(std::acos(toward_eye.y / glm::length(toward_eye)) * 180.0 / 3.14159265358979, degrees, 1e-3);
    EXPECT_NO_THROW(View(turned, {.width = 8, .height = 8}, robust.scene().bounds));
  }
  const Row row = run({{"incidence", 89.9}});
  EXPECT_EQ(number(row, "incidence_deg"), 89.9);
  EXPECT_GT(count(row, "judged_rays"), 1000);
}

TEST_F(StabilityTest, OnePixelAndOddSizesAreNoSpecialCase) {
  for (const char* size : {"1x1", "2x1", "1x3", "13x11", "127x71"}) {
    const Row row = run({{"resolution", std::string(size)}, {"marcher", std::string("plane")}});
    EXPECT_LT(number(row, "labels_flipped_fraction"), 1e-3) << size;
    EXPECT_GE(count(row, "judged_rays"), 1) << size;
  }
}

TEST_F(StabilityTest, JitterChangesFewVerdictsAndIsCounted) {
  const Row row = run({{"jitter_x", 0.37}, {"jitter_y", -0.21}});
  EXPECT_GT(number(row, "jitter_flipped_fraction"), 0.0);
  EXPECT_LT(number(row, "jitter_flipped_fraction"), 0.1);
  EXPECT_LT(number(row, "labels_flipped_fraction"), 1e-3);
}

TEST_F(StabilityTest, EveryCellIsADeclaredColumn) {
  std::set<std::string> declared;
  for (const Column& column : stability_experiment().columns) declared.insert(column.name);
  const Row row = run({{"jitter_x", 0.1}, {"incidence", 60.0}});
  EXPECT_EQ(row.size(), declared.size());
  for (const auto& [name, value] : row) EXPECT_TRUE(declared.count(name)) << name;
}

}  // namespace
}  // namespace hybray
