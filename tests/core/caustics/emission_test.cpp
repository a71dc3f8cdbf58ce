// How paths begin: how many, how evenly, with what weights, and that every kind of emission has the same
// expectation.
#include "core/caustics/emission.h"

#include "core/base/error.h"
#include "core/base/lanes.h"
#include "core/caustics/emission_lanes.h"
#include "core/optics/specular_step.h"
#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using namespace caustics;
using namespace test;

constexpr double kPi = std::numbers::pi;
constexpr EmissionKind kKinds[] = {EmissionKind::map, EmissionKind::uniform, EmissionKind::mixture};

// The mixed scene under one light of each kind, with its map.
struct Lit {
  explicit Lit(const Light& light, int resolution = 24)
      : prepared([&] {
          Scene scene = mixed_scene();
          scene.lights = {light};
          update_content_hash(scene);
          return scene;
        }()),
        map(make_visibility_map(prepared.tracer, prepared.caustic.optics, prepared.caustic.targets, 0,
                                resolution)) {}

  const Light& light() const { return prepared.scene.lights[0]; }
  Emission emission(EmissionKind kind, double expected, uint64_t seed = 1) const {
    return {light(), map, prepared.scene.bounds, kind, expected, seed};
  }

  Prepared prepared;
  VisibilityMap map;
};

Light lamp(LightKind kind, float outer = 0.6f) {
  Light light = point_light(vec3(0.3f, 3.0f, 0.4f), 10.0f, vec3(1.0f, 0.8f, 0.5f));
  light.kind = kind;
  light.direction = glm::normalize(vec3(0.1f, -1.0f, -0.1f));
  light.inner_cone_angle = 0.2f, light.outer_cone_angle = outer;
  return light;
}

std::vector<Light> lamps() {
  return {lamp(LightKind::point), lamp(LightKind::spot), lamp(LightKind::spot, 1.1f),
          lamp(LightKind::directional)};
}

// Whether the ray of a start goes through an active texel, by the geometry of the frames alone.
bool through_active(const VisibilityMap& map, const PathStart& s) {
  for (const MapFrame& m : map.frames) {
    const LightFrame& f = m.frame;
    double a, b;
    if (f.orthographic) {
      a = glm::dot(s.origin - f.origin, f.right), b = glm::dot(s.origin - f.origin, f.down);
    } else {
      const double depth = glm::dot(s.direction, f.forward);
      if (depth <= 0.0) continue;
      a = glm::dot(s.direction, f.right) / depth, b = glm::dot(s.direction, f.down) / depth;
    }
    const double x = std::floor((a / f.half_width + 1.0) * 0.5 * f.width),
                 y = std::floor((b / f.half_height + 1.0) * 0.5 * f.height);
    if (x < 0.0 || y < 0.0 || x >= f.width || y >= f.height) continue;
    if (m.active(static_cast<int>(x), static_cast<int>(y))) return true;
  }
  return false;
}

TEST(Emission, AsksForTheTexelsThatItsKindNeeds) {
  const Lit lit(lamp(LightKind::point));
  const auto used = static_cast<double>(lit.map.texels.size());
  ASSERT_GT(used, 100.0);
  EXPECT_DOUBLE_EQ(expected_paths(lit.map, EmissionKind::map, 0.5), 0.5 * used);
  for (const EmissionKind kind : {EmissionKind::uniform, EmissionKind::mixture})
    EXPECT_DOUBLE_EQ(expected_paths(lit.map, kind, 2.0), 2.0 * 6 * 24 * 24);
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e12})
    EXPECT_THROW(expected_paths(lit.map, EmissionKind::uniform, bad), InputError) << bad;
}

