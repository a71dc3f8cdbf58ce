// Points of `stability_caustics`, small: against formulas written here, and where it must break.
#include "harness/experiments/stability_caustics.h"

#include "core/scene/surface_point.h"
#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using Changes = std::map<std::string, Value>;

class StabilityCaustics : public testing::Test {
 protected:
  Row run(const Changes& changes) const {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : stability_caustics_experiment().parameters)
      point.parameters[p.name] = p.default_value;
    for (const auto& [name, value] : Changes{{"map_resolution", int64_t{64}}, {"frames", int64_t{4}}})
      point.parameters.at(name) = value;
    for (const auto& [name, value] : changes) point.parameters.at(name) = value;
    Workspace workspace({default_scene_paths(HYBRAY_PROJECT_DIR), folder_.path(), 1, false});
    return stability_caustics_experiment().run(point, workspace);
  }
  static Value text(const char* t) { return std::string(t); }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }
  static int64_t integer(const Row& row, const std::string& name) { return std::get<int64_t>(row.at(name)); }
  static std::string word(const Row& row, const std::string& name) {
    return std::get<std::string>(row.at(name));
  }
  const test::TemporaryFolder folder_;
};

TEST_F(StabilityCaustics, FillsDeclaredColumnsOnlyAndEveryKeyOfThem) {
  for (const char* body : {"ball_lens", "glass_slab", "flat_water", "furnace", "sunlit_pool",
                           "grazed_receiver", "sealed_box", "interface"}) {
    const Row row = run({{"body", text(body)}});
    const auto& columns = stability_caustics_experiment().columns;
    for (const auto& [name, value] : row)
      EXPECT_TRUE(std::any_of(columns.begin(), columns.end(), [&](const Column& c) {
        return c.name == name;
      })) << name;
    for (const Column& column : columns)
      if (comparison_of(column) == Comparison::identity) {
        EXPECT_TRUE(row.contains(column.name)) << column.name;
      }
    EXPECT_FALSE(row.contains("refused")) << body;
    EXPECT_EQ(integer(row, "negative_or_nan"), 0) << body;
  }
}

TEST_F(StabilityCaustics, HoldsWhereNothingIsHard) {
  // The maps of a ball miss what grazes it, less the finer they are.
  const std::pair<const char*, int64_t> bodies[] = {{"ball_lens", 1024},
                                                    {"glass_slab", 128},
                                                    {"flat_water", 128},
                                                    {"furnace", 512},
                                                    {"grazed_receiver", 128}};
  for (const auto& [body, resolution] : bodies) {
    const Row row = run({{"body", text(body)}, {"map_resolution", resolution}});
    // Four frames, three standard errors of a normal variable: 9.2 of Student's t; of at most five regions.
    EXPECT_LT(number(row, "error_fraction"), 15.0 * number(row, "error_standard_error_fraction") + 4e-3)
        << body;
    EXPECT_LT(number(row, "error_standard_error_fraction"), 0.03) << body;
    EXPECT_NE(word(row, "holds"), "no") << body;
    EXPECT_EQ(integer(row, "medium_mismatches"), 0) << body;
    EXPECT_EQ(integer(row, "self_intersections"), 0) << body;
    EXPECT_LE(number(row, "ledger_residual_fraction"), 1e-9);
    if (row.contains("wrong_medium_fraction")) {
      EXPECT_EQ(number(row, "wrong_medium_fraction"), 0.0) << body;
    }
  }
}

TEST_F(StabilityCaustics, ASheetThinnerThanTheOffsetIsSkipped) {
  // Faces of 20 m: the offset is 2^-19 of that. A path that begins beyond the far face never meets it, and
  // the light of one transmission, 1 - F, arrives where that of two, (1 - F) / (1 + F), should.
  const double offset = kSurfaceOffset * 20.0;
  const Row thin = run({{"thickness", 0.1 * offset}}), thick = run({{"thickness", 30.0 * offset}});
  EXPECT_EQ(number(thick, "wrong_medium_fraction"), 0.0);
  EXPECT_GT(number(thin, "wrong_medium_fraction"), 0.9);
  EXPECT_EQ(word(thin, "holds"), "no");
  const Row kept = run({{"thickness", 0.1 * offset}, {"leaving_offset", text("along_normal")}});
  EXPECT_EQ(number(kept, "wrong_medium_fraction"), 0.0);
  EXPECT_EQ(integer(kept, "medium_mismatches"), 0);
  EXPECT_LT(number(kept, "error_fraction"), 15.0 * number(kept, "error_standard_error_fraction"));
}

