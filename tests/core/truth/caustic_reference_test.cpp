// The converged reference against what it must equal.
#include "core/truth/caustic_reference.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;
using truth::CausticReference;
using truth::CausticReferenceBatch;
using truth::CausticReferenceSettings;

constexpr float kReflectance = 0.8f;
constexpr float kMirrorZ = -2.0f;

// A glass ball over a floor, its caustic seen in an upright mirror in the plane z = kMirrorZ.
Scene mirror_scene(bool with_mirror) {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.7f, 0.7f, 0.5f));
  const uint32_t g = add_material(scene, glass(1.5f));
  const uint32_t m = add_material(scene, mirror(vec3(kReflectance)));
  add_rectangle(scene, vec3(-2.0f, 0.0f, 2.0f), vec3(4.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, kMirrorZ - 2.0f));
  append_analytic(scene, analytic_sphere("ball", g, dvec3(0.0, 1.2, -1.0), 0.4));
  if (with_mirror)
    add_sheet(scene, m, vec3(-2.0f, 0.0f, kMirrorZ), vec3(4.0f, 0.0f, 0.0f), vec3(0.0f, 2.0f, 0.0f));
  scene.lights.push_back(point_light(vec3(0.1f, 3.0f, -0.9f), 20.0f));
  update_content_hash(scene);
  return scene;
}

constexpr int kSide = 48;

CausticReferenceSettings reference_settings() {
  CausticReferenceSettings s;
  s.paths = 200000;
  s.map_resolution = 128;
  s.passes = 2;
  s.radius_pixels = 1.0;
  s.lights = {0};
  return s;
}

// Sum of channel means over a square of pixels.
double block_sum(const Image2D<vec3>& image, int x0, int y0, int side, bool mirrored) {
  double sum = 0.0;
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x) {
      const vec3& v = image(mirrored ? image.width() - 1 - x : x, y);
      sum += static_cast<double>(v.x + v.y + v.z) / 3.0;
    }
  return sum;
}

struct Estimate {
  double mean, error;
};
Estimate estimate(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double mean = 0.0, square = 0.0;
  for (const double v : values) mean += v / n;
  for (const double v : values) square += (v - mean) * (v - mean);
  return {mean, std::sqrt(square / (n * (n - 1.0)))};
}