TEST(Emission, TheNumberOfPathsIsTheOneExpectedOnAverageAndWithinTwoOfIt) {
  const Lit lit(lamp(LightKind::point));
  for (const EmissionKind kind : kKinds)
    for (const double expected : {0.3, 1.0, 7.25, 1000.7}) {
      double sum = 0.0;
      constexpr int kSeeds = 4000;
      for (uint64_t seed = 0; seed < kSeeds; ++seed) {
        const auto n = static_cast<double>(lit.emission(kind, expected, seed).paths());
        ASSERT_LT(std::abs(n - expected), kind == EmissionKind::mixture ? 2.0 : 1.0);
        sum += n;
      }
      // Each half is one of two neighbouring numbers: variance at most 1/4 each.
      EXPECT_NEAR(sum / kSeeds, expected, 4.5 * std::sqrt(0.5 / kSeeds));
    }
}

TEST(Emission, EveryTexelGetsTheSameNumberOfPathsUpOrDownByOne) {
  const Lit lit(lamp(LightKind::point));
  const size_t texels = lit.map.texels.size();
  for (const double per_texel : {0.3, 1.0, 2.0, 2.7, 16.0})
    for (uint64_t seed = 0; seed < 10; ++seed) {
      const Emission e = lit.emission(EmissionKind::map, per_texel * static_cast<double>(texels), seed);
      Image2D<int> count(static_cast<int>(lit.map.frames.size()) * 24, 24, 0);
      for (uint64_t i = 0; i < e.paths(); ++i) {
        const PathStart s = e.start(i);
        ++count(static_cast<int>(s.frame) * 24 + s.x, s.y);
      }
      // Whole numbers sit on the border of rounding, which may move one path.
      const bool whole = per_texel == std::floor(per_texel);
      size_t off = 0;
      for (const MapTexel& t : lit.map.texels) {
        const int n = count(t.frame * 24 + t.x, t.y);
        ASSERT_GE(n, static_cast<int>(std::floor(per_texel)) - whole);
        ASSERT_LE(n, static_cast<int>(std::ceil(per_texel)) + whole);
        off += whole && n != static_cast<int>(per_texel);
      }
      EXPECT_LE(off, 2u);
    }
}

TEST(Emission, PathsThroughTheMapGoThroughTheTexelTheyName) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    const Emission e = lit.emission(EmissionKind::map, 3.3 * static_cast<double>(lit.map.texels.size()));
    double sum_x = 0.0, sum_y = 0.0;
    for (uint64_t i = 0; i < e.paths(); ++i) {
      const PathStart s = e.start(i);
      ASSERT_TRUE(s.in_map);
      const LightFrame& f = lit.map.frames[s.frame].frame;
      ASSERT_TRUE(lit.map.frames[s.frame].active(s.x, s.y));
      dvec2 image(0.0);
      ASSERT_TRUE(f.project(s.origin + 2.0 * s.direction, image));
      ASSERT_NEAR(image.x, s.x + 0.5, 0.5 + 1e-9);
      ASSERT_NEAR(image.y, s.y + 0.5, 0.5 + 1e-9);
      sum_x += image.x - s.x, sum_y += image.y - s.y;
      if (f.orthographic) {
        ASSERT_EQ(s.direction, f.forward);
      } else {
        ASSERT_EQ(s.origin, dvec3(light.position));
        ASSERT_NEAR(glm::length(s.direction), 1.0, 1e-12);
      }
    }
    // Uniform within the texel: mean 1/2 and variance 1/12.
    const auto n = static_cast<double>(e.paths());
    EXPECT_NEAR(sum_x / n, 0.5, 4.5 / std::sqrt(12.0 * n));
    EXPECT_NEAR(sum_y / n, 0.5, 4.5 / std::sqrt(12.0 * n));
  }
}

