// Light paths: the account of their flux, independence of threads, and agreement of all ways to emit.
#include "core/caustics/photon_trace.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/caustics/medium_at.h"
#include "tests/core/caustics/caustic_scenes.h"
#include "tests/core/sampling_error.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

PassSettings settings_for(const Scene& scene, EmissionKind kind, FirstSurface first, int depth,
                          int resolution = 128) {
  PassSettings s;
  s.map_resolution = resolution;
  s.emission = kind;
  s.first_surface = first;
  s.walk.max_events = depth;
  for (uint32_t i = 0; i < scene.lights.size(); ++i) s.lights.push_back(i);
  return s;
}

LightPaths trace(const Prepared& p, const PassSettings& s, uint32_t sample = 0) {
  return trace_light_paths(p.caustic, s, make_maps(p.caustic, s), sample);
}

TEST(PhotonTrace, TheLedgerClosesForEveryKindOfMaterialEmissionAndDepth) {
  const Prepared p(mixed_scene());
  for (const EmissionKind kind : {EmissionKind::map, EmissionKind::uniform, EmissionKind::mixture})
    for (const FirstSurface first : {FirstSurface::stored, FirstSurface::traced})
      for (const int depth : {1, 2, 16}) {
        const LightPaths paths = trace(p, settings_for(p.scene, kind, first, depth));
        const FluxLedger& l = paths.list.counts.ledger;
        ASSERT_GT(l.emitted, 0.0);
        EXPECT_NEAR(l.total() / l.emitted, 1.0, 1e-9);
        EXPECT_GT(l.deposited, 0.0);
        EXPECT_GT(l.absorbed, 0.0);
        EXPECT_GT(l.escaped, 0.0);
        // The photons carry what the ledger says was deposited, less the share that the coat of glossy paint
        // turned back: that part went on along the path.
        double carried = 0.0;
        paths.list.photons.for_each([&](const Photon& photon) { carried += mean_flux(photon); });
        EXPECT_GE(carried, l.deposited * (1.0 - 1e-6));
        EXPECT_LE(carried, l.deposited * 1.25);
      }
}

TEST(PhotonTrace, EachLightHasALedgerOfItsOwnAndTheyAddUp) {
  Scene scene = mixed_scene();
  scene.lights.push_back(point_light(vec3(-1.0f, 2.5f, 1.0f), 4.0f));
  const Prepared p(std::move(scene));
  const LightPaths paths = trace(p, settings_for(p.scene, EmissionKind::map, FirstSurface::stored, 4));
  ASSERT_EQ(paths.ledgers.size(), 2u);
  double emitted = 0.0;
  for (const FluxLedger& l : paths.ledgers) {
    EXPECT_NEAR(l.total() / l.emitted, 1.0, 1e-9);
    emitted += l.emitted;
  }
  EXPECT_NEAR(emitted, paths.list.counts.ledger.emitted, 1e-9 * emitted);
}

std::vector<Photon> flat(const PhotonBlocks& photons) {
  std::vector<Photon> list;
  photons.for_each([&](const Photon& photon) { list.push_back(photon); });
  return list;
}

// Bit for bit.
void expect_same(const std::vector<Photon>& expected, const PhotonBlocks& photons) {
  ASSERT_EQ(expected.size(), photons.size());
  size_t i = 0, different = 0;
  photons.for_each(
      [&](const Photon& photon) { different += std::memcmp(&expected[i++], &photon, sizeof(Photon)) != 0; });
  EXPECT_EQ(different, 0u);
}

TEST(PhotonTrace, PhotonsAreTheSameBitsAtAnyNumberOfThreads) {
  const Prepared p(mixed_scene());
  const PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::stored, 8);
  std::vector<Photon> first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const LightPaths paths = trace(p, s);
    ASSERT_GT(paths.list.photons.size(), 1000u);
    if (first.empty()) first = flat(paths.list.photons);
    expect_same(first, paths.list.photons);
  }
}

