// Light tracing against every closed form: within three standard errors of its own estimate, corrected for
// the number of comparisons, and with an estimate that is sharp enough for that to mean something.
#include "core/caustics/caustic_pass.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/scene/surface_point.h"
#include "core/truth/closed_forms.h"
#include "tests/core/caustics/caustic_scenes.h"
#include "tests/core/sampling_error.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;

constexpr size_t kBatches = 64;        // of one round
constexpr double kPathsOfBatch = 1e5;  // about
constexpr int kMostRounds = 64;
constexpr double kSharp = 0.005;  // greatest relative standard error of an estimate
constexpr size_t kMostComparisons = 150;

struct Case {
  const char* generator;
  int max_events;
};

// Every scene at the lowest order that makes its caustic, and with many events.
class CausticClosedForm : public testing::TestWithParam<Case> {};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const procedural::Generator& generator : procedural::closed_form_generators())
    for (const int events : {1, 2, 3, 32}) all.push_back({generator.name, events});
  return all;
}

// Share of the paths that may meet an interface from a medium other than its own, from above. Two ways lead
// there, both at the edges of bodies with flat faces; smooth bodies have neither.
//
// Rounding: a ray that passes an edge of the body's outline within one float spacing r at the size of the
// scene may be found to meet the face beyond it, from behind. Of parallel light across a shadow of width W,
// 2 r / W comes so close to its two sides, and 2 r / l to its two ends at distance l. From a lamp at height H
// over a square of side 2 a, at least sqrt(a^2 + H^2) from its edges, it is their solid angle, of the
// square's.
//
// The offset: a path goes on from a point that lies h = 2^-19 of the largest length off the surface, along
// the normal. Within h / tan(60 degrees) of an edge of the equilateral prism that point is beyond the other
// face, and where the path leads back to it, it comes from outside in the medium of the inside (the tests of
// PathWalk follow such paths one by one). Light enters the upright face, of sin(15 degrees) of its side as
// the light sees it, toward the upper edge; past the other edges of the lit faces it leads away. Inside,
// about 5 % is reflected, and all of the 4 % that meets the face along which it runs: below 0.15 together, at
// six bands. In the totally reflecting prism all light runs along a leg, so that what came out beyond one
// face never meets it again; right angles have no band.
double mismatch_share(const std::string& scene) {
  using namespace procedural;
  const auto shadow = [](double floor, double width, double length) {
    return 2.0 * 0x1p-23 * floor * (1.0 / width + 1.0 / length);
  };
  const auto square = [](double floor, double a, double height) {
    const double square_of_distance = a * a + height * height;
    const double solid_angle = 4.0 * std::asin(a * a / square_of_distance);
    return 8.0 * a * 0x1p-23 * floor / square_of_distance / solid_angle;
  };
  if (scene == "closed_flat_water")
    return square(FlatWater{}.floor, FlatWater{}.half_width, FlatWater{}.light_height - FlatWater{}.depth);
  if (scene == "closed_glass_slab")
    return square(GlassSlab{}.floor, GlassSlab{}.half_width,
                  GlassSlab{}.light_height - GlassSlab{}.bottom - GlassSlab{}.thickness);
  if (scene == "closed_tir_prism")
    return shadow(TirPrism::wall_half_width, TirPrism::leg, 2.0 * TirPrism::half_length);
  if (scene == "closed_prism") {
    const double degree = std::numbers::pi / 180.0, width = Prism::side * std::cos(15.0 * degree);
    const double offset = kSurfaceOffset * 2.0 * Prism::half_length, band = offset / std::tan(60.0 * degree);
    return shadow(Prism::floor, width, 2.0 * Prism::half_length) +
           (std::sin(15.0 * degree) + 6.0 * 0.15) * band / width;
  }
  return 0.0;
}

// The flux of a photon and the reflectance of a mirror are floats.
constexpr double kRounding = 0x1p-22;

