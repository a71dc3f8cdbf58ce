#include "harness/sweep/specular_share.h"

#include "core/caustics/caustic_pass.h"
#include "core/scene/scene_library.h"

#include <numeric>

#include <gtest/gtest.h>

namespace hybray {
namespace {

// Active texels of real maps over those of a full one.
double real_share(const Scene& scene) {
  constexpr int kResolution = 64;
  const Tracer tracer(scene, {});
  const caustics::CausticScene prepared(tracer);
  caustics::PassSettings settings;
  settings.map_resolution = kResolution;
  settings.lights.resize(scene.lights.size());
  std::iota(settings.lights.begin(), settings.lights.end(), 0u);
  const caustics::MapSet maps = caustics::make_maps(prepared, settings);
  return static_cast<double>(maps.texels_used) / (6.0 * kResolution * kResolution);
}

const ScenePaths kScenes = default_scene_paths(HYBRAY_PROJECT_DIR);

TEST(SpecularShare, IsThatOfRealMapsWhereNothingHidesTheSurfaces) {
  for (const char* name : {"glass_ball", "water_pool", "prism", "closed_flat_water", "closed_plane_mirror"}) {
    const Scene scene = load_scene(kScenes, name);
    const double real = real_share(scene);
    ASSERT_GT(real, 0.0) << name;
    EXPECT_NEAR(specular_share(scene) / real, 1.0, 0.25) << name << ": " << real;
  }
}

// An analytic surface counts as its box, of which a sphere's shadow takes up pi / 4 seen along an axis and
// less than that, down to pi / 4 / sqrt(3), otherwise.
TEST(SpecularShare, TakesAnalyticSurfacesForTheMeanShadowOfASphere) {
  const Scene scene = load_scene(kScenes, "closed_furnace");
  const double ratio = specular_share(scene) / real_share(scene);
  EXPECT_GT(ratio, 0.9 * 0.52 / 0.785);
  EXPECT_LT(ratio, 1.1 * 0.52 / 0.453);
}

TEST(SpecularShare, IsNotBelowRealMapsWhereSurfacesAreHidden) {
  for (const char* name : {"wine_glass", "metal_ring", "atrium_lamps"}) {
    const Scene scene = load_scene(kScenes, name);
    EXPECT_GT(specular_share(scene) / real_share(scene), 0.8) << name;
  }
}

TEST(SpecularShare, IsZeroWithoutLightsOrSpecularSurfaces) {
  Scene scene = load_scene(kScenes, "glass_ball");
  for (Material& material : scene.materials) material.roughness = 1.0f;
  EXPECT_EQ(specular_share(scene), 0.0);
  scene = load_scene(kScenes, "glass_ball");
  scene.lights.clear();
  EXPECT_EQ(specular_share(scene), 0.0);
}

}  // namespace
}  // namespace hybray
