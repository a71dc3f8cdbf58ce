#include "core/optics/surface_optics.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/optics/fresnel.h"
#include "tests/core/test_scenes.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray::optics {
namespace {

constexpr uint64_t kSeed = 20245;

// A scene whose only surface has that material.
Scene scene_of(const Material& material) {
  Scene scene = test::empty_scene();
  scene.materials[0] = material;
  test::add_rectangle(scene, vec3(0), vec3(1, 0, 0), vec3(0, 0, -1));
  return scene;
}
SurfaceOptics optics_of(const Material& material) {
  return make_optics(scene_of(material)).materials[0];
}

Material random_material(uint64_t i) {
  uint32_t next = 0;
  const auto random = [&] { return static_cast<float>(random_unit(i, next++, 0, kSeed)); };
  Material m{.name = "random", .base_color = vec3(random(), random(), random())};
  m.roughness = i % 4 == 0 ? 0.5f : 0.0f;
  m.metallic = i % 3 == 0 ? 0.0f : random();
  m.transmission = i % 5 == 0 ? 0.0f : random();
  m.ior = 1.0f + 1.5f * random();
  m.outer_ior = 1.0f + 0.5f * random();
  m.thin_walled = i % 7 == 0;
  if (i % 2) m.conductor_eta = vec3(0.1f) + vec3(random(), random(), random());
  if (i % 2) m.conductor_k = 4.0f * vec3(random(), random(), random());
  return m;
}

TEST(SurfaceOptics, NoMaterialGivesOutMoreThanItReceives) {
  for (uint64_t i = 0; i < 500; ++i) {
    const SurfaceOptics s = optics_of(random_material(i));
    for (const double cosine : {0.0, 0.01, 0.2, 0.5, 0.9, 1.0})
      for (const bool inner : {false, true}) {
        const SpecularSplit r = split(s, cosine, inner);
        for (int c = 0; c < 3; ++c) {
          EXPECT_GE(r.reflectance[c], 0.0);
          EXPECT_GE(r.transmittance[c], 0.0);
          EXPECT_LE(r.reflectance[c] + r.transmittance[c] + r.base_entry, 1.0 + 1e-12) << i;
        }
        EXPECT_GE(r.base_entry, 0.0);
      }
  }
}

// Reflectance of the diffuse part for light under `cosine`: integral of the BRDF times the cosine.
double diffuse_albedo(const SurfaceOptics& s, double cosine) {
  constexpr int kN = 20000;
  double sum = 0.0;
  for (int i = 0; i < kN; ++i) {
    const double c = (i + 0.5) / kN;
    sum += diffuse_brdf(s, cosine, c).x * c;
  }
  return 2.0 * std::numbers::pi * sum / kN;
}

TEST(SurfaceOptics, AWhiteBaseUnderAnInterfaceLosesNothing) {
  for (const float ior : {1.0f, 1.3f, 1.5f, 2.0f}) {
    const SurfaceOptics s =
        optics_of({.name = "white", .base_color = vec3(1), .roughness = 0.0f, .ior = ior});
    for (const double cosine : {0.05, 0.3, 0.6, 1.0}) {
      const double back = split(s, cosine, false).reflectance.x + diffuse_albedo(s, cosine);
      EXPECT_NEAR(back, 1.0, 1e-5) << "ior " << ior << " cosine " << cosine;
    }
  }
}

TEST(SurfaceOptics, WhatEntersTheBaseIsWhatTheBaseOfThatColourGivesBackOrKeeps) {
  const SurfaceOptics s =
      optics_of({.name = "red", .base_color = vec3(0.6f), .roughness = 0.0f, .ior = 1.5f});
  const double inside = hemispherical_reflectance(1.0 / 1.5), entered = split(s, 0.7, false).base_entry;
  // Reflected at the base, turned back by the interface, and so on: a geometric series.
  double out = 0.0, down = entered;
  for (int k = 0; k < 200; ++k) out += down * 0.6 * (1.0 - inside), down *= 0.6 * inside;
  EXPECT_NEAR(diffuse_albedo(s, 0.7), out, 2e-5);
}

TEST(SurfaceOptics, TheDiffusePartIsReciprocal) {
  for (uint64_t i = 0; i < 200; ++i) {
    const SurfaceOptics s = optics_of(random_material(i));
    const double a = random_unit(i, 50, 0, kSeed), b = random_unit(i, 51, 0, kSeed);
    EXPECT_LT(glm::length(diffuse_brdf(s, a, b) - diffuse_brdf(s, b, a)), 1e-15) << i;
  }
}

TEST(SurfaceOptics, ARoughSurfaceIsLambertian) {
  const SurfaceOptics s = optics_of({.name = "plaster", .base_color = vec3(0.5f), .roughness = 1.0f});
  EXPECT_FALSE(s.specular);
  EXPECT_TRUE(s.diffuse);
  EXPECT_NEAR(diffuse_brdf(s, 0.2, 0.9).x, 0.5 / std::numbers::pi, 1e-15);
  EXPECT_EQ(split(s, 0.3, false).base_entry, 1.0);
  EXPECT_EQ(split(s, 0.3, false).reflectance, dvec3(0.0));
}

TEST(SurfaceOptics, GlassSplitsByFresnelFromItsTwoSides) {
  const SurfaceOptics s = optics_of(
      {.name = "glass", .base_color = vec3(1), .roughness = 0.0f, .transmission = 1.0f, .ior = 1.5f});
  EXPECT_TRUE(s.specular && s.interface && !s.diffuse);
  const SpecularSplit outside = split(s, 0.6, false), inside = split(s, 0.6, true);
  EXPECT_NEAR(outside.reflectance.x, fresnel_dielectric(0.6, 1.5), 1e-15);
  EXPECT_EQ(inside.reflectance.x, 1.0) << "53 degrees is beyond the critical angle of 42";
  EXPECT_NEAR(outside.transmittance.x, 1.0 - outside.reflectance.x, 1e-15);
  EXPECT_EQ(outside.base_entry, 0.0);
}

TEST(SurfaceOptics, AThinSheetIsNoBorderBetweenMedia) {
  Material m{
      .name = "pane", .base_color = vec3(1), .roughness = 0.0f, .transmission = 1.0f, .thin_walled = true};
  const SurfaceOptics s = optics_of(m);
  EXPECT_TRUE(s.specular);
  EXPECT_FALSE(s.interface);
  EXPECT_EQ(split(s, 0.4, false).reflectance, split(s, 0.4, true).reflectance);
  EXPECT_NEAR(split(s, 0.4, false).reflectance.x, thin_sheet_reflectance(0.4, 1.5), 1e-15);
}

TEST(SurfaceOptics, AMetalUnderWaterIsSeenThroughTheWatersIndex) {
  Material gold{.name = "gold", .metallic = 1.0f, .roughness = 0.0f};
  gold.conductor_eta = vec3(0.13f), gold.conductor_k = vec3(3.16f), gold.outer_ior = 1.5f;
  const std::complex<double> n(0.13, 3.16);
  EXPECT_NEAR(split(optics_of(gold), 1.0, false).reflectance.x, std::norm((n - 1.5) / (n + 1.5)), 1e-6);
}

TEST(SurfaceOptics, TheTableKnowsWhatTheSceneReallyHas) {
  const Material glass{.name = "glass", .base_color = vec3(1), .roughness = 0.0f, .transmission = 1.0f};
  EXPECT_TRUE(make_optics(scene_of(glass)).any_interface);
  Scene scene = scene_of({});
  scene.materials.push_back(glass);
  EXPECT_FALSE(make_optics(scene).any_specular) << "no surface has the glass";
  append_analytic(scene, analytic_sphere("ball", 1, dvec3(0), 1.0));
  EXPECT_TRUE(make_optics(scene).any_specular);
  EXPECT_TRUE(make_optics(scene).any_interface);
}

TEST(SurfaceOptics, EqualMediaAreOneMedium) {
  Material water{
      .name = "water", .base_color = vec3(1), .roughness = 0.0f, .transmission = 1.0f, .ior = 1.33f};
  Scene scene = scene_of(water);
  water.name = "more water";
  scene.materials.push_back(water);
  const OpticsTable table = make_optics(scene);
  EXPECT_EQ(table.media.size(), 2u) << "vacuum and water";
  EXPECT_EQ(table.materials[0].inner_medium, table.materials[1].inner_medium);
  EXPECT_EQ(table.materials[0].outer_medium, 0u);
}

TEST(SurfaceOptics, ImpossibleMaterialsAreErrorsThatNameMaterialAndProperty) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const auto refuse = [](const char* property, auto&& change) {
    Material m{.name = "odd one"};
    change(m);
    try {
      make_optics(scene_of(m));
      FAIL() << "accepted a wrong " << property;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("odd one"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(property), std::string::npos) << error.what();
    }
  };
  for (const float bad : {0.99f, 0.0f, -1.5f, nan, infinity}) {
    refuse("ior", [&](Material& m) { m.ior = bad; });
    refuse("outer_ior", [&](Material& m) { m.outer_ior = bad; });
  }
  for (const float bad : {-0.1f, nan, infinity}) {
    refuse("absorption", [&](Material& m) { m.absorption.y = bad; });
    refuse("outer_absorption", [&](Material& m) { m.outer_absorption.z = bad; });
    refuse("conductor_eta", [&](Material& m) { m.conductor_eta.x = bad; });
    refuse("conductor_k", [&](Material& m) { m.conductor_k.x = bad; });
  }
  for (const float bad : {-0.1f, 1.1f, nan}) {
    refuse("base_color", [&](Material& m) { m.base_color.z = bad; });
    refuse("metallic", [&](Material& m) { m.metallic = bad; });
    refuse("roughness", [&](Material& m) { m.roughness = bad; });
    refuse("transmission", [&](Material& m) { m.transmission = bad; });
  }
}

}  // namespace
}  // namespace hybray::optics
