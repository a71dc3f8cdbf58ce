// Light tracing against every closed form: within three standard errors of its own estimate, corrected for
// the number of comparisons, and with an estimate that is sharp enough for that to mean something.
#include "core/caustics/caustic_pass.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_forms.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;

constexpr int kBatches = 16;
constexpr double kSharp = 0.005;  // greatest relative standard error of an estimate

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

// Student's t at 15 degrees of freedom for a two-sided probability of 0.0027 / 300: three standard errors of
// a normal distribution, Bonferroni-corrected for at most 300 comparisons.
constexpr double kLimit = 6.7;

TEST_P(CausticClosedForm, IsWhatLightTracingFinds) {
  const procedural::Generator* generator = nullptr;
  for (const procedural::Generator& g : procedural::closed_form_generators())
    if (std::string(g.name) == GetParam().generator) generator = &g;
  ASSERT_NE(generator, nullptr);
  const Scene scene = generator->generate({});
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

  // Batches of rising size until every estimate is sharp.
  double rays = 4e5 / static_cast<double>(maps.texels_total);
  uint32_t sample = 0;
  for (int attempt = 0; attempt < 8; ++attempt, rays *= 2.0) {
    settings.rays_per_texel = rays;
    std::vector<std::vector<double>> flux(form->regions.size(), std::vector<double>(kBatches, 0.0));
    for (size_t b = 0; b < kBatches; ++b) {
      const LightPaths paths = trace_light_paths(caustic, settings, maps, sample++);
      EXPECT_NEAR(paths.list.counts.ledger.total() / paths.list.counts.ledger.emitted, 1.0, 1e-9);
      // Paths that meet a prism within rounding of an edge may pass its other face unseen.
      EXPECT_LE(paths.list.counts.medium_mismatches, paths.list.counts.rays / 10000);
      paths.list.photons.for_each([&](const Photon& photon) {
        if (!form->receives(photon.primitive)) return;
        for (size_t r = 0; r < flux.size(); ++r)
          if (form->regions[r].contains(dvec3(photon.position)))
            flux[r][b] += (static_cast<double>(photon.flux.x) + static_cast<double>(photon.flux.y) +
                           static_cast<double>(photon.flux.z)) /
                          3.0;
      });
    }
    bool sharp = true;
    std::vector<double> means, errors;
    for (size_t r = 0; r < flux.size(); ++r) {
      const truth::Region& region = form->regions[r];
      double mean = 0.0, square = 0.0;
      for (const double f : flux[r]) mean += f / kBatches;
      for (const double f : flux[r]) square += (f - mean) * (f - mean);
      means.push_back(mean / region.area);
      errors.push_back(std::sqrt(square / (kBatches * (kBatches - 1.0))) / region.area);
      sharp &= region.irradiance == 0.0 || errors[r] <= kSharp * region.irradiance;
    }
    if (!sharp) continue;
    for (size_t r = 0; r < flux.size(); ++r) {
      const truth::Region& region = form->regions[r];
      // What is exact but for rounding (a prism's beam) has next to no spread of its own: positions are
      // floats.
      const double slack = region.quadrature_error + 2e-5 * region.irradiance;
      EXPECT_LE(std::abs(means[r] - region.irradiance), kLimit * errors[r] + slack)
          << form->scene << ", at most " << GetParam().max_events << " events, region " << region.name << ": "
          << means[r] << " +- " << errors[r] << ", exactly " << region.irradiance;
    }
    return;
  }
  FAIL() << "the estimates did not become sharp";
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.generator) + "_" + std::to_string(info.param.max_events);
}
INSTANTIATE_TEST_SUITE_P(AllScenes, CausticClosedForm, testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace hybray