TEST_F(StabilityCaustics, TheFluxThatIsLostIsThatOfFewerEventsThanTheLightNeeds) {
  // A slab without the light's second event has no closed form; with two it lets through (1 - F)^2, which the
  // closed form of two events has too.
  EXPECT_FALSE(run({{"mirror_depth", int64_t{1}}}).contains("error_fraction"));
  EXPECT_LT(std::abs(number(run({{"mirror_depth", int64_t{2}}}), "lost_fraction")), 0.01);
}

TEST_F(StabilityCaustics, AGrazedReceiverHasTheCosineByAllThreeEstimates) {
  for (const double degrees : {0.0, 80.0, 89.9}) {
    const Row row =
        run({{"body", text("grazed_receiver")}, {"incidence", degrees}, {"map_resolution", int64_t{512}}});
    for (const char* name : {"", "splat_", "photon_map_"}) {
      const std::string stem = name;
      const double noise =
          number(row, stem.empty() ? "error_standard_error_fraction" : stem + "standard_error_fraction");
      EXPECT_LT(number(row, stem + "error_fraction"), 10.0 * noise + 2e-3) << name << " at " << degrees;
      EXPECT_LT(noise, 0.02) << name;
    }
  }
}

TEST_F(StabilityCaustics, AnInterfaceLosesDigitsAsTheCosineOfIncidenceDoes) {
  const double ulp = 0x1p-24;
  for (const double degrees : {0.0, 60.0, 89.0, 89.99}) {
    const double i = degrees * std::numbers::pi / 180.0;
    const Row row = run({{"body", text("interface")}, {"incidence", degrees}, {"ior", 1.5}});
    // What goes through falls with the cosine c, which floats know to 3 sqrt(3) ulps at most: two rounded
    // unit vectors. Times what the rest of Fresnel's terms can add.
    EXPECT_LT(number(row, "transmittance_error_fraction"), 10.0 * ulp / std::cos(i) + 1e-7);
    EXPECT_LT(number(row, "reflected_direction_error_radians"), 20.0 * ulp);
    EXPECT_LT(number(row, "refracted_direction_error_radians"), 20.0 * ulp);
  }
  // Near index 1 reflectance is (n - 1)^2 / 4, and n is a float.
  const double n = 1.0001;
  const double held = static_cast<double>(static_cast<float>(n));
  const double expected = std::abs(std::pow((held - 1.0) / (n - 1.0) * (n + 1.0) / (held + 1.0), 2) - 1.0);
  const Row near_one = run({{"body", text("interface")}, {"ior", n}});
  EXPECT_NEAR(number(near_one, "reflectance_error_fraction"), expected, 1e-5 + 0.1 * expected);
  EXPECT_GT(expected, 1e-5);
}

TEST_F(StabilityCaustics, NothingLeavesASealedBoxNearTheOrigin) {
  const Row row = run({{"body", text("sealed_box")}});
  EXPECT_EQ(number(row, "leaked_fraction"), 0.0);
  EXPECT_FALSE(row.contains("error_fraction"));  // nothing to compare: nothing may arrive
  // What is not absorbed is cut off: 0.9 to the power of the depth.
  EXPECT_LT(number(row, "truncated_fraction"), 2.0 * std::pow(0.9, 32));
}

TEST_F(StabilityCaustics, FarFromTheOriginItBreaksAndRebasingBringsItBack) {
  const Changes far{{"body", text("ball_lens")}, {"offset", 1e6}};
  Changes rebased = far;
  rebased["origin"] = text("rebased");
  EXPECT_EQ(word(run(far), "holds"), "no");
  const Row back = run(rebased);
  EXPECT_LT(number(back, "error_fraction"), number(run(far), "error_fraction"));
  EXPECT_EQ(integer(back, "medium_mismatches"), 0);
}

TEST_F(StabilityCaustics, ScaleByPowersOfTwoChangesNoDigit) {
  const Row one = run({}), large = run({{"scale", 1024.0}}), small = run({{"scale", 0x1p-10}});
  for (const Row* row : {&large, &small})
    EXPECT_EQ(number(*row, "error_fraction"), number(one, "error_fraction"));
}

}  // namespace
}  // namespace hybray
