// Lights and cameras inside glass, and bodies and materials that light cannot follow.
#include "core/base/error.h"
#include "tests/harness/experiments/caustics_fixture.h"

#include <cmath>

namespace hybray {
namespace {

using CausticsMedia = test::CausticsFixture;

TEST_F(CausticsMedia, ALightAtTheCentreOfAGlassBallShinesStraightOut) {
  // Every ray leaves the centre of the ball (radius 0.5, n = 1.5) along a normal: 0.04 of it is reflected, as
  // often as it meets the ball, and each metre in the glass takes exp(-absorption). What goes out is
  // deposited or escapes.
  const Value scene =
      overlay("lamp_in_ball", R"({"source": {"generator": "glass_ball"}, "replace_lights": true,
      "lights": [{"name": "lamp", "kind": "point", "position": [0, 0.75, 0], "intensity": 10}]})");
  const double absorption[] = {0.14, 0.08, 0.11};
  for (const char* first : {"stored", "traced"})
    for (const int64_t depth : {1, 2}) {
      const Row row = run({{"scene", scene},
                           {"mirror_depth", depth},
                           {"first_surface", text(first)},
                           {"frames", int64_t{8}},
                           {"roulette_threshold", 0.0}});
      double out = 0.0, cut = 0.0;
      for (const double a : absorption) {
        double inside = std::exp(-0.5 * a);
        for (int64_t event = 0; event < depth; ++event) {
          out += 0.96 * inside / 3.0;
          inside *= 0.04 * std::exp(-a);  // reflected, and across the ball to the other side
        }
        cut += inside / 3.0;
      }
      // Of all N paths, reflection picks 0.04 at random; the faces of the ball stray from the sphere by 0.1 %
      // of its radius.
      const double paths = 8.0 * static_cast<double>(integer(row, "paths"));
      const double error = 5.0 * std::sqrt(0.04 * 0.96 / paths) + 2e-4;
      EXPECT_NEAR(number(row, "deposited_fraction") + number(row, "escaped_fraction"), out, error) << first;
      EXPECT_NEAR(number(row, "truncated_fraction"), cut, error) << first;
      EXPECT_EQ(integer(row, "medium_mismatches"), 0);
      EXPECT_DOUBLE_EQ(number(row, "texels_used_fraction"), 1.0);
      EXPECT_NEAR(number(row, "emitted_flux"), 4.0 * M_PI * 10.0, 0.05);
    }
}

TEST_F(CausticsMedia, ACameraInsideGlassSeesCausticsThroughIt) {
  const Value scene = overlay("camera_in_ball", R"({"source": {"generator": "glass_ball"}, "cameras": [
      {"name": "inside", "eye": [0, 0.75, 0], "target": [0.6, 0, -0.2], "vertical_fov": 60}]})");
  const Row row = run({{"scene", scene},
                       {"camera", text("inside")},
                       {"map_resolution", int64_t{256}},
                       {"rays_per_texel", 16.0},
                       {"first_surface", text("traced")},
                       {"mirror_depth", int64_t{8}},
                       {"reference_paths", 4e5},
                       {"frames", int64_t{8}}});
  EXPECT_EQ(integer(row, "mixed_pixels_skipped"), 0) << "all that it sees is glass";
  EXPECT_GT(integer(row, "visibility_points"), 1000);
  EXPECT_GT(integer(row, "photon_pairs"), 1000);
  EXPECT_NEAR(number(row, "offscreen_fraction") + number(row, "depth_rejected_fraction"), 1.0, 1e-9)
      << "no deposit is seen directly";
  EXPECT_NEAR(number(row, "energy_ratio"), 1.0, 0.05);
}

TEST_F(CausticsMedia, RefusesWhatLightCannotFollow) {
  const auto message = [&](const Value& scene) {
    return test::message_of<InputError>([&] { run({{"scene", scene}}); });
  };
  const std::string pane =
      message(overlay("open_pane", R"({"source": {"generator": "glass_ball"}, "objects": [
      {"name": "pane", "shape": "plane", "translate": [1, 1, 1],
       "material": {"base_color": [1, 1, 1], "roughness": 0, "transmission": 1, "ior": 1.5}}]})"));
  EXPECT_NE(pane.find("open_pane"), std::string::npos) << pane;
  EXPECT_NE(pane.find("'pane'"), std::string::npos) << pane;
  EXPECT_NE(pane.find("open at 4 edges"), std::string::npos) << pane;
  const std::string thin = message(overlay("low_index", R"({"source": {"generator": "glass_ball"},
      "materials": {"glass": {"ior": 0.9}}})"));
  EXPECT_NE(thin.find("/materials/glass/ior"), std::string::npos) << thin;
  EXPECT_NE(thin.find("0.9"), std::string::npos) << thin;
}

}  // namespace
}  // namespace hybray
