// Image planes of lights: solid angles against closed forms and quadrature, projection, and culling that
// loses nothing.
#include "core/gbuffer/light_frame.h"

#include "core/base/hash.h"
#include "core/base/morton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint64_t kSeed = 731;

Light make_light(LightKind kind, const vec3& position, const vec3& direction, float outer = 0.5f) {
  Light light;
  light.kind = kind;
  light.position = position;
  light.direction = direction;
  light.outer_cone_angle = outer;
  return light;
}

Bounds3 cube(const vec3& center, float half) {
  return {center - half, center + half};
}

// All frames that a light has when nothing is culled.
std::vector<LightFrame> all_frames(const Light& light, int resolution) {
  const Bounds3 around = cube(light.position, 1.0f);
  return light_frames(light, {&around, 1}, around, resolution);
}

double random_in(uint64_t item, uint32_t dimension, double low, double high) {
  return low + (high - low) * random_unit(item, dimension, 0, kSeed);
}

vec3 random_vector(uint64_t item, uint32_t dimension, double reach) {
  return vec3(dvec3(random_in(item, dimension, -reach, reach), random_in(item, dimension + 1, -reach, reach),
                    random_in(item, dimension + 2, -reach, reach)));
}

// Directions along every axis, close to them, and where the choice of the basis turns over.
std::vector<vec3> awkward_directions() {
  std::vector<vec3> list;
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {1.0f, -1.0f}) {
      vec3 d(0.0f);
      d[axis] = sign;
      list.push_back(d);
      d[(axis + 1) % 3] = 1e-7f;
      list.push_back(glm::normalize(d));
    }
  for (const float y : {0.8999999f, 0.9f, 0.9000001f}) list.push_back(vec3(std::sqrt(1.0f - y * y), y, 0.0f));
  return list;
}

double sum_of_measures(const LightFrame& f) {
  double sum = 0.0;
  for (int y = 0; y < f.height; ++y)
    for (int x = 0; x < f.width; ++x) sum += f.texel_measure(x, y);
  return sum;
}

// Integral of measure_density over a texel by 5 x 5 Gauss points.
double quadrature(const LightFrame& f, int x, int y) {
  constexpr std::array<double, 5> kPoint = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                            0.9061798459386640};
  constexpr std::array<double, 5> kWeight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                             0.4786286704993665, 0.2369268850561891};
  double sum = 0.0;
  for (size_t i = 0; i < 5; ++i)
    for (size_t j = 0; j < 5; ++j)
      sum += 0.25 * kWeight[i] * kWeight[j] *
             f.measure_density(x + 0.5 + 0.5 * kPoint[i], y + 0.5 + 0.5 * kPoint[j]);
  return sum;
}

TEST(LightFrame, TheSixFacesOfAPointLightMakeTheWholeSphere) {
  for (const int resolution : {1, 7, 256}) {
    const auto frames =
        all_frames(make_light(LightKind::point, vec3(1.0f, 2.0f, 3.0f), vec3(0, -1, 0)), resolution);
    ASSERT_EQ(frames.size(), 6u);
    double sum = 0.0;
    for (const LightFrame& f : frames) sum += sum_of_measures(f);
    // Each texel is a difference of angles below 1 with some 4 roundings of 1e-16.
    EXPECT_NEAR(sum, 4.0 * kPi, 1e-15 * 6 * resolution * resolution + 1e-14) << resolution;
  }
}

TEST(LightFrame, EveryTexelIsTheIntegralOfTheDensity) {
  for (const LightFrame& f :
       {all_frames(make_light(LightKind::point, vec3(0.0f), vec3(0, -1, 0)), 16)[2],
        all_frames(make_light(LightKind::spot, vec3(0.0f), vec3(0, 0, 1), 0.3f), 5)[0],
        all_frames(make_light(LightKind::directional, vec3(0.0f), vec3(0, 0, 1)), 6)[0]})
    for (int y = 0; y < f.height; ++y)
      for (int x = 0; x < f.width; ++x)
        // Five points are exact to degree 9; the density's scale is 1 and a texel's half width at most 0.07,
        // so that the rest is below 0.07^10.
        EXPECT_NEAR(f.texel_measure(x, y) / quadrature(f, x, y), 1.0, 1e-10) << x << " " << y;
}

TEST(LightFrame, TheDensityIsThatOfTheDirectionsThemselves) {
  const LightFrame f = all_frames(make_light(LightKind::point, vec3(0.0f), vec3(0, -1, 0)), 8)[4];
  constexpr double kStep = 1e-4;
  for (uint64_t i = 0; i < 200; ++i) {
    const double x = random_in(i, 0, 0.0, 8.0), y = random_in(i, 1, 0.0, 8.0);
    const dvec3 along_x = f.ray_direction(x + kStep, y) - f.ray_direction(x - kStep, y);
    const dvec3 along_y = f.ray_direction(x, y + kStep) - f.ray_direction(x, y - kStep);
    const double area = glm::length(glm::cross(along_x, along_y)) / (4.0 * kStep * kStep);
    EXPECT_NEAR(f.measure_density(x, y) / area, 1.0, 1e-7) << "seed " << kSeed << " item " << i;
  }
}