TEST_P(CausticClosedForm, IsWhatLightTracingFinds) {
  const Scene scene = test::closed_form_scene(GetParam().generator);
  const auto form = truth::closed_form(scene, GetParam().max_events);
  if (!form) return;  // this scene needs more events
  const Tracer tracer(scene, {.robust = true, .high_quality = true});
  const CausticScene caustic(tracer);
  PassSettings settings;
  settings.map_resolution = 512;
  settings.first_surface = FirstSurface::traced;
  settings.emission = EmissionKind::mixture;
  settings.walk.max_events = GetParam().max_events;
  settings.walk.roulette_threshold = 0.05;
  settings.lights = {0};
  const MapSet maps = make_maps(caustic, settings);
  ASSERT_EQ(maps.maps.size(), 1u);
  settings.rays_per_texel = kPathsOfBatch / static_cast<double>(maps.texels_total);

  // Rounds of batches until every estimate is sharp.
  std::vector<std::vector<double>> irradiance(form->regions.size());
  LightPaths paths;
  uint64_t all_paths = 0, mismatches = 0;
  uint32_t sample = 0;
  const auto trace_round = [&] {
    for (size_t b = 0; b < kBatches; ++b) {
      trace_light_paths(caustic, settings, maps, sample++, paths);
      EXPECT_NEAR(paths.list.counts.ledger.total() / paths.list.counts.ledger.emitted, 1.0, 1e-9);
      all_paths += paths.list.paths, mismatches += paths.list.counts.medium_mismatches;
      std::vector<double> flux(irradiance.size(), 0.0);
      paths.list.photons.for_each([&](const Photon& photon) {
        if (!form->receives(photon.primitive)) return;
        for (size_t r = 0; r < flux.size(); ++r)
          if (form->regions[r].contains(dvec3(photon.position))) flux[r] += test::mean_flux(photon);
      });
      for (size_t r = 0; r < flux.size(); ++r) irradiance[r].push_back(flux[r] / form->regions[r].area);
    }
  };
  const auto is_sharp = [&] {
    for (size_t r = 0; r < irradiance.size(); ++r)
      if (test::estimate(irradiance[r]).error > kSharp * form->regions[r].irradiance) return false;
    return true;
  };
  int rounds = 0;
  do {
    ASSERT_LT(rounds++, kMostRounds) << "the estimates did not become sharp";
    trace_round();
  } while (!is_sharp());

  for (size_t r = 0; r < irradiance.size(); ++r) {
    const truth::Region& region = form->regions[r];
    const test::Estimate e = test::estimate(irradiance[r]);
    const double limit = test::error_limit(irradiance[r].size(), kMostComparisons) * e.error;
    EXPECT_LE(std::abs(e.mean - region.irradiance),
              limit + region.quadrature_error + kRounding * region.irradiance)
        << form->scene << ", at most " << GetParam().max_events << " events, region " << region.name << ": "
        << e.mean << " +- " << e.error << ", exactly " << region.irradiance;
  }
  // Five standard deviations of a Poisson variable.
  const double most = mismatch_share(form->scene) * static_cast<double>(all_paths);
  EXPECT_LE(static_cast<double>(mismatches), most + 5.0 * std::sqrt(most)) << "of " << all_paths << " paths";
}

TEST(CausticClosedFormRegions, AreNotMoreThanTheLimitIsCorrectedFor) {
  size_t comparisons = 0;
  for (const Case& c : cases())
    if (const auto form = truth::closed_form(test::closed_form_scene(c.generator), c.max_events))
      comparisons += form->regions.size();
  EXPECT_LE(comparisons, kMostComparisons);
  EXPECT_GT(comparisons, kMostComparisons / 2);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.generator) + "_" + std::to_string(info.param.max_events);
}
INSTANTIATE_TEST_SUITE_P(AllScenes, CausticClosedForm, testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace hybray
