// The intensity of lights by direction, and uniform sampling of all that they emit into.
#include "core/caustics/light_source.h"

#include "core/base/hash.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray::caustics {
namespace {

constexpr double kPi = std::numbers::pi;

Light spot(double inner, double outer) {
  Light light;
  light.kind = LightKind::spot;
  light.position = vec3(1.0f, 2.0f, 3.0f);
  light.direction = vec3(0.6f, 0.0f, -0.8f);
  light.color = vec3(1.0f, 0.5f, 0.25f);
  light.intensity = 8.0f;
  light.inner_cone_angle = static_cast<float>(inner);
  light.outer_cone_angle = static_cast<float>(outer);
  return light;
}

// Unit direction at `angle` from the axis of spot().
dvec3 off_axis(double angle) {
  return std::cos(angle) * dvec3(0.6, 0.0, -0.8) + std::sin(angle) * dvec3(0.0, 1.0, 0.0);
}

TEST(LightSource, ASpotFallsOffBetweenItsConesByTheSquareOfTheCosinesShare) {
  const double inner = std::acos(0.9), outer = std::acos(0.7);
  const Light light = spot(inner, outer);
  for (const auto& [cosine, share] :
       {std::pair(1.0, 1.0), std::pair(0.9001, 1.0), std::pair(0.85, 0.5625), std::pair(0.8, 0.25),
        std::pair(0.75, 0.0625), std::pair(0.6999, 0.0), std::pair(-1.0, 0.0)}) {
    const dvec3 i = intensity(light, off_axis(std::acos(cosine)));
    // Angles and axis are floats: 1e-7 in a cosine, over a border of 0.2.
    EXPECT_NEAR(i.x, 8.0 * share, 2e-5) << cosine;
    EXPECT_NEAR(i.y, 4.0 * share, 2e-5) << cosine;
    EXPECT_NEAR(i.z, 2.0 * share, 2e-5) << cosine;
  }
}

TEST(LightSource, ASpotWithoutABorderIsFullInsideAndDarkOutside) {
  const Light light = spot(0.5, 0.5);
  EXPECT_EQ(intensity(light, off_axis(0.49)).x, 8.0);
  EXPECT_EQ(intensity(light, off_axis(0.5001)).x, 0.0);
}

TEST(LightSource, OtherLightsAreTheSameInEveryDirection) {
  Light light = spot(0.1, 0.2);
  for (const LightKind kind : {LightKind::point, LightKind::directional}) {
    light.kind = kind;
    for (const double angle : {0.0, 1.0, 3.0})
      EXPECT_EQ(intensity(light, off_axis(angle)), dvec3(8.0, 4.0, 2.0));
  }
}

TEST(LightSource, EmitsUnlessIntensityColourOrConeIsZero) {
  Light light = spot(0.1, 0.2);
  EXPECT_TRUE(emits(light));
  light.color = vec3(0.0f, 0.0f, 0.1f);
  EXPECT_TRUE(emits(light));
  light.color = vec3(0.0f);
  EXPECT_FALSE(emits(light));
  light = spot(0.1, 0.2);
  light.intensity = 0.0f;
  EXPECT_FALSE(emits(light));
  light = spot(0.0, 0.0);
  EXPECT_FALSE(emits(light));
  light.kind = LightKind::point;
  EXPECT_TRUE(emits(light));
}

TEST(LightSource, SamplesOfTheSphereAndOfConesAreUniform) {
  constexpr int kSteps = 400;
  Light light = spot(0.1, 0.2);
  for (const double outer : {0.2, 1.0, 1.5, kPi}) {
    light.kind = outer == kPi ? LightKind::point : LightKind::spot;
    light.outer_cone_angle = static_cast<float>(outer);
    const double c = outer == kPi ? -1.0 : std::cos(static_cast<double>(light.outer_cone_angle));
    const UniformDomain domain(light, {vec3(-1.0f), vec3(1.0f)});
    EXPECT_NEAR(domain.measure(), 2.0 * kPi * (1.0 - c), 1e-12);
    const dvec3 axis = glm::normalize(dvec3(light.direction));
    dvec3 mean(0.0);
    double along = 0.0, side = 0.0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        dvec3 origin(0.0), d(0.0);
        domain.sample((i + 0.5) / kSteps, (j + 0.5) / kSteps, origin, d);
        ASSERT_EQ(origin, dvec3(light.position));
        ASSERT_NEAR(glm::length(d), 1.0, 1e-12);
        ASSERT_GE(glm::dot(d, axis), c - 1e-12);
        mean += d / (1.0 * kSteps * kSteps);
        along += std::pow(glm::dot(d, axis), 2) / (1.0 * kSteps * kSteps);
        side += d.y * d.y / (1.0 * kSteps * kSteps);
      }
    // Moments of a cap: mean cosine (1 + c) / 2, mean of its square (1 + c + c^2) / 3, and what is left of 1
    // is shared by the two directions across, of which y is one.
    EXPECT_NEAR(glm::length(mean - 0.5 * (1.0 + c) * axis), 0.0, 1e-5);
    EXPECT_NEAR(along, (1.0 + c + c * c) / 3.0, 1e-5);
    EXPECT_NEAR(side, 0.5 * (1.0 - (1.0 + c + c * c) / 3.0), 1e-5);
  }
}

TEST(LightSource, ADirectionalLightEmitsThroughARectangleThatHoldsTheShadowOfTheScene) {
  Light light = spot(0.1, 0.2);
  light.kind = LightKind::directional;
  const Bounds3 scene{vec3(-1.0f, 0.0f, -2.0f), vec3(3.0f, 1.0f, 2.0f)};
  const UniformDomain domain(light, scene);
  dvec3 corner(0.0), right(0.0), down(0.0), d(0.0);
  domain.sample(0.0, 0.0, corner, d);
  domain.sample(1.0, 0.0, right, d);
  domain.sample(0.0, 1.0, down, d);
  EXPECT_NEAR(glm::length(d - dvec3(0.6, 0.0, -0.8)), 0.0, 1e-6);
  EXPECT_NEAR(domain.measure(), glm::length(glm::cross(right - corner, down - corner)), 1e-9);
  // Across the direction the box is 4 * 0.8 + 4 * 0.6 wide and 1 high.
  EXPECT_NEAR(domain.measure(), 5.6, 0.02);
  for (uint64_t i = 0; i < 500; ++i) {
    dvec3 p(0.0);
    for (uint32_t k = 0; k < 3; ++k) {
      const int c = static_cast<int>(k);
      p[c] = glm::mix(static_cast<double>(scene.lower[c]), static_cast<double>(scene.upper[c]),
                      random_unit(i, k, 0, 6));
    }
    // The line through p against the light crosses the rectangle, before the scene.
    const dvec3 a = right - corner, b = down - corner;
    const double u = glm::dot(p - corner, a) / glm::dot(a, a), v = glm::dot(p - corner, b) / glm::dot(b, b);
    EXPECT_TRUE(u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0);
    EXPECT_GT(glm::dot(p - corner, d), 0.0);
  }
}

}  // namespace
}  // namespace hybray::caustics