TEST(LightFrame, ASpotFrustumHasTheSolidAngleOfItsPyramid) {
  for (const float outer : {0.05f, 0.3f, 0.6f, 0.785398f}) {
    const auto frames =
        all_frames(make_light(LightKind::spot, vec3(0.0f), vec3(0.6f, -0.8f, 0.0f), outer), 33);
    ASSERT_EQ(frames.size(), 1u);
    const double s = std::sin(static_cast<double>(outer));
    EXPECT_NEAR(sum_of_measures(frames[0]), 4.0 * std::asin(s * s), 1e-12) << outer;
  }
}

TEST(LightFrame, AnOrthographicFrameIsAsLargeAsItsTargets) {
  const Bounds3 target{vec3(1.0f, 0.0f, -1.0f), vec3(3.0f, 1.0f, 2.0f)};
  const Bounds3 scene = cube(vec3(0.0f), 10.0f);
  const struct {
    vec3 direction;
    double area;
  } cases[] = {{vec3(0, -1, 0), 6.0}, {vec3(1, 0, 0), 3.0}, {vec3(0, 0, -1), 2.0}};
  for (const auto& c : cases) {
    const auto frames =
        light_frames(make_light(LightKind::directional, vec3(0.0f), c.direction), {&target, 1}, scene, 12);
    ASSERT_EQ(frames.size(), 1u);
    const double area = sum_of_measures(frames[0]);
    EXPECT_GE(area, c.area);
    // Slack on each side of 1e-4 of the scene's diagonal of 35 m: 0.007 m on sides of 1 m or more.
    EXPECT_LE(area, c.area + 8 * 0.0036 * 3.0);
    EXPECT_NEAR(frames[0].texel_measure(0, 0) / frames[0].texel_measure(11, 5), 1.0, 1e-12);
  }
}

TEST(LightFrame, ProjectIsTheInverseOfTheRays) {
  for (const vec3& direction : awkward_directions())
    for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional})
      for (const float outer : {0.4f, 1.2f})
        for (const LightFrame& f :
             all_frames(make_light(kind, vec3(3.0f, -1.0f, 2.0f), direction, outer), 20)) {
          ASSERT_NEAR(glm::dot(glm::cross(f.right, f.down), f.forward), 1.0, 1e-12);
          for (uint64_t i = 0; i < 20; ++i) {
            const double x = random_in(i, 0, 0.01, 19.99), y = random_in(i, 1, 0.01, 19.99),
                         t = random_in(i, 2, 0.01, 50.0);
            ASSERT_NEAR(glm::length(f.ray_direction(x, y)), 1.0, 1e-14);
            const dvec3 p = f.ray_origin(x, y) + t * f.ray_direction(x, y);
            dvec2 image(0.0);
            ASSERT_TRUE(f.project(p, image));
            ASSERT_NEAR(image.x, x, 1e-9);
            ASSERT_NEAR(image.y, y, 1e-9);
            ASSERT_FALSE(f.project(f.ray_origin(x, y) - t * f.ray_direction(x, y), image));
          }
        }
}

TEST(LightFrame, FacesSplitTheSphereWithoutGapOrOverlap) {
  const auto frames = all_frames(make_light(LightKind::point, vec3(0.0f), vec3(0, -1, 0)), 4);
  for (uint64_t i = 0; i < 20000; ++i) {
    const dvec3 d(random_vector(i, 0, 1.0));
    dvec2 image(0.0);
    EXPECT_EQ(
        std::count_if(frames.begin(), frames.end(), [&](const LightFrame& f) { return f.project(d, image); }),
        1)
        << "seed " << kSeed << " item " << i;
  }
}

TEST(LightFrame, TheFramesOfASpotCoverItsConeHoweverWide) {
  for (const vec3& direction : awkward_directions())
    for (const float outer : {0.02f, 0.7f, 0.785398f, 0.7855f, 1.0f, 1.3f, 1.5707f}) {
      const auto frames = all_frames(make_light(LightKind::spot, vec3(0.0f), direction, outer), 16);
      ASSERT_EQ(frames.size() == 1, outer < 0.7854f) << outer;
      const dvec3 axis = glm::normalize(dvec3(direction));
      dvec3 side, up;
      basis_around(axis, side, up);
      for (uint64_t i = 0; i < 300; ++i) {
        const double angle = std::sqrt(random_in(i, 0, 0.0, 1.0)) * (1.0 - 1e-6) * static_cast<double>(outer);
        const double phi = random_in(i, 1, 0.0, 2.0 * kPi);
        const dvec3 d =
            std::cos(angle) * axis + std::sin(angle) * (std::cos(phi) * side + std::sin(phi) * up);
        dvec2 image(0.0);
        EXPECT_TRUE(std::any_of(frames.begin(), frames.end(),
                                [&](const LightFrame& f) { return f.project(d, image); }))
            << outer << " seed " << kSeed << " item " << i;
      }
    }
}

