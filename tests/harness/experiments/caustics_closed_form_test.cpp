// The rows of `caustics` against closed forms.
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_forms.h"
#include "tests/core/sampling_error.h"
#include "tests/harness/experiments/caustics_fixture.h"

namespace hybray {
namespace {

using CausticsClosedForm = test::CausticsFixture;

constexpr int64_t kFrames = 64;
// closed_form_z is the greatest of a scene's regions.
const double kLimit = test::error_limit(kFrames, 50);

TEST_F(CausticsClosedForm, UniformTracedEmissionMeetsEveryClosedForm) {
  size_t regions = 0;
  for (const procedural::Generator& generator : procedural::closed_form_generators()) {
    const bool directional = generator.generate({}).lights.at(0).kind == LightKind::directional;
    const Row row = run({{"scene", std::string(generator.name)},
                         {"emission", text("uniform")},
                         {"first_surface", text("traced")},
                         {"mirror_depth", int64_t{32}},
                         {"mixed", text("none")},
                         {"frames", kFrames},
                         {"map_resolution", int64_t{64}},
                         {"rays_per_texel", directional ? 3.0 : 1.0}});
    SCOPED_TRACE(generator.name);
    regions += truth::closed_form(generator.generate({}), 32)->regions.size();
    EXPECT_LE(number(row, "closed_form_z"), kLimit);
    EXPECT_LE(number(row, "closed_form_error_fraction"), 0.02);
    EXPECT_LE(number(row, "closed_form_standard_error_fraction"), 0.1);
  }
  EXPECT_LE(regions, 50u);
}

TEST_F(CausticsClosedForm, TooFewEventsHaveNoClosedFormOrThatOfTheirOwn) {
  const auto with_depth = [&](const char* scene, int64_t depth) {
    return run({{"scene", text(scene)},
                {"mirror_depth", depth},
                {"emission", text("uniform")},
                {"first_surface", text("traced")},
                {"frames", kFrames}});
  };
  // Light must cross two faces of the slab and three of the totally reflecting prism.
  EXPECT_TRUE(is_empty(with_depth("closed_glass_slab", 1), "closed_form_z"));
  EXPECT_TRUE(is_empty(with_depth("closed_tir_prism", 2), "closed_form_z"));
  EXPECT_LE(number(with_depth("closed_glass_slab", 2), "closed_form_z"), kLimit);
  EXPECT_LE(number(with_depth("closed_tir_prism", 3), "closed_form_z"), kLimit);
}

TEST_F(CausticsClosedForm, OtherScenesHaveNone) {
  const char* columns[] = {"closed_form_error_fraction", "closed_form_z",
                           "closed_form_standard_error_fraction"};
  for (const char* scene : {"glass_ball", "water_pool"})
    for (const char* name : columns) EXPECT_TRUE(is_empty(run({{"scene", text(scene)}}), name)) << scene;
  // A closed-form scene that was changed is none any more.
  const Value moved = overlay("moved_lamp", R"({"source": {"generator": "closed_plane_mirror"},
      "replace_lights": true, "lights": [{"name": "lamp", "kind": "point", "position": [0, 2.1, 0], "intensity": 100}]})");
  EXPECT_TRUE(is_empty(run({{"scene", moved}}), "closed_form_z"));
}

TEST_F(CausticsClosedForm, TheCoarseMapMissesWhatTheClosedFormCounts) {
  // Of the furnace's ball, a map of 8 texels a face sees next to nothing; everything that leaves it arrives.
  const auto error = [&](const char* emission, int64_t resolution) {
    return number(run({{"scene", text("closed_furnace")},
                       {"emission", text(emission)},
                       {"first_surface", text("traced")},
                       {"mirror_depth", int64_t{32}},
                       {"map_resolution", resolution},
                       {"rays_per_texel", 16.0}}),
                  "closed_form_error_fraction");
  };
  EXPECT_GT(error("map", 8), 2.0 * error("map", 128));
  EXPECT_LT(error("uniform", 64), 0.01);
}

}  // namespace
}  // namespace hybray
