// The account of the flux in the rows of `caustics`.
#include "tests/harness/experiments/caustics_fixture.h"

#include <cmath>

namespace hybray {
namespace {

using CausticsLedger = test::CausticsFixture;

constexpr const char* kShares[] = {"deposited_fraction", "direct_fraction",    "absorbed_fraction",
                                   "escaped_fraction",   "truncated_fraction", "roulette_fraction"};

TEST_F(CausticsLedger, ClosesForEveryWayOfTracing) {
  const char* mixed[] = {"none", "backward", "forward"};
  int turn = 0;
  for (const char* scene :
       {"glass_ball", "metal_ring", "mirror_and_floor", "prism", "water_pool", "wine_glass"}) {
    Workspace workspace(settings());
    for (const char* emission : {"map", "uniform"})
      for (const int64_t depth : {1, 3, 12}) {
        // Roulette from a weight of 0.9 on, so that it is played much.
        const double roulette = depth == 3 ? 0.25 : depth == 12 ? 0.9 : 0.0;
        const Row row = run_in(workspace, {{"scene", text(scene)},
                                           {"emission", text(emission)},
                                           {"mirror_depth", depth},
                                           {"frames", int64_t{16}},
                                           {"map_resolution", int64_t{32}},
                                           {"rays_per_texel", 1.7},
                                           {"roulette_threshold", roulette},
                                           {"visibility", text(turn % 2 ? "shadow" : "depth")},
                                           {"first_surface", text(turn % 4 < 2 ? "stored" : "traced")},
                                           {"mixed", text(mixed[turn % 3])}});
        SCOPED_TRACE(std::string(scene) + " " + emission + " " + std::to_string(depth));
        ++turn;
        EXPECT_LE(number(row, "ledger_residual_fraction"), 1e-9);
        double sum = 0.0;
        for (const char* name : kShares) sum += number(row, name);
        EXPECT_NEAR(sum, 1.0, 1e-9);
        for (const char* name : kShares)
          if (std::string(name) != "roulette_fraction") {
            EXPECT_GE(number(row, name), 0.0) << name;
          }
        // The photons are those of the first frame.
        if (number(row, "deposited_fraction") > 0.2) {
          EXPECT_GT(integer(row, "photons"), 0);
        }
        EXPECT_EQ(integer(row, "accumulator_overflows"), 0);
        EXPECT_LT(number(row, "accumulator_peak_fraction"), 1.0);
        EXPECT_LE(number(row, "offscreen_fraction") + number(row, "depth_rejected_fraction"), 1.0 + 1e-9);
        EXPECT_EQ(is_empty(row, "emitted_flux_z"), std::string(emission) == "uniform");
        // 18 comparisons of 16 frames: at a limit of 4.5, Student's t with 15 degrees of freedom exceeds it
        // in one of 130 such tests by chance; the seed is fixed.
        if (!is_empty(row, "emitted_flux_z")) {
          EXPECT_LE(std::abs(number(row, "emitted_flux_z")), 4.5);
        }
      }
  }
}

TEST_F(CausticsLedger, AMirrorTakesItsShareAndTheRestArrives) {
  // The paraboloid sends every ray of the lamp at its focus straight down to the floor after one reflection
  // of 0.9, which no ray misses.
  for (const char* first : {"stored", "traced"}) {
    const Row row = run({{"scene", text("closed_paraboloid")}, {"first_surface", text(first)}});
    EXPECT_NEAR(number(row, "absorbed_fraction"), 0.1, 1e-6);
    EXPECT_NEAR(number(row, "deposited_fraction"), 0.9, 1e-6);
  }
}

TEST_F(CausticsLedger, AClosedRoomKeepsItsLightAndALimitOfOneCutsAllThatEntersTheBall) {
  const Row deep = run({{"scene", text("closed_furnace")}, {"mirror_depth", int64_t{64}}});
  EXPECT_NEAR(number(deep, "deposited_fraction"), 1.0, 1e-6);
  EXPECT_EQ(number(deep, "escaped_fraction"), 0.0);
  // The lamp at distance d = 2 sqrt 3 from a ball of radius 1 sees it under angles up to asin(1/d). By flux,
  // what is reflected there is the mean Fresnel reflectance over that cone, written here by itself; the rest
  // refracts into the ball and meets it again.
  const double d = 2.0 * std::sqrt(3.0), cos_cone = std::sqrt(1.0 - 1.0 / (d * d));
  double reflected = 0.0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double c = cos_cone + (1.0 - cos_cone) * (i + 0.5) / kSteps;  // even in solid angle
    const double sin_i = d * std::sqrt(1.0 - c * c), sin_t = sin_i / 1.5;
    const double cos_i = std::sqrt(1.0 - sin_i * sin_i), cos_t = std::sqrt(1.0 - sin_t * sin_t);
    const double s = (cos_i - 1.5 * cos_t) / (cos_i + 1.5 * cos_t);
    const double p = (cos_t - 1.5 * cos_i) / (cos_t + 1.5 * cos_i);
    reflected += 0.5 * (s * s + p * p) / kSteps;
  }
  const Row one = run({{"scene", text("closed_furnace")},
                       {"mirror_depth", int64_t{1}},
                       {"first_surface", text("traced")},
                       {"emission", text("uniform")},
                       {"frames", int64_t{16}},
                       {"rays_per_texel", 8.0}});
  const double met = number(one, "deposited_fraction") + number(one, "truncated_fraction");
  // N = 16 frames x 8 x 6 x 64^2 paths, a share (1 - cos_cone) / 2 of which meets the ball.
  const double hits = 16.0 * 8 * 6 * 64 * 64 * 0.5 * (1.0 - cos_cone);
  EXPECT_NEAR(met, 0.5 * (1.0 - cos_cone), 5.0 * std::sqrt(hits) / (16.0 * 8 * 6 * 64 * 64));
  EXPECT_NEAR(number(one, "deposited_fraction") / met, reflected,
              5.0 * std::sqrt(reflected * (1.0 - reflected) / hits));
}

TEST_F(CausticsLedger, WhatIsCutOffFallsWithDepth) {
  Workspace workspace(settings());
  const auto cut = [&](int64_t depth) {
    return number(run_in(workspace, {{"mirror_depth", depth}, {"rays_per_texel", 8.0}}),
                  "truncated_fraction");
  };
  // Light that has entered the ball meets it again; there at least 0.8 of it leaves, and the same again and
  // again of what stays (only close to the rim does the glass reflect more).
  const double one = cut(1), two = cut(2), four = cut(4), eight = cut(8);
  EXPECT_GT(one, 0.7);
  EXPECT_LT(two, 0.2 * one);
  EXPECT_LT(four, 0.5 * two);
  EXPECT_LT(eight, 0.5 * four);
}

}  // namespace
}  // namespace hybray
