// How paths begin: how many, how evenly, through which texels, and the same on every instruction set.
#include "core/caustics/emission.h"

#include "core/base/error.h"
#include "core/base/lanes.h"
#include "core/caustics/emission_lanes.h"
#include "core/optics/specular_step.h"
#include "tests/core/caustics/emission_lights.h"

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
  for (const EmissionKind kind : kEmissionKinds)
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
    for (const EmissionKind kind : kEmissionKinds) {
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

TEST(Emission, APathIsAFunctionOfItsNumberAndTheSeed) {
  for (const Light& light : lamps()) {
    const Lit lit(light);
    for (const EmissionKind kind : kEmissionKinds) {
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
