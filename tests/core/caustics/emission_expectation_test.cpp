// Every kind of emission has the same expectation, held against integrals over texels and over the whole
// light.
#include "core/caustics/emission.h"
#include "core/optics/specular_step.h"
#include "tests/core/caustics/emission_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

constexpr double kPi = std::numbers::pi;

// A smooth test function of a start, in all its variables, that is not symmetric.
double test_function(const PathStart& s, const dvec3& center) {
  const dvec3 p = s.origin - center;
  return 1.0 + s.direction.x * s.direction.z + 0.5 * s.direction.y + 0.3 * s.direction.x + 0.1 * p.x * p.x +
         0.05 * p.z;
}

// Integral of intensity * f over the active texels, by midpoints of 12 x 12 parts of each.
dvec3 map_integral(const Lit& lit, const dvec3& center) {
  constexpr int kParts = 12;
  const Light& light = lit.light();
  dvec3 sum(0.0);
  for (const MapTexel& t : lit.map.texels) {
    const LightFrame& f = lit.map.frames[t.frame].frame;
    for (int i = 0; i < kParts; ++i)
      for (int j = 0; j < kParts; ++j) {
        const double x = t.x + (i + 0.5) / kParts, y = t.y + (j + 0.5) / kParts;
        const double a = (2.0 * x / f.width - 1.0) * f.half_width,
                     b = (2.0 * y / f.height - 1.0) * f.half_height;
        double measure = 4.0 * f.half_width * f.half_height / (f.width * f.height * kParts * kParts);
        PathStart s;
        s.origin = dvec3(light.position), s.direction = f.forward;
        if (f.orthographic) {
          s.origin = f.origin + a * f.right + b * f.down;
        } else {
          s.direction = glm::normalize(f.forward + a * f.right + b * f.down);
          measure *= std::pow(1.0 + a * a + b * b, -1.5);
        }
        sum += intensity(light, s.direction) * measure * test_function(s, center);
      }
  }
  return sum;
}

// The same over all that a point or spot light emits into: rings and sectors about its axis.
dvec3 cone_integral(const Light& light, const dvec3& center) {
  constexpr int kRings = 2000, kSectors = 200;
  const double outer = light.kind == LightKind::spot ? static_cast<double>(light.outer_cone_angle) : kPi;
  const dvec3 axis = glm::normalize(dvec3(light.direction));
  dvec3 side, up;
  basis_around(axis, side, up);
  dvec3 sum(0.0);
  for (int i = 0; i < kRings; ++i) {
    const double theta = outer * (i + 0.5) / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const double phi = 2.0 * kPi * j / kSectors;
      PathStart s;
      s.origin = dvec3(light.position);
      s.direction = std::cos(theta) * axis + std::sin(theta) * (std::cos(phi) * side + std::sin(phi) * up);
      const double measure = std::sin(theta) * outer / kRings * 2.0 * kPi / kSectors;
      sum += intensity(light, s.direction) * measure * test_function(s, center);
    }
  }
  return sum;
}

struct Estimates {
  dvec3 mean{0.0}, error{0.0};
  void check(const dvec3& truth, double relative) const {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean[c], truth[c], 4.5 * error[c] + relative * std::abs(truth[c]));
  }
};

// Mean and standard error, over seeds, of the sum of flux * f over a pass.
Estimates estimate(const Lit& lit, EmissionKind kind, double expected, const dvec3& center,
                   const std::function<bool(const PathStart&)>& counts) {
  constexpr int kSeeds = 60;
  std::array<dvec3, kSeeds> sums{};
  Estimates e;
  for (uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Emission emission = lit.emission(kind, expected, 100 + seed);
    for (uint64_t i = 0; i < emission.paths(); ++i)
      if (const PathStart s = emission.start(i); counts(s)) sums[seed] += s.flux * test_function(s, center);
    e.mean += sums[seed] / static_cast<double>(kSeeds);
  }
  for (const dvec3& s : sums) e.error += (s - e.mean) * (s - e.mean);
  for (int c = 0; c < 3; ++c) e.error[c] = std::sqrt(e.error[c] / (kSeeds * (kSeeds - 1.0)));
  return e;
}