TEST(PhotonTrace, NothingIsNegativeOrNotANumber) {
  const Prepared p(mixed_scene());
  const LightPaths paths = trace(p, settings_for(p.scene, EmissionKind::mixture, FirstSurface::stored, 16));
  paths.list.photons.for_each([&](const Photon& photon) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_GE(photon.flux[c], 0.0f);
      ASSERT_TRUE(std::isfinite(photon.flux[c]) && std::isfinite(photon.position[c]));
    }
    ASSERT_TRUE(std::isfinite(photon.shading_ratio()) && photon.shading_ratio() >= 0.0f);
    ASSERT_NEAR(glm::length(photon.direction), 1.0f, 1e-5f);
    ASSERT_LT(glm::dot(photon.direction, photon.normal), 0.0f);
  });
}

// Deposited flux, W, over independent samples.
Estimate deposited(const Prepared& p, const PassSettings& s, int samples) {
  std::vector<double> values;
  for (int i = 0; i < samples; ++i)
    values.push_back(trace(p, s, static_cast<uint32_t>(i)).list.counts.ledger.deposited);
  return estimate(values);
}

TEST(PhotonTrace, MapUniformAndMixedEmissionAgreeOnWhatArrives) {
  const Prepared p(mixed_scene());
  constexpr int kSamples = 16;
  const Estimate map =
      deposited(p, settings_for(p.scene, EmissionKind::map, FirstSurface::traced, 8, 256), kSamples);
  const Estimate uniform =
      deposited(p, settings_for(p.scene, EmissionKind::uniform, FirstSurface::traced, 8, 128), kSamples);
  const Estimate mixture =
      deposited(p, settings_for(p.scene, EmissionKind::mixture, FirstSurface::traced, 8, 128), kSamples);
  EXPECT_LT(std::abs(uniform.mean - mixture.mean),
            error_limit(kSamples) * std::hypot(uniform.error, mixture.error));
  // The map sees a texel whole or not at all: at a silhouette half of the texels along it are wrong by half
  // on average, in both directions. The silhouettes here are some 12 m of 0.7 m wide objects: below 2 %.
  EXPECT_NEAR(map.mean / uniform.mean, 1.0, 0.02);
  EXPECT_LT(map.error, uniform.error);
}

TEST(PhotonTrace, RouletteKeepsTheExpectation) {
  // Between two facing mirrors of reflectance 0.9 paths are long, and roulette decides often.
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(1.0f));
  const uint32_t m = add_material(scene, mirror(vec3(0.9f)));
  add_floor(scene, 50.0f, -1.0f);
  add_sheet(scene, m, vec3(-1.0f, -0.9f, -40.0f), vec3(0.0f, 0.0f, 80.0f), vec3(0.0f, 10.0f, 0.0f));
  add_sheet(scene, m, vec3(1.0f, -0.9f, -40.0f), vec3(0.0f, 0.0f, 80.0f), vec3(0.0f, 10.0f, 0.0f));
  scene.lights.push_back(point_light(vec3(0.0f, 1.0f, 0.0f), 1.0f));
  update_content_hash(scene);
  const Prepared p(std::move(scene));
  PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::traced, 60, 128);
  s.walk.roulette_threshold = 0.0;
  constexpr int kSamples = 16;
  const Estimate without = deposited(p, s, kSamples);
  s.walk.roulette_threshold = 0.8;
  const Estimate with = deposited(p, s, kSamples);
  EXPECT_LT(std::abs(with.mean - without.mean),
            error_limit(kSamples) * std::hypot(with.error, without.error));
  EXPECT_GT(without.mean, 0.0);
}

TEST(PhotonTrace, FractionsOfARayPerTexelKeepTheFlux) {
  const Prepared p(mixed_scene());
  PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::stored, 4, 128);
  const MapSet maps = make_maps(p.caustic, s);
  ASSERT_EQ(maps.maps.size(), 1u);
  const double covered = maps.maps[0].covered_flux;
  for (const double rays : {0.1, 0.5, 1.0, 2.7}) {
    s.rays_per_texel = rays;
    std::vector<double> emitted;
    uint64_t paths = 0;
    for (uint32_t i = 0; i < 32; ++i) {
      const LightPaths traced = trace_light_paths(p.caustic, s, maps, i);
      emitted.push_back(traced.list.counts.ledger.emitted);
      paths += traced.list.paths;
    }
    const Estimate e = estimate(emitted);
    // Solid angles of texels of 1/64 of a quarter turn, at their centres and jittered, differ by second
    // order.
    EXPECT_LT(std::abs(e.mean - covered), error_limit(32, 4) * e.error + 1e-5 * covered) << rays;
    EXPECT_NEAR(static_cast<double>(paths) / 32.0, rays * static_cast<double>(maps.maps[0].texels.size()),
                1.0);
  }
}

