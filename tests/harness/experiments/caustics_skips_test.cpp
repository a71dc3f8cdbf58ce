// What `caustics` leaves out because the scene, a light, a texel or the camera has no need of it.
#include "core/base/error.h"
#include "core/optics/surface_optics.h"
#include "tests/harness/experiments/caustics_fixture.h"

#include <numbers>

namespace hybray {
namespace {

class CausticsSkips : public test::CausticsFixture {
 protected:
  // The glass ball with `lights` (a JSON array) added to its lamp or instead of it.
  Value ball_with_lights(const std::string& name, const std::string& lights, bool instead) const {
    return overlay(name, R"({"source": {"generator": "glass_ball"}, "replace_lights": )" +
                             std::string(instead ? "true" : "false") + R"(, "lights": )" + lights + "}");
  }
  // Behind the wall z = -3, 6 m wide and 2.5 m high: its light to the ball, at most 1.25 m above the floor,
  // meets the wall.
  static constexpr const char* kHiddenLamp =
      R"([{"name": "hidden", "kind": "point", "position": [0, 0.6, -4], "intensity": 40}])";
};

TEST_F(CausticsSkips, ASceneWithoutSpecularMaterialHasNoMapsPathsOrRays) {
  const Scene scene = load_scene(settings().scene_paths, "sphere");
  for (const Material& m : scene.materials) ASSERT_GE(m.roughness, optics::kSmoothRoughness) << m.name;
  ASSERT_EQ(scene.lights.size(), 3u);
  for (const char* mixed : {"none", "backward", "forward"}) {
    for (const char* emission : {"map", "uniform"}) {
      const Row row = run({{"scene", text("sphere")},
                           {"mixed", text(mixed)},
                           {"emission", text(emission)},
                           {"filter", text("wavelet")},
                           {"reference_paths", 1000.0}});
      for (const char* name : {"paths", "rays_traced", "photons", "visibility_points", "photon_pairs",
                               "reference_rays", "accumulator_overflows", "medium_mismatches"})
        EXPECT_EQ(integer(row, name), 0) << name;
      EXPECT_EQ(integer(row, "lights_skipped"), 3);
      if (std::string(mixed) == "none")
        EXPECT_TRUE(is_empty(row, "mixed_pixels_skipped"));
      else
        EXPECT_EQ(integer(row, "mixed_pixels_skipped"), 64 * 36);
      EXPECT_EQ(number(row, "emitted_flux"), 0.0);
      // No map was made, so that there is nothing of which a share could have been traced.
      for (const char* name :
           {"texels_traced_fraction", "texels_used_fraction", "relmse", "rmse", "median_relative_error",
            "energy_ratio", "reference_relmse", "deposited_fraction", "missed_by_map_fraction"})
        EXPECT_TRUE(is_empty(row, name)) << name;
    }
  }
}

TEST_F(CausticsSkips, ALightWithNothingSpecularInSightAddsNoPathsAndChangesNothingElse) {
  const Changes common{{"mirror_depth", int64_t{6}}};
  Changes alone = common, with = common;
  with["scene"] = ball_with_lights("with_hidden_lamp", kHiddenLamp, false);
  const Row before = run(alone), after = run(with);
  EXPECT_GT(integer(before, "photons"), 100);
  EXPECT_EQ(integer(before, "lights_skipped"), 0);
  EXPECT_EQ(integer(after, "lights_skipped"), 1);
  EXPECT_EQ(integer(after, "lights_invisible"), integer(before, "lights_invisible") + 1);
  for (const char* name : {"paths", "rays_traced", "photons", "visibility_points", "photon_pairs",
                           "emitted_flux", "covered_flux", "deposited_fraction", "emitted_flux_z"})
    EXPECT_EQ(before.at(name), after.at(name)) << name;
  // Both maps have six faces: a full map of both lights has twice the texels.
  EXPECT_DOUBLE_EQ(number(after, "texels_used_fraction"), 0.5 * number(before, "texels_used_fraction"));
}

TEST_F(CausticsSkips, AHiddenLightByItselfTracesNothing) {
  const Row row = run({{"scene", ball_with_lights("hidden_lamp_alone", kHiddenLamp, true)}});
  for (const char* name : {"paths", "rays_traced", "photons", "visibility_points"})
    EXPECT_EQ(integer(row, name), 0) << name;
  EXPECT_EQ(integer(row, "lights_skipped"), 1);
  EXPECT_EQ(number(row, "texels_used_fraction"), 0.0);
  EXPECT_GT(number(row, "texels_traced_fraction"), 0.0) << "it had to look to know";
}

TEST_F(CausticsSkips, ADarkLightIsSkippedAndEmitsNothingEverywhereElse) {
  const char* dark = R"([{"name": "dark", "kind": "point", "position": [1, 2, 1], "intensity": 0}])";
  for (const char* emission : {"map", "uniform"}) {
    const Row before = run({{"emission", text(emission)}});
    const Row after =
        run({{"emission", text(emission)}, {"scene", ball_with_lights("dark_lamp", dark, false)}});
    EXPECT_EQ(integer(after, "lights_skipped"), 1);
    for (const char* name : {"paths", "rays_traced", "photons", "emitted_flux", "deposited_fraction"})
      EXPECT_EQ(before.at(name), after.at(name)) << name;
  }
}

TEST_F(CausticsSkips, LightsAreTakenInOrderFromThoseInViewAndThoseOutOfIt) {
  // "front" looks from (0.9, 1.7, 3.3) at (0.25, 0.5, 0): two lamps in its view, three behind it.
  const Value scene = ball_with_lights("five_lamps", R"([
      {"name": "a", "kind": "point", "position": [0, 2, 5], "intensity": 1},
      {"name": "b", "kind": "point", "position": [-0.8, 1.0, -1], "intensity": 2},
      {"name": "c", "kind": "point", "position": [1, 2, 6], "intensity": 4},
      {"name": "d", "kind": "point", "position": [1, 0.6, -0.5], "intensity": 8},
      {"name": "e", "kind": "point", "position": [2, 2, 5], "intensity": 16}])",
                                       true);
  Workspace workspace(settings());
  const auto flux_of = [&](int64_t visible, int64_t invisible) {
    const Row row = run_in(workspace, {{"scene", scene},
                                       {"camera", text("front")},
                                       {"emission", text("uniform")},
                                       {"map_resolution", int64_t{32}},
                                       {"reference_paths", 1000.0},
                                       {"lights_visible", visible},
                                       {"lights_invisible", invisible}});
    EXPECT_EQ(integer(row, "lights_visible"), visible < 0 ? 2 : visible);
    EXPECT_EQ(integer(row, "lights_invisible"), invisible < 0 ? 3 : invisible);
    EXPECT_EQ(integer(row, "paths"),
              6 * 32 * 32 * (integer(row, "lights_visible") + integer(row, "lights_invisible")));
    return number(row, "emitted_flux") / (4.0 * std::numbers::pi);
  };
  // A point light of I W/sr emits 4 pi I, evenly by paths: their sum is exact, and the powers of two tell
  // which lights they are.
  EXPECT_NEAR(flux_of(1, 0), 2.0, 1e-9);
  EXPECT_NEAR(flux_of(0, 2), 1.0 + 4.0, 1e-9);
  EXPECT_NEAR(flux_of(-1, 1), 2.0 + 8.0 + 1.0, 1e-9);
  EXPECT_NEAR(flux_of(2, 3), 31.0, 1e-9);
  EXPECT_EQ(flux_of(0, 0), 0.0);