TEST(Emission, EveryKindHasTheSameExpectationOverTheMap) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    const dvec3 center(lit.prepared.scene.bounds.center());
    const dvec3 truth = map_integral(lit, center);
    for (const EmissionKind kind : kEmissionKinds) {
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + " light " +
                   std::to_string(static_cast<int>(light.kind)));
      const Estimates e = estimate(lit, kind, 3000.7, center, [](const PathStart& s) { return s.in_map; });
      EXPECT_LT(e.error.x, 0.02 * truth.x);
      // Midpoints of 1/288 of a face: relative error of about 1e-5, more at the edge of a spot's falloff.
      e.check(truth, 1e-4);
    }
  }
}

TEST(Emission, UniformAndMixedEmissionLoseNothingOfWhatTheLightEmits) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    const Bounds3& b = lit.prepared.scene.bounds;
    const dvec3 center(b.center());
    dvec3 truth = cone_integral(light, center);
    std::function<bool(const PathStart&)> counts = [](const PathStart&) { return true; };
    if (light.kind == LightKind::directional) {
      // Of the frame's rectangle count the rays through the box's lid, whose share is known: moments of the
      // lid, moved back along the rays to where they start, by quadrature.
      const auto at_lid = [&](const PathStart& s) {
        return s.origin + s.direction * ((static_cast<double>(b.upper.y) - s.origin.y) / s.direction.y);
      };
      counts = [&, at_lid](const PathStart& s) {
        const dvec3 p = at_lid(s);
        return p.x > static_cast<double>(b.lower.x) && p.x < static_cast<double>(b.upper.x) &&
               p.z > static_cast<double>(b.lower.z) && p.z < static_cast<double>(b.upper.z);
      };
      const dvec3 forward = glm::normalize(dvec3(light.direction));
      const dvec3 plane = lit.emission(EmissionKind::uniform, 1.0, 3).start(0).origin;
      constexpr int kParts = 400;
      truth = dvec3(0.0);
      const dvec3 size(b.upper - b.lower);
      for (int i = 0; i < kParts; ++i)
        for (int j = 0; j < kParts; ++j) {
          const dvec3 lid = dvec3(b.lower) + size * dvec3((i + 0.5) / kParts, 1.0, (j + 0.5) / kParts);
          PathStart s;
          s.direction = forward;
          s.origin = lid - glm::dot(lid - plane, forward) * forward;
          const double measure = size.x * size.z / (kParts * kParts) * -forward.y;
          truth += 10.0 * dvec3(light.color) * measure * test_function(s, center);
        }
    }
    for (const EmissionKind kind : {EmissionKind::uniform, EmissionKind::mixture}) {
      SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)) + " light " +
                   std::to_string(static_cast<int>(light.kind)));
      const Estimates e = estimate(lit, kind, 3000.7, center, counts);
      EXPECT_LT(e.error.x, 0.02 * truth.x);
      e.check(truth, 1e-4);
    }
  }
}

TEST(Emission, WeightsOfTheMixtureStayBelowTheBoundThatTheUniformHalfGives) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    constexpr double kExpected = 20000.0;
    const double measure = UniformDomain(light, lit.prepared.scene.bounds).measure();
    const Emission mixture = lit.emission(EmissionKind::mixture, kExpected);
    const Emission uniform = lit.emission(EmissionKind::uniform, kExpected);
    size_t less = 0;
    for (uint64_t i = 0; i < mixture.paths(); ++i) {
      const PathStart s = mixture.start(i);
      const dvec3 bound = intensity(light, s.direction) * measure / (0.5 * kExpected);
      for (int c = 0; c < 3; ++c) ASSERT_LE(s.flux[c], bound[c] * (1.0 + 1e-12));
      // Through the map the other half takes part, and only there.
      if (bound.x > 0.0) {
        ASSERT_EQ(s.flux.x < bound.x * (1.0 - 1e-9), s.in_map);
      }
      less += s.in_map;
    }
    EXPECT_GT(less, kExpected / 2 - 2);
    for (uint64_t i = 0; i < uniform.paths(); ++i) {
      const PathStart s = uniform.start(i);
      const dvec3 flux = intensity(light, s.direction) * measure / kExpected;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(s.flux[c], flux[c], 1e-12 * (flux[c] + 1e-30));
    }
  }
}

}  // namespace
}  // namespace hybray