TEST(Emission, TheFlagSaysWhetherThePathLeavesThroughTheMap) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    for (const EmissionKind kind : kKinds) {
      const Emission e = lit.emission(kind, 20000.0);
      size_t in = 0, wrong = 0;
      for (uint64_t i = 0; i < e.paths(); ++i) {
        const PathStart s = e.start(i);
        in += s.in_map;
        wrong += s.in_map != through_active(lit.map, s);
      }
      EXPECT_GT(in, 300u);
      EXPECT_EQ(in == e.paths(), kind == EmissionKind::map);
      // On the very border of a texel two ways to compute it may differ.
      EXPECT_LE(wrong, 1u);
    }
  }
}

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
    for (const EmissionKind kind : kKinds) {
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

TEST(Emission, APathIsAFunctionOfItsNumberAndTheSeed) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    for (const EmissionKind kind : kKinds) {
      const Emission a = lit.emission(kind, 500.0, 7), b = lit.emission(kind, 500.0, 7),
                     c = lit.emission(kind, 500.0, 8);
      ASSERT_EQ(a.paths(), b.paths());
      std::vector<PathStart> forward;
      for (uint64_t i = 0; i < a.paths(); ++i) forward.push_back(a.start(i));
      size_t same_as_other = 0;
      for (uint64_t i = a.paths(); i-- > 0;) {
        const PathStart s = b.start(i);
        ASSERT_EQ(s.origin, forward[i].origin);
        ASSERT_EQ(s.direction, forward[i].direction);
        ASSERT_EQ(s.flux, forward[i].flux);
        ASSERT_EQ(s.in_map, forward[i].in_map);
        if (i < c.paths())
          same_as_other += c.start(i).direction == s.direction && c.start(i).origin == s.origin;
      }
      EXPECT_LE(same_as_other, 1u);
    }
  }
}

TEST(Emission, ManyPathsAtOnceAreTheSamePathsBitByBitOnEveryInstructionSet) {
  const auto front = std::make_unique<PathFront>();
  std::array<uint32_t, PathFront::kAllocated> texels{};
  for (const Light& light : lamps()) {
    const Lit lit(light);
    for (const EmissionKind kind : {EmissionKind::map, EmissionKind::mixture}) {
      const Emission e = lit.emission(kind, kind == EmissionKind::map ? 120.0 : 240.0, 11);
      const uint64_t first = 3, count = e.from_map().paths - first;  // not a whole number of vectors
      double emitted = -1.0;
      for (const std::string& target : lanes_targets()) {
        use_lanes_target(target);
        front->count = 0;
        const double sum = start_map_paths(e.from_map(), first, count, 5, *front, texels);
        EXPECT_TRUE(emitted == -1.0 || sum == emitted) << target;
        emitted = sum;
        size_t at = 0;
        double expected = 0.0;
        for (uint64_t i = first; i < first + count; ++i) {
          const PathStart s = e.start(i);
          const double mean = optics::mean(s.flux);
          expected += mean;
          if (!(mean > 0.0)) continue;
          ASSERT_LT(at, front->count);
          const Path path = front->path(at);
          ASSERT_EQ(front->rays.origin(at), vec3(s.origin)) << target;
          ASSERT_EQ(front->rays.direction(at), vec3(s.direction)) << target;
          ASSERT_EQ(path.weight, s.flux) << target;
          ASSERT_EQ(path.initial, mean);
          ASSERT_EQ(path.length, 0.0);
          ASSERT_EQ(path.number, i);
          ASSERT_EQ(path.medium, 5);
          ASSERT_EQ(path.events, 0);
          ASSERT_TRUE(path.in_map);
          const MapTexel& t = lit.map.texels[texels[at]];
          ASSERT_EQ((std::array{uint32_t{t.x}, uint32_t{t.y}, uint32_t{t.frame}}),
                    (std::array{uint32_t{s.x}, uint32_t{s.y}, s.frame}));
          ++at;
        }
        EXPECT_EQ(at, front->count);
        EXPECT_NEAR(emitted, expected, 1e-13 * expected);
      }
      use_lanes_target("");
    }
  }
}

TEST(Emission, AMixtureWithoutATexelIsUniform) {
  Lit lit(lamp(LightKind::point));
  lit.map.texels.clear(), lit.map.frames.clear();
  const Emission e = lit.emission(EmissionKind::mixture, 5000.0);
  double sum = 0.0;
  for (uint64_t i = 0; i < e.paths(); ++i) {
    EXPECT_FALSE(e.start(i).in_map);
    sum += e.start(i).flux.x;
  }
  EXPECT_NEAR(sum / (10.0 * 4.0 * kPi), 1.0, 1.0 / 5000);
}

}  // namespace
}  // namespace hybray