TEST(PhotonTrace, AMirroredCavityCutsOffWhatItsReflectanceLeavesAtEveryDepth) {
  // Light cannot get out of a sphere of reflectance R. What meets the wall for the (d + 1)th time is cut off
  // with R^(d + 1) of its flux; the walls have the rest.
  Scene scene = empty_scene();
  constexpr float kR = 0.75f;
  const uint32_t m = add_material(scene, mirror(vec3(kR)));
  append_analytic(scene, analytic_sphere("cavity", m, dvec3(0.0, 1.0, 0.0), 2.0));
  scene.lights.push_back(point_light(vec3(0.5f, 1.3f, -0.2f), 1.0f));
  update_content_hash(scene);
  const Prepared p(std::move(scene));
  for (const FirstSurface first : {FirstSurface::stored, FirstSurface::traced})
    for (const int depth : {1, 2, 3, 8, 16}) {
      PassSettings s = settings_for(p.scene, EmissionKind::map, first, depth, 16);
      s.walk.roulette_threshold = 0.0;
      const FluxLedger l = trace(p, s).list.counts.ledger;
      const double cut = std::pow(static_cast<double>(kR), depth + 1);
      EXPECT_NEAR(l.truncated / l.emitted, cut, 1e-12) << depth;
      EXPECT_NEAR(l.absorbed / l.emitted, 1.0 - cut, 1e-12) << depth;
      EXPECT_EQ(l.escaped, 0.0) << depth;
    }
}

TEST(PhotonTrace, AGreaterDepthAddsToWhatASmallerOneFoundAndTakesItFromWhatThatCutOff) {
  // Random numbers belong to a path and its event, so that paths of all depths are the same up to the cut.
  // Without roulette no event adds to a path's weight: what is cut off falls with depth, path by path, until
  // nothing is left, and the other parts of the account grow.
  const Prepared p(mixed_scene());
  FluxLedger before;
  for (const int depth : {1, 2, 3, 8, 16, 32}) {
    PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::stored, depth);
    s.walk.roulette_threshold = 0.0;
    const FluxLedger l = trace(p, s).list.counts.ledger;
    const double rounding = 1e-12 * l.emitted;
    EXPECT_NEAR(l.balance, 0.0, rounding);
    if (depth > 1) {
      EXPECT_EQ(l.direct, before.direct);
    }
    EXPECT_GE(l.deposited, before.deposited - rounding);
    EXPECT_GE(l.absorbed, before.absorbed - rounding);
    EXPECT_GE(l.escaped, before.escaped - rounding);
    if (depth == 1) {
      EXPECT_GT(l.truncated, 0.0);
    } else if (before.truncated > 0.0) {
      EXPECT_LT(l.truncated, before.truncated) << depth;
    } else {
      EXPECT_EQ(l.truncated, 0.0) << depth;
    }
    before = l;
  }
}

TEST(PhotonTrace, AListThatIsUsedAgainHoldsWhatAFreshOneWould) {
  Scene scene = mixed_scene();
  scene.lights.push_back(point_light(vec3(-1.0f, 2.5f, 1.0f), 4.0f));
  const Prepared p(std::move(scene));
  PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::stored, 8);
  const MapSet maps = make_maps(p.caustic, s);
  LightPaths used;
  // More photons than before, fewer, none of an earlier frame's, and the first again.
  for (const auto& [rays, sample] : {std::pair(0.5, 0u), {3.0, 1u}, {0.1, 2u}, {1e-4, 3u}, {0.5, 0u}}) {
    s.rays_per_texel = rays;
    trace_light_paths(p.caustic, s, maps, sample, used);
    const LightPaths fresh = trace_light_paths(p.caustic, s, maps, sample);
    EXPECT_EQ(used.list.paths, fresh.list.paths);
    EXPECT_EQ(used.list.counts.rays, fresh.list.counts.rays);
    EXPECT_EQ(used.list.counts.medium_mismatches, fresh.list.counts.medium_mismatches);
    ASSERT_EQ(used.ledgers.size(), fresh.ledgers.size());
    for (size_t i = 0; i < fresh.ledgers.size(); ++i) {
      EXPECT_EQ(used.ledgers[i].emitted, fresh.ledgers[i].emitted);
      EXPECT_EQ(used.ledgers[i].total(), fresh.ledgers[i].total());
    }
    EXPECT_EQ(used.list.counts.ledger.deposited, fresh.list.counts.ledger.deposited);
    expect_same(flat(fresh.list.photons), used.list.photons);
  }
}