  const auto message = [&](const char* name, int64_t wanted) {
    return test::message_of<InputError>([&] {
      run_in(workspace, {{"scene", scene}, {"camera", text("front")}, {name, wanted}});
    });
  };
  EXPECT_EQ(
      message("lights_visible", 3),
      "lights_visible: 3 lights are asked for; scene 'five_lamps' has 2 of that kind from camera 'front'");
  EXPECT_EQ(message("lights_invisible", 4),
            "lights_invisible: 4 lights are asked for; scene 'five_lamps' has 3 of that kind from camera "
            "'front'");
}

TEST_F(CausticsSkips, TheNaveOfTheAtriumSeesEightOfItsSixteenLamps) {
  Workspace workspace(settings());
  const Changes point{{"scene", text("atrium_lamps")}, {"camera", text("nave")},
                      {"resolution", text("320x180")}, {"map_resolution", int64_t{16}},
                      {"mixed", text("none")},         {"mirror_depth", int64_t{1}}};
  const Row all = run_in(workspace, point);
  EXPECT_EQ(integer(all, "lights_visible"), 8);
  EXPECT_EQ(integer(all, "lights_invisible"), 8);
  EXPECT_EQ(integer(all, "lights_skipped"), 0) << "each stands by glass and metal";
  Changes nine = point;
  nine["lights_visible"] = int64_t{9};
  EXPECT_NE(test::message_of<InputError>([&] { run_in(workspace, nine); }).find("has 8 of that kind"),
            std::string::npos);
}

TEST_F(CausticsSkips, ACameraThatSeesNothingSpecularMakesNoCameraPaths) {
  const Value scene = overlay("floor_view", R"({"source": {"generator": "glass_ball"}, "cameras": [
      {"name": "floor", "eye": [2, 0.5, 2], "target": [2.2, 0, 1.8], "vertical_fov": 40}]})");
  for (const char* mixed : {"backward", "forward"}) {
    const Row row = run({{"scene", scene}, {"camera", text("floor")}, {"mixed", text(mixed)}});
    EXPECT_EQ(integer(row, "mixed_pixels_skipped"), 64 * 36);
    EXPECT_EQ(integer(row, "visibility_points"), 0);
    EXPECT_EQ(integer(row, "photon_pairs"), 0);
    EXPECT_GT(integer(row, "photons"), 0);
  }
}

TEST_F(CausticsSkips, WithoutMixedCausticsNoVisibilityPointIsMade) {
  const Row none = run({{"camera", text("through")}, {"mixed", text("none")}});
  EXPECT_EQ(integer(none, "visibility_points"), 0);
  EXPECT_EQ(integer(none, "photon_pairs"), 0);
  const Row backward = run({{"camera", text("through")}, {"mixed", text("backward")}});
  EXPECT_GT(integer(backward, "visibility_points"), 0);
  EXPECT_GT(integer(backward, "rays_traced"), integer(none, "rays_traced"));
  EXPECT_LT(integer(backward, "mixed_pixels_skipped"), 64 * 36);
}

TEST_F(CausticsSkips, WithoutCausticsTheirColumnsStayEmpty) {
  for (const bool timing : {false, true}) {
    const Row row = run({{"caustics", false}, {"reference_paths", 1000.0}}, timing);
    for (const Column& column : caustics_experiment().columns) {
      const bool of_main_view = column.name.starts_with("gbuffer_") || column.name == "repeats";
      const bool key = column.kind == ColumnKind::key || column.name == "triangles" ||
                       column.name == "threads" || column.name == "frames";
      if (!key && !(timing && of_main_view)) {
        EXPECT_TRUE(is_empty(row, column.name)) << column.name;
      }
    }
    EXPECT_EQ(is_empty(row, "gbuffer_ms"), !timing);
    EXPECT_FALSE(is_empty(row, "scene"));
    EXPECT_TRUE(is_empty(row, "at_floor"));
  }
}

}  // namespace
}  // namespace hybray