TEST(CausticReference, ACausticInAMirrorIsLightTracingIntoTheMirroredCameraTimesReflectance) {
  const Prepared p(mirror_scene(true)), without(mirror_scene(false));
  // The camera looks over the ball into the mirror; the mirrored camera sees the same through the wall.
  const vec3 eye(0.5f, 1.5f, 0.9f), target(0.1f, 0.55f, kMirrorZ);
  const auto behind = [](const vec3& v) { return vec3(v.x, v.y, 2.0f * kMirrorZ - v.z); };
  const View view = make_view(p.scene, eye, target, kSide, kSide, 22.0f);
  const View mirrored = make_view(without.scene, behind(eye), behind(target), kSide, kSide, 22.0f);
  const GBuffer camera = make_gbuffer(p.tracer, view, kCausticBits);
  const GBuffer through = make_gbuffer(without.tracer, mirrored, kCausticBits);

  constexpr uint32_t kBatches = 12;
  const CausticReference reference(p.caustic, camera, reference_settings());
  std::vector<CausticReferenceBatch> seen;
  for (uint32_t b = 0; b < kBatches; ++b) seen.push_back(reference.batch(b));
  ASSERT_FALSE(seen[0].mixed.empty());

  // Light paths of the scene with the mirror, deposited from behind where the mirror does not stand in the
  // way.
  PassSettings settings;
  settings.map_resolution = 128;
  settings.emission = EmissionKind::mixture;
  settings.first_surface = FirstSurface::traced;
  settings.walk.max_events = 64;
  settings.walk.seed = 99;
  settings.rays_per_texel = 4.0;
  settings.lights = {0};
  const MapSet maps = make_maps(p.caustic, settings);
  std::vector<Image2D<vec3>> traced;
  for (uint32_t b = 0; b < kBatches; ++b) {
    const LightPaths paths = trace_light_paths(p.caustic, settings, maps, b);
    FixedPointImage sums(kSide, kSide, largest_radiance(1e4, through));
    splat(paths.list.photons, through, p.caustic.optics, Visibility::shadow, without.tracer, sums);
    traced.push_back(sums.image());
  }

  int compared = 0;
  constexpr int kBlock = 6;
  for (int y0 = 0; y0 + kBlock <= kSide; y0 += kBlock)
    for (int x0 = 0; x0 + kBlock <= kSide; x0 += kBlock) {
      // Blocks that see the mirror, and in it the floor, with every pixel and a border around.
      bool plain = true;
      for (int y = std::max(0, y0 - 2); y < std::min(kSide, y0 + kBlock + 2); ++y)
        for (int x = std::max(0, x0 - 2); x < std::min(kSide, x0 + kBlock + 2); ++x) {
          const uint32_t direct = camera.primitive(x, y), reflected = through.primitive(kSide - 1 - x, y);
          plain &= direct != kNoPrimitive && p.scene.material_of(direct) == 2 && reflected != kNoPrimitive &&
                   without.scene.material_of(reflected) == 0;
        }
      if (!plain) continue;
      std::vector<double> mixed, wide, light;
      for (uint32_t b = 0; b < kBatches; ++b) {
        mixed.push_back(block_sum(seen[b].mixed, x0, y0, kBlock, false));
        wide.push_back(block_sum(seen[b].mixed_wide, x0, y0, kBlock, false));
        light.push_back(static_cast<double>(kReflectance) * block_sum(traced[b], x0, y0, kBlock, true));
      }
      const Estimate m = estimate(mixed), w = estimate(wide), l = estimate(light);
      if (l.mean < 1e-3) continue;
      // 4.5 standard errors, and the bias that the reference itself states, with its noise.
      const double bias = std::abs(w.mean - m.mean) + 2.0 * std::hypot(m.error, w.error);
      EXPECT_NEAR(m.mean, l.mean, 4.5 * std::hypot(m.error, l.error) + bias) << x0 << " " << y0;
      ++compared;
    }
  EXPECT_GT(compared, 8);

  // All of those blocks' light together is sharp enough for the factor.
  std::vector<double> ratio_top, ratio_bottom;
  for (uint32_t b = 0; b < kBatches; ++b) {
    double top = 0.0, bottom = 0.0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const uint32_t direct = camera.primitive(x, y), reflected = through.primitive(kSide - 1 - x, y);
        if (direct == kNoPrimitive || p.scene.material_of(direct) != 2) continue;
        if (reflected == kNoPrimitive || without.scene.material_of(reflected) != 0) continue;
        top += static_cast<double>(seen[b].mixed(x, y).x);
        bottom += static_cast<double>(traced[b](kSide - 1 - x, y).x);
      }
    ratio_top.push_back(top), ratio_bottom.push_back(bottom);
  }
  const Estimate top = estimate(ratio_top), bottom = estimate(ratio_bottom);
  EXPECT_LT(top.error / top.mean, 0.01);
  EXPECT_NEAR(top.mean / bottom.mean, static_cast<double>(kReflectance),
              4.5 * 0.8 * std::hypot(top.error / top.mean, bottom.error / bottom.mean) + 0.01);
}

TEST(CausticReference, ABatchIsTheSameBitsAtAnyNumberOfThreads) {
  const Prepared p(mirror_scene(true));
  const View view = make_view(p.scene, vec3(0.5f, 1.5f, 0.9f), vec3(0.1f, 0.4f, kMirrorZ), 32, 24, 40.0f);
  const GBuffer camera = make_gbuffer(p.tracer, view, kCausticBits);
  CausticReferenceSettings settings = reference_settings();
  settings.paths = 30000;
  const CausticReference reference(p.caustic, camera, settings);
  CausticReferenceBatch first;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const CausticReferenceBatch batch = reference.batch(3);
    EXPECT_EQ(batch.overflows, 0u);
    EXPECT_NEAR(batch.ledger.total() / batch.ledger.emitted, 1.0, 1e-9);
    if (threads == 1) {
      first = batch;
      continue;
    }
    for (size_t i = 0; i < first.illumination.size(); ++i) {
      ASSERT_EQ(first.illumination[i], batch.illumination[i]);
      ASSERT_EQ(first.mixed[i], batch.mixed[i]);
    }
  }
}

uint64_t hash_of(const Image2D<vec3>& image, uint64_t seed) {
  return hash_bytes(image.data(), image.size() * sizeof(vec3), seed);
}

CausticReferenceBatch pinned_batch(Scene scene) {
  const Prepared p(std::move(scene));
  const View view = make_view(p.scene, vec3(0.5f, 1.5f, 0.9f), vec3(0.1f, 0.55f, kMirrorZ), 32, 24, 40.0f);
  const GBuffer camera = make_gbuffer(p.tracer, view, kCausticBits);
  CausticReferenceSettings settings = reference_settings();
  settings.paths = 30000;
  return CausticReference(p.caustic, camera, settings).batch(5);
}