TEST(PhotonTrace, ALightInsideGlassShinesOut) {
  // At the centre of a ball every ray meets the surface head on and goes straight on: the floor receives
  // T I cos / d^2 as if from the bare lamp, with T = 1 - ((n - 1) / (n + 1))^2 at first crossing.
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(1.0f));
  const uint32_t g = add_material(scene, glass(1.5f));
  add_floor(scene, 4.0f);
  append_analytic(scene, analytic_sphere("ball", g, dvec3(0.0, 2.0, 0.0), 0.5));
  scene.lights.push_back(point_light(vec3(0.0f, 2.0f, 0.0f), 10.0f));
  update_content_hash(scene);
  const Prepared p(std::move(scene));
  EXPECT_GT(p.caustic.light_media[0], 0u);
  PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::traced, 1, 256);
  const LightPaths paths = trace(p, s);
  EXPECT_EQ(paths.list.counts.medium_mismatches, 0u);
  double sum = 0.0;
  paths.list.photons.for_each([&](const Photon& photon) {
    if (std::hypot(photon.position.x, photon.position.z) < 1.0f) sum += mean_flux(photon);
  });
  const double transmitted = 1.0 - 0.2 * 0.2;
  const double cap = 2.0 * std::numbers::pi * (1.0 - 2.0 / std::sqrt(5.0));  // solid angle of the disc
  // 2 10^4 paths, stratified: the noise is that of the disc's border and of the choice, below 1.5 %.
  EXPECT_NEAR(sum / (10.0 * cap * transmitted), 1.0, 0.015);
}

TEST(PhotonTrace, ADarkLightDropsOutAndAsksForNothing) {
  Scene scene = mixed_scene();
  scene.lights[0].intensity = 0.0f;
  const Prepared p(std::move(scene));
  for (const EmissionKind kind : {EmissionKind::map, EmissionKind::uniform}) {
    const PassSettings s = settings_for(p.scene, kind, FirstSurface::stored, 4);
    const MapSet maps = make_maps(p.caustic, s);
    EXPECT_EQ(maps.lights_skipped, 1u);
    EXPECT_EQ(maps.texels_traced, 0u);
    EXPECT_EQ(trace_light_paths(p.caustic, s, maps, 0).list.counts.rays, 0u);
  }
}

TEST(PhotonTrace, SettingsOutOfRangeAreErrors) {
  const Prepared p(mixed_scene());
  PassSettings s = settings_for(p.scene, EmissionKind::map, FirstSurface::stored, 4, 64);
  for (const double rays : {0.0, -1.0, 1e9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    s.rays_per_texel = rays;
    EXPECT_THROW(trace(p, s), InputError) << rays;
  }
  s.rays_per_texel = 1.0;
  for (const int resolution : {0, -5, 65536}) {
    s.map_resolution = resolution;
    EXPECT_THROW(make_maps(p.caustic, s), InputError) << resolution;
  }
}

TEST(PhotonTrace, OpenGlassAndImpossibleIndicesAreErrors) {
  Scene open = empty_scene();
  const uint32_t g = add_material(open, glass(1.5f));
  add_sheet(open, g, vec3(0.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f));
  update_content_hash(open);
  EXPECT_THROW(Prepared{open}, InputError);
  open.materials[g].thin_walled = true;
  EXPECT_NO_THROW(Prepared{open});
  for (const float ior : {0.9f, 0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    Scene scene = mixed_scene();
    scene.materials[1].ior = ior;
    EXPECT_THROW(Prepared{scene}, InputError) << ior;
  }
}

}  // namespace
}  // namespace hybray
