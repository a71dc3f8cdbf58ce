// One specular event: its expectation, its directions, and the sides of the surface that it keeps to.
#include "core/optics/specular_step.h"

#include "core/base/hash.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray::optics {
namespace {

constexpr uint64_t kSeed = 4711;

double unit(uint64_t item, uint32_t dimension) {
  return random_unit(item, dimension, 0, kSeed);
}

dvec3 random_direction(uint64_t item, uint32_t dimension) {
  const double c = 2.0 * unit(item, dimension) - 1.0,
               phi = 2.0 * std::numbers::pi * unit(item, dimension + 1);
  const double s = std::sqrt(1.0 - c * c);
  return {s * std::cos(phi), s * std::sin(phi), c};
}

// The optics of one material. Media: 0 is vacuum, then those of the material.
SurfaceOptics optics_of(const Material& material, OpticsTable* table = nullptr) {
  Scene scene;
  scene.materials.push_back(material);
  const OpticsTable made = make_optics(scene);
  if (table) *table = made;
  return made.materials[0];
}

Material glass(float ior, float outer_ior = 1.0f) {
  Material m;
  m.base_color = vec3(1.0f);
  m.roughness = 0.0f;
  m.transmission = 1.0f;
  m.ior = ior, m.outer_ior = outer_ior;
  m.absorption = vec3(0.5f), m.outer_absorption = vec3(0.25f);
  return m;
}

// Of every part something, in different colours.
Material mixture(bool thin) {
  Material m = glass(1.5f);
  m.base_color = vec3(0.9f, 0.5f, 0.2f);
  m.metallic = 0.3f, m.transmission = 0.6f;
  m.thin_walled = thin;
  return m;
}

SurfacePoint point_with(const dvec3& geometric, const dvec3& shading) {
  SurfacePoint p;
  p.position = dvec3(1.0, 2.0, 3.0);
  p.geometric_normal = geometric, p.shading_normal = shading;
  p.offset = 1e-4;
  return p;
}

SpecularChoice choose(const SurfaceOptics& s, const SurfacePoint& p, const dvec3& direction,
                      const dvec3& weight, double u, uint16_t medium = 7) {
  const Facing f = facing(p, direction);
  return choose_specular(s, p, f, {split(s, f.cos_incident, f.from_inner), weight}, direction, medium, u);
}

TEST(SpecularStep, TheExpectationOfTheWeightIsTheSpecularShareByChannel) {
  constexpr int kSteps = 20000;
  const dvec3 weight(0.2, 1.0, 3.0);
  for (const Material& m : {glass(1.5f), glass(1.0f, 1.33f), mixture(false), mixture(true)}) {
    const SurfaceOptics s = optics_of(m);
    for (const dvec3& direction : {dvec3(0.0, -1.0, 0.0), dvec3(0.6, -0.8, 0.0), dvec3(0.6, 0.8, 0.0)}) {
      const SurfacePoint p = point_with(dvec3(0.0, 1.0, 0.0), dvec3(0.0, 1.0, 0.0));
      const Facing f = facing(p, direction);
      const SpecularSplit shares = split(s, f.cos_incident, f.from_inner);
      dvec3 reflected(0.0), through(0.0);
      int reflections = 0;
      for (int i = 0; i < kSteps; ++i) {
        const SpecularChoice c = choose(s, p, direction, weight, (i + 0.5) / kSteps);
        (c.reflected ? reflected : through) += c.weight / static_cast<double>(kSteps);
        reflections += c.reflected;
      }
      // u goes through [0, 1) evenly: the border between the choices is wrong by at most half a step.
      const double back = mean(weight * shares.reflectance), on = mean(weight * shares.transmittance);
      EXPECT_NEAR(static_cast<double>(reflections) / kSteps, back / (back + on), 1.0 / kSteps);
      for (int c = 0; c < 3; ++c) {
        const double slack =
            1.0 / kSteps * weight[c] * (back + on) / (back > 0.0 ? std::min(back, on + 1e-9) : on);
        EXPECT_NEAR(reflected[c], weight[c] * shares.reflectance[c], slack + 1e-12);
        EXPECT_NEAR(through[c], weight[c] * shares.transmittance[c], slack + 1e-12);
      }
    }
  }
}

TEST(SpecularStep, ColouredLightChoosesByWhatItCarries) {
  // A mirror for red behind a sheet that lets blue through: red light is mirrored, blue light goes on.
  SurfaceOptics s = optics_of(mixture(true));
  SpecularSplit shares;
  shares.reflectance = dvec3(0.8, 0.0, 0.1), shares.transmittance = dvec3(0.0, 0.5, 0.3);
  const SurfacePoint p = point_with(dvec3(0.0, 1.0, 0.0), dvec3(0.0, 1.0, 0.0));
  const dvec3 direction(0.6, -0.8, 0.0);
  const Facing f = facing(p, direction);
  const auto at = [&](const dvec3& weight, double u) {
    return choose_specular(s, p, f, {shares, weight}, direction, 0, u);
  };
  for (const double u : {0.0, 0.5, 0.999999}) {
    EXPECT_TRUE(at(dvec3(1.0, 0.0, 0.0), u).reflected);
    EXPECT_FALSE(at(dvec3(0.0, 1.0, 0.0), u).reflected);
    // Blue: one part in four.
    EXPECT_EQ(at(dvec3(0.0, 0.0, 2.0), u).reflected, u < 0.25);
  }
  // All three: (0.8 + 0.2) / (0.8 + 1 + 0.8) with weights 1, 2, 2.
  EXPECT_TRUE(at(dvec3(1.0, 2.0, 2.0), 1.0 / 2.6 - 1e-9).reflected);
  EXPECT_FALSE(at(dvec3(1.0, 2.0, 2.0), 1.0 / 2.6 + 1e-9).reflected);
  // Nothing goes on where nothing is left.
  shares = SpecularSplit{};
  EXPECT_EQ(at(dvec3(1.0), 0.5).weight, dvec3(0.0));
}

TEST(SpecularStep, ReflectionsMirrorAndRefractionsObeySnellsLaw) {
  for (const auto& [inner, outer] : {std::pair(1.5f, 1.0f), std::pair(1.33f, 1.5f), std::pair(2.4f, 1.2f)}) {
    const SurfaceOptics s = optics_of(glass(inner, outer));
    for (uint64_t i = 0; i < 2000; ++i) {
      const dvec3 n = random_direction(i, 0), d = random_direction(i, 2);
      const bool inside = glm::dot(d, n) > 0.0;
      const double before = static_cast<double>(inside ? inner : outer),
                   beyond = static_cast<double>(inside ? outer : inner);
      const double sin_in = glm::length(glm::cross(d, n)), sin_out = sin_in * before / beyond;
      const SurfacePoint p = point_with(n, n);
      const SpecularChoice back = choose(s, p, d, dvec3(1.0), 0.0);
      ASSERT_TRUE(back.reflected);
      // The part along the normal turns round, the part across stays.
      EXPECT_NEAR(glm::dot(back.direction, n), -glm::dot(d, n), 1e-12);
      EXPECT_NEAR(glm::length(glm::cross(back.direction - d, n)), 0.0, 1e-12);
      const SpecularChoice on = choose(s, p, d, dvec3(1.0), 1.0 - 1e-12);
      if (sin_out > 1.0 + 1e-9) {
        EXPECT_TRUE(on.reflected) << "total reflection";
      } else if (sin_out < 1.0 - 1e-9) {
        ASSERT_FALSE(on.reflected);
        EXPECT_NEAR(glm::length(on.direction), 1.0, 1e-12);
        // In the plane of incidence, on the other side, n sin conserved.
        EXPECT_NEAR(glm::dot(glm::cross(d, n), on.direction), 0.0, 1e-12);
        EXPECT_GT(glm::dot(on.direction, n) * glm::dot(d, n), 0.0);
        EXPECT_NEAR(glm::length(glm::cross(on.direction, n)), sin_out, 1e-10);
        EXPECT_GE(glm::dot(on.direction - glm::dot(on.direction, n) * n, d - glm::dot(d, n) * n), 0.0);
      }
    }
  }
}

TEST(SpecularStep, TheMediumChangesWhereLightGoesThroughAndOnlyThere) {
  OpticsTable table;
  const SurfaceOptics s = optics_of(glass(1.5f, 1.33f), &table);
  const SurfacePoint p = point_with(dvec3(0.0, 1.0, 0.0), dvec3(0.0, 1.0, 0.0));
  for (const dvec3& d : {dvec3(0.1, -1.0, 0.0), dvec3(0.1, 1.0, 0.0)}) {
    const dvec3 direction = glm::normalize(d);
    EXPECT_EQ(choose(s, p, direction, dvec3(1.0), 0.0).medium, 7);
    const Medium& beyond = table.media[choose(s, p, direction, dvec3(1.0), 0.9999).medium];
    EXPECT_FLOAT_EQ(static_cast<float>(beyond.ior), d.y < 0.0 ? 1.5f : 1.33f);
    EXPECT_EQ(beyond.absorption, dvec3(d.y < 0.0 ? 0.5 : 0.25));
  }
}

TEST(SpecularStep, AThinSheetLetsLightGoStraightOnInTheSameMedium) {
  const SurfaceOptics s = optics_of(mixture(true));
  int through = 0;
  for (uint64_t i = 0; i < 500; ++i) {
    const dvec3 n = random_direction(i, 0), d = random_direction(i, 2);
    const SpecularChoice c = choose(s, point_with(n, n), d, dvec3(1.0), 1.0 - 1e-12);
    if (c.reflected) continue;  // grazing light may leave no more than rounding for the sheet
    ++through;
    EXPECT_EQ(c.direction, d);
    EXPECT_EQ(c.medium, 7);
  }
  EXPECT_GT(through, 490);
}

TEST(SpecularStep, PathsStayOnTheirSideOfTheSurfaceWhateverTheShadingNormal) {
  const SurfaceOptics clear = optics_of(glass(1.5f)), sheet = optics_of(mixture(true));
  size_t bent = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    const dvec3 n = random_direction(i, 0), shading = random_direction(i, 2), d = random_direction(i, 4);
    const SurfacePoint p = point_with(n, shading);
    const Facing f = facing(p, d);
    ASSERT_LT(glm::dot(d, f.geometric), 0.0);
    ASSERT_LT(glm::dot(d, f.shading), 0.0);
    ASSERT_GT(f.cos_incident, 0.0);
    ASSERT_NEAR(f.cos_incident, -glm::dot(d, f.shading), 1e-15);
    ASSERT_EQ(f.from_inner, glm::dot(d, n) > 0.0);
    // The shading normal is kept, turned with the geometric one, wherever it faces the path.
    const dvec3 turned = f.from_inner ? -shading : shading;
    ASSERT_EQ(f.shading, glm::dot(d, turned) < 0.0 ? turned : f.geometric);
    bent += f.shading == turned;
    for (const SurfaceOptics& s : {clear, sheet})
      for (const double u : {0.0, 1.0 - 1e-12}) {
        const SpecularChoice c = choose(s, p, d, dvec3(1.0), u);
        // Both the direction and the start lie on the side of arrival after a reflection, and on the other
        // one after a transmission.
        const double side = c.reflected ? 1.0 : -1.0;
        ASSERT_GT(side * glm::dot(c.direction, f.geometric), 0.0) << "seed " << kSeed << " item " << i;
        ASSERT_NEAR(side * glm::dot(c.origin - p.position, f.geometric), p.offset, 1e-12);
        ASSERT_NEAR(glm::length(c.direction), 1.0, 1e-12);
        ASSERT_TRUE(c.weight.x >= 0.0 && std::isfinite(c.weight.x));
        if (u == 0.0) {
          ASSERT_TRUE(c.reflected);
        }
        // Where the shading normal sends light to the right side, it decides.
        const dvec3 mirrored = d - 2.0 * glm::dot(d, f.shading) * f.shading;
        if (c.reflected && glm::dot(mirrored, f.geometric) > 0.0) {
          ASSERT_NEAR(glm::length(c.direction - mirrored), 0.0, 1e-12);
        }
      }
  }
  EXPECT_GT(bent, 5000u);
}

}  // namespace
}  // namespace hybray::optics