TEST(LightFrame, AConeThatReachesFewFacesGetsFewFrames) {
  // 50 degrees about an axis reach the faces beside its own, but not the one behind.
  EXPECT_EQ(all_frames(make_light(LightKind::spot, vec3(0.0f), vec3(0, -1, 0), 0.873f), 4).size(), 5u);
}

// Whether the tile of an image point is marked.
bool marked(const LightFrame& f, const std::vector<uint8_t>& tiles, const dvec2& image) {
  const int tiles_x = (f.width + kMortonTile - 1) / kMortonTile;
  const int x = static_cast<int>(image.x) / kMortonTile, y = static_cast<int>(image.y) / kMortonTile;
  return tiles[static_cast<size_t>(y * tiles_x + x)] != 0;
}

TEST(LightFrame, CullingKeepsEveryFrameAndTileThatSeesAPointOfATarget) {
  size_t seen = 0, unmarked = 0, dropped = 0;
  for (uint64_t trial = 0; trial < 400; ++trial) {
    const auto kind = static_cast<LightKind>(trial % 3);
    const Light light =
        make_light(kind, random_vector(trial, 0, 3.0), glm::normalize(random_vector(trial, 3, 1.0)),
                   static_cast<float>(random_in(trial, 6, 0.05, 1.57)));
    std::vector<Bounds3> targets;
    Bounds3 scene = cube(light.position, 0.5f);
    for (uint32_t k = 0; k < 1 + trial % 3; ++k) {
      const vec3 center = random_vector(trial, 10 + 6 * k, 4.0),
                 half = glm::abs(random_vector(trial, 13 + 6 * k, 1.5));
      targets.push_back({center - half, center + half});
      scene.extend(center - half), scene.extend(center + half);
    }
    const auto kept = light_frames(light, targets, scene, 37);
    const auto all = kind == LightKind::directional ? kept : all_frames(light, 37);
    dropped += all.size() - kept.size();
    std::vector<std::vector<uint8_t>> tiles;
    for (const LightFrame& f : kept) {
      tiles.push_back(tiles_that_may_see(f, targets));
      unmarked += static_cast<size_t>(std::count(tiles.back().begin(), tiles.back().end(), 0));
    }
    for (uint64_t i = 0; i < 300; ++i) {
      const Bounds3& box = targets[i % targets.size()];
      dvec3 p(0.0);
      for (int c = 0; c < 3; ++c) {
        // One coordinate in four on a face of the box.
        const double u = random_unit(i, static_cast<uint32_t>(c), static_cast<uint32_t>(trial), kSeed);
        const double s = u < 0.125 ? 0.0 : u < 0.25 ? 1.0 : (u - 0.25) / 0.75;
        p[c] = glm::mix(static_cast<double>(box.lower[c]), static_cast<double>(box.upper[c]), s);
      }
      dvec2 image(0.0);
      bool in_any = false;
      for (const LightFrame& f : all) {
        if (!f.project(p, image)) continue;
        in_any = true;
        const auto same = std::find_if(kept.begin(), kept.end(),
                                       [&](const LightFrame& k) { return k.forward == f.forward; });
        ASSERT_NE(same, kept.end()) << "seed " << kSeed << " trial " << trial;
        ASSERT_TRUE(marked(f, tiles[static_cast<size_t>(same - kept.begin())], image))
            << "seed " << kSeed << " trial " << trial;
      }
      if (kind != LightKind::spot) {
        ASSERT_TRUE(in_any) << "seed " << kSeed << " trial " << trial;
      }
      seen += in_any;
    }
  }
  EXPECT_GT(seen, 50000u);
  // Culling must also do something.
  EXPECT_GT(unmarked, 2000u);
  EXPECT_GT(dropped, 100u);
}

TEST(LightFrame, ALightInsideATargetSeesItEverywhere) {
  const Bounds3 target = cube(vec3(1.0f), 2.0f);
  const auto frames = light_frames(make_light(LightKind::point, vec3(1.5f, 0.0f, 2.9f), vec3(0, -1, 0)),
                                   {&target, 1}, target, 20);
  ASSERT_EQ(frames.size(), 6u);
  for (const LightFrame& f : frames) {
    const auto tiles = tiles_that_may_see(f, {&target, 1});
    EXPECT_EQ(std::count(tiles.begin(), tiles.end(), 1), 9);
  }
}

TEST(LightFrame, WithoutTargetsThereIsNothingToSee) {
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional})
    EXPECT_TRUE(
        light_frames(make_light(kind, vec3(0.0f), vec3(0, -1, 0)), {}, cube(vec3(0.0f), 1.0f), 16).empty());
  // Behind a spot.
  const Bounds3 behind = cube(vec3(0.0f, 5.0f, 0.0f), 1.0f);
  EXPECT_TRUE(light_frames(make_light(LightKind::spot, vec3(0.0f), vec3(0, -1, 0)), {&behind, 1}, behind, 16)
                  .empty());
}

}  // namespace
}  // namespace hybray