// Caches keep batches from one build of the program to the next, by the version of the estimator. Hits on
// analytic surfaces are our own arithmetic, the same on every instruction set; Embree's triangles are not.
TEST(CausticReference, ItsNumbersAreThoseOfItsVersion) {
  constexpr int kPinnedVersion = 2;
  constexpr uint64_t kPinnedHash = 0x47815ea7e139f118;
  const char* const advice =
      ": bump the version (truth::kEstimatorVersion), or caches will serve the old numbers; then pin the new";
  EXPECT_EQ(truth::kEstimatorVersion, kPinnedVersion);

  // A matte globe with a glass ball, a mirror ball and a lamp in it.
  Scene globe = empty_scene();
  globe.materials[0] = matte(vec3(0.7f, 0.7f, 0.5f));
  const uint32_t g = add_material(globe, glass(1.5f, vec3(0.2f, 0.5f, 0.1f)));
  const uint32_t m = add_material(globe, mirror(vec3(kReflectance)));
  append_analytic(globe, analytic_sphere("globe", 0, dvec3(0.0, 1.0, 0.0), 4.0));
  append_analytic(globe, analytic_sphere("ball", g, dvec3(0.0, 1.2, -1.0), 0.4));
  append_analytic(globe, analytic_sphere("mirror", m, dvec3(-0.6, 0.4, -1.6), 0.5));
  globe.lights.push_back(point_light(vec3(0.1f, 3.0f, -0.9f), 20.0f));
  update_content_hash(globe);
  const CausticReferenceBatch exact = pinned_batch(std::move(globe));
  ASSERT_FALSE(exact.mixed.empty());
  const uint64_t hash =
      hash_of(exact.mixed_wide, hash_of(exact.mixed, hash_of(exact.illumination, exact.rays)));
  EXPECT_EQ(hash, kPinnedHash) << hex(hash) << advice;

  const CausticReferenceBatch triangles = pinned_batch(mirror_scene(true));
  const double sums[] = {block_sum(triangles.illumination, 0, 0, 24, false),
                         block_sum(triangles.mixed, 0, 0, 24, false),
                         block_sum(triangles.mixed_wide, 0, 0, 24, false)};
  constexpr double kPinnedSums[] = {78.6436070, 38.5488984, 37.9325619};  // SSE2 to AVX-512: within 1e-8
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sums[i], kPinnedSums[i], 1e-6 * kPinnedSums[i]) << i << advice;
}

TEST(CausticReference, ItsDescriptionTellsEverySettingApart) {
  using S = CausticReferenceSettings;
  const auto changed = [](auto change) {
    S s = reference_settings();
    change(s);
    return describe(s);
  };
  std::set<std::string> texts{changed([](S&) {}),
                              changed([](S& s) { s.paths = 200001; }),
                              changed([](S& s) { s.map_resolution = 129; }),
                              changed([](S& s) { s.max_events = 63; }),
                              changed([](S& s) { s.mixed = false; }),
                              changed([](S& s) { s.passes = 3; }),
                              changed([](S& s) { s.radius_pixels = std::nextafter(1.0, 2.0); }),
                              changed([](S& s) { s.camera_paths = 2; }),
                              changed([](S& s) { s.lights = {}; }),
                              changed([](S& s) {
                                s.lights = {0, 1};
                              }),
                              changed([](S& s) { s.lights = {1}; }),
                              changed([](S& s) { s.mode = TraceMode::single; }),
                              changed([](S& s) { s.seed = 2; })};
  EXPECT_EQ(texts.size(), 13u);
}

TEST(CausticReference, WhatACoarseMapMissesIsFoundAndMeasured) {
  const Prepared p(mirror_scene(false));
  const View view = make_view(p.scene, vec3(0.0f, 4.0f, 1.5f), vec3(0.0f, 0.0f, -0.5f), 32, 24, 60.0f);
  const GBuffer camera = make_gbuffer(p.tracer, view, kCausticBits);
  double energy[2] = {}, missed[2] = {}, errors[2] = {};
  int k = 0;
  for (const int resolution : {4, 256}) {
    CausticReferenceSettings settings = reference_settings();
    settings.mixed = false;
    settings.map_resolution = resolution;
    const CausticReference reference(p.caustic, camera, settings);
    std::vector<double> landed;
    double share = 0.0;
    for (uint32_t b = 0; b < 8; ++b) {
      const CausticReferenceBatch batch = reference.batch(b);
      landed.push_back(batch.counts.landed);
      share += batch.counts.missed_by_map / batch.counts.landed / 8.0;
    }
    const Estimate e = estimate(landed);
    energy[k] = e.mean, errors[k] = e.error, missed[k++] = share;
  }
  // The ball fills 0.4 of a texel's width at 4 texels a face: its map misses a good part or all of it.
  EXPECT_GT(missed[0], 0.05);
  EXPECT_LT(missed[1], 0.02);
  EXPECT_NEAR(energy[0], energy[1], 4.5 * std::hypot(errors[0], errors[1]));
}

}  // namespace
}  // namespace hybray
