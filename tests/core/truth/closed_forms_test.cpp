#include "core/truth/closed_forms.h"

#include "core/scene/procedural/closed_form_scenes.h"
#include "core/tracer/tracer.h"
#include "tests/core/truth/brute_force_caustic.h"

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

using namespace procedural;
constexpr double kPi = std::numbers::pi;
constexpr uint64_t kSeed = 20241;
constexpr int kMany = 1000;

ClosedForm form_of(const std::string& name, int max_events) {
  return closed_form(test::closed_form_scene(name), max_events).value();
}

// Toward all that can matter, generously.
test::Emission emission_for(const std::string& scene) {
  if (scene == "closed_ball_lens") return {.half_angle = 0.23};
  if (scene == "closed_furnace") return {.axis = glm::normalize(dvec3(-1)), .half_angle = 0.3};
  if (scene == "closed_glass_slab" || scene == "closed_flat_water") return {.half_angle = 1.1};
  if (scene == "closed_plane_mirror") return {.axis = {1, 0, 0}, .half_angle = 0.5 * kPi};
  if (scene == "closed_paraboloid") return {.axis = {0, 1, 0}, .half_angle = 0.5 * kPi};
  if (scene == "closed_cardioid") return {.axis = glm::normalize(dvec3(1, -0.6, 0)), .half_angle = 1.15};
  if (scene == "closed_cylinder") return {.center = {0, 0.4, 0}, .disc_radius = 1.2};
  if (scene == "closed_prism") return {.center = {0, Prism::center_height, 0}, .disc_radius = 1.7};
  if (scene == "closed_tir_prism") return {.center = {0, 1.5, 0}, .disc_radius = 1.2};
  return {};
}

class ClosedFormScene : public testing::TestWithParam<const char*> {};

TEST_P(ClosedFormScene, AgreesWithBruteForceLightTransport) {
  const Scene scene = test::closed_form_scene(GetParam());
  for (const int max_events : {3, 4, 40}) {
    const ClosedForm form = closed_form(scene, max_events).value();
    const test::BruteForce brute_force(scene, form, emission_for(GetParam()), max_events);
    const auto estimates = brute_force.run(300000, kSeed + static_cast<uint64_t>(max_events));
    for (size_t r = 0; r < form.regions.size(); ++r) {
      ASSERT_GT(estimates[r].irradiance, 0.0) << form.regions[r].name;
      // 4.5 standard errors: about 130 comparisons, each of which may fail with 7e-6. Where all paths land,
      // the error is that of the scene's float coordinates.
      EXPECT_NEAR(form.regions[r].irradiance, estimates[r].irradiance,
                  4.5 * estimates[r].standard_error + 1e-6 * estimates[r].irradiance)
          << form.regions[r].name << ", at most " << max_events << " events; seed " << kSeed;
      EXPECT_LE(estimates[r].standard_error, 0.1 * estimates[r].irradiance) << form.regions[r].name;
    }
  }
}

TEST_P(ClosedFormScene, StatesAQuadratureErrorThatDoesNotMatter) {
  for (const int max_events : {3, kMany})
    for (const Region& region : form_of(GetParam(), max_events).regions) {
      EXPECT_GT(region.irradiance, 0.0) << region.name;
      EXPECT_LE(region.quadrature_error, 1e-4 * region.irradiance) << region.name;
    }
}

TEST_P(ClosedFormScene, HasNoTruthForFewerEventsThanTheLightNeeds) {
  const Scene scene = test::closed_form_scene(GetParam());
  const int needed = form_of(GetParam(), kMany).specular_events_needed;
  EXPECT_TRUE(closed_form(scene, needed).has_value());
  EXPECT_FALSE(closed_form(scene, needed - 1).has_value());
}

TEST_P(ClosedFormScene, IsKnownByItsContentsWhateverItsNameAndCameras) {
  Scene scene = test::closed_form_scene(GetParam());
  scene.name = "renamed";
  scene.cameras.push_back({});
  update_content_hash(scene);
  EXPECT_TRUE(closed_form(scene, kMany).has_value());
  scene.lights[0].intensity *= 2.0f;
  update_content_hash(scene);
  EXPECT_FALSE(closed_form(scene, kMany).has_value());
}

TEST_P(ClosedFormScene, ShowsAllOfItsRegionsToItsCamera) {
  if (std::string(GetParam()) == "closed_furnace") return;  // no camera sees all walls of a room
  const Scene scene = test::closed_form_scene(GetParam());
  const Tracer tracer(scene, {.robust = true});
  const ClosedForm form = form_of(GetParam(), 3);
  const dvec3 eye(scene.cameras.at(0).eye);
  const double half_fov = 0.5 * scene.cameras[0].vertical_fov * kPi / 180.0;
  const dvec3 axis = glm::normalize(dvec3(scene.cameras[0].target) - eye);
  for (const Region& region : form.regions) {
    if (region.name.find("whole") != std::string::npos || region.name.find("around") != std::string::npos)
      continue;  // regions that only serve to count all light
    int inside = 0, seen = 0;
    for (int i = 0; i < 40000; ++i) {
      const double a = 3.5 * (2.0 * random_unit(i, 0, 0, kSeed) - 1.0), b = 3.5 * random_unit(i, 1, 0, kSeed);
      const double sign = i % 2 ? 1.0 : -1.0;
      const dvec3 p =
          scene.name == "closed_tir_prism" ? dvec3(TirPrism::wall_x, b, a) : dvec3(a, 0, sign * b);
      if (!region.contains(p)) continue;
      ++inside;
      const dvec3 to = p - eye;
      const bool in_view = glm::dot(glm::normalize(to), axis) > std::cos(half_fov);
      seen += in_view && !tracer.occluded(vec3(eye), vec3(glm::normalize(to)), 0.0f,
                                          static_cast<float>(0.9999 * glm::length(to)));
    }
    EXPECT_GT(inside, 10) << region.name;
    EXPECT_EQ(seen, inside) << region.name;
  }
}

TEST_P(ClosedFormScene, HasOneFormAndRefusesAnyOtherNumberOfTriangles) {
  for (const Generator& generator : closed_form_generators()) {
    if (generator.name != std::string(GetParam())) continue;
    EXPECT_EQ(generator.generate({}).triangle_count(), generator.default_triangles);
    EXPECT_NO_THROW(generator.generate({generator.default_triangles, 7}));
    EXPECT_THROW(generator.generate({generator.default_triangles + 1, 1}), InputError);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ClosedFormScene,
                         testing::Values("closed_ball_lens", "closed_cardioid", "closed_cylinder",
                                         "closed_flat_water", "closed_furnace", "closed_glass_slab",
                                         "closed_paraboloid", "closed_plane_mirror", "closed_prism",
                                         "closed_tir_prism"),
                         [](const auto& test) { return std::string(test.param); });

// Scenes of other numbers than the generators'.
struct Variant {
  Scene scene;
  ClosedForm form;
  test::Emission emission;
};

template <class Case>
Variant variant_of(const Case& c, int max_events, const test::Emission& emission) {
  return {closed_form_scene(c), closed_form(c, max_events).value(), emission};
}

TEST(ClosedFormVariants, AgreeWithBruteForceLightTransport) {
  constexpr int kEvents = 12;
  std::vector<Variant> variants;
  for (const double ior : {1.0001, 1.1, 2.0, 4.0}) {
    variants.push_back(variant_of(BallLens{.ior = ior}, kEvents, {.half_angle = 0.23}));
    variants.push_back(variant_of(GlassSlab{.ior = ior}, kEvents, {.half_angle = 1.1}));
    variants.push_back(variant_of(FlatWater{.ior = ior}, kEvents, {.half_angle = 1.1}));
    variants.push_back(
        variant_of(Furnace{.ior = ior}, kEvents, {.axis = glm::normalize(dvec3(-1)), .half_angle = 0.3}));
  }
  variants.push_back(variant_of(GlassSlab{.thickness = 1e-3, .ior = 2.0}, kEvents, {.half_angle = 1.1}));
  for (const double degrees : {0.0, 45.0, 80.0}) {
    const GrazedReceiver c{.incidence = degrees * kPi / 180.0};
    variants.push_back(variant_of(c, kEvents, {.disc_radius = 1.1 * (1.0 + c.half_length())}));
  }
  for (const Variant& v : variants) {
    const auto estimates = test::BruteForce(v.scene, v.form, v.emission, kEvents).run(200000, kSeed);
    for (size_t r = 0; r < v.form.regions.size(); ++r) {
      const Region& region = v.form.regions[r];
      // 4.5 standard errors: about 70 comparisons. A ring that light hardly reaches has no error that means
      // anything: the ball of index 2 throws next to nothing there.
      if (region.irradiance * 1e3 < v.form.regions[0].irradiance) continue;
      EXPECT_NEAR(region.irradiance, estimates[r].irradiance,
                  4.5 * estimates[r].standard_error + 1e-5 * estimates[r].irradiance)
          << v.form.scene << ", " << region.name << ", index " << v.scene.materials.back().ior;
    }
  }
}

TEST(ClosedFormVariants, WithTheNumbersOfTheGeneratorsAreTheGeneratorsScenes) {
  EXPECT_EQ(closed_form_scene(BallLens{}).content_hash,
            test::closed_form_scene("closed_ball_lens").content_hash);
  EXPECT_EQ(closed_form_scene(GlassSlab{}).content_hash,
            test::closed_form_scene("closed_glass_slab").content_hash);
  EXPECT_EQ(closed_form_scene(FlatWater{}).content_hash,
            test::closed_form_scene("closed_flat_water").content_hash);
  EXPECT_EQ(closed_form_scene(Furnace{}).content_hash,
            test::closed_form_scene("closed_furnace").content_hash);
}

TEST(ClosedFormVariants, AThinSlabLetsThroughWhatIncoherentReflectionsAddUpTo) {
  // Without absorption and thickness: (1 - F) / (1 + F) of the light in a cone, at the angles themselves.
  const GlassSlab c{.thickness = 1e-9, .absorption = 0.0, .ior = 1.8};
  const ClosedForm form = closed_form(c, kMany).value();
  for (const Region& region : form.regions) {
    const size_t r = static_cast<size_t>(&region - form.regions.data());
    const double a0 = std::atan(0.5 * static_cast<double>(r) / c.light_height),
                 a1 = std::atan(0.5 * static_cast<double>(r + 1) / c.light_height);
    constexpr int kSteps = 20000;
    double flux = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double a = a0 + (a1 - a0) * (i + 0.5) / kSteps, b = std::asin(std::sin(a) / c.ior);
      const double rs = (std::cos(a) - c.ior * std::cos(b)) / (std::cos(a) + c.ior * std::cos(b));
      const double rp = (c.ior * std::cos(a) - std::cos(b)) / (c.ior * std::cos(a) + std::cos(b));
      // Each polarisation would have its own series; unpolarised light is taken as such at every face.
      const double f = 0.5 * (rs * rs + rp * rp);
      flux += kClosedFormIntensity * 2.0 * kPi * std::sin(a) * (a1 - a0) / kSteps * (1.0 - f) / (1.0 + f);
    }
    EXPECT_NEAR(region.area * region.irradiance, flux, 1e-6 * flux) << region.name;
  }
}

TEST(ClosedFormVariants, TheSunlitPoolHasTheCosineAndWhatFresnelLetsIn) {
  for (const double degrees : {0.0, 30.0, 60.0, 89.0, 89.99}) {
    const double i = degrees * kPi / 180.0, n = 1.333, t = std::asin(std::sin(i) / n);
    const double rs = (std::cos(i) - n * std::cos(t)) / (std::cos(i) + n * std::cos(t));
    const double rp = (n * std::cos(i) - std::cos(t)) / (n * std::cos(i) + std::cos(t));
    const double expected = kClosedFormIrradiance * std::cos(i) * (1.0 - 0.5 * (rs * rs + rp * rp));
    EXPECT_NEAR(closed_form(SunlitPool{.incidence = i}, 1)->regions.at(0).irradiance, expected,
                1e-9 * expected)
        << degrees;
  }
}

TEST(ClosedFormVariants, AllOfTheMirroredBeamFallsOnTheGrazedReceiver) {
  for (const double degrees : {0.0, 45.0, 89.9, 89.9999}) {
    const GrazedReceiver c{.incidence = degrees * kPi / 180.0};
    const ClosedForm form = closed_form(c, 1).value();
    // One metre high, as wide as the mirror is long.
    const double beam = kClosedFormIrradiance * kMirrorReflectance * 1.0 * 2.0 * c.half_length();
    EXPECT_NEAR(form.regions.at(1).area * form.regions[1].irradiance, beam, 1e-9 * beam);
    EXPECT_NEAR(form.regions[0].irradiance,
                kClosedFormIrradiance * kMirrorReflectance * std::cos(c.incidence),
                1e-9 * form.regions[0].irradiance);
    EXPECT_NEAR(glm::dot(c.normal(), c.along()), 0.0, 1e-15);
    EXPECT_TRUE(form.regions[0].contains(c.center() + 0.49 * c.half_length() * c.along()));
    EXPECT_FALSE(form.regions[0].contains(c.center() + 0.51 * c.half_length() * c.along()));
  }
}

// Published with the definition of this scene, to these digits.
TEST(ClosedForms, TheBallLensHasTheKnownRingAverages) {
  const ClosedForm form = form_of("closed_ball_lens", 2);
  const double known[] = {183.67, 61.59, 3.239, 1.515, 0.430}, half_digit[] = {5e-3, 5e-3, 5e-4, 5e-4, 5e-4};
  ASSERT_EQ(form.regions.size(), 5u);
  for (size_t r = 0; r < 5; ++r) {
    EXPECT_NEAR(form.regions[r].irradiance, known[r], half_digit[r]) << form.regions[r].name;
    EXPECT_LT(form.regions[r].quadrature_error, half_digit[r]);
  }
}

TEST(ClosedForms, NoOtherPathOfTwoEventsReachesTheRingsUnderTheBall) {
  // The rim rays pass at tan(asin(1 / 4.5)) * 6 = 1.37 m; reflection at the outside turns rays outward.
  const Scene scene = test::closed_form_scene("closed_ball_lens");
  const ClosedForm form = closed_form(scene, 2).value();
  for (const test::Estimate& e :
       test::BruteForce(scene, form, emission_for(scene.name), 1).run(200000, kSeed))
    EXPECT_EQ(e.irradiance, 0.0);
}

TEST(ClosedForms, TheMiddleOfThePrismsBeamFollowsFromTheDeviationFormula) {
  const double n = kGlassIor, apex = kPi / 3.0, i1 = kPi / 4.0;
  const double t1 = std::asin(std::sin(i1) / n), t2 = apex - t1, i2 = std::asin(n * std::sin(t2));
  const double deviation = i1 + std::asin(n * std::sin(apex - std::asin(std::sin(i1) / n))) - apex;
  const double down = deviation - 15.0 * kPi / 180.0;  // from the vertical; the light comes in at 15 degrees
  const auto transmitted = [](double i, double t) {
    const double s = std::sin(2 * i) * std::sin(2 * t) / std::pow(std::sin(i + t), 2);
    return 0.5 * (s + s / std::pow(std::cos(i - t), 2));
  };
  const double narrowing = std::cos(i1) / std::cos(t1) * std::cos(t2) / std::cos(i2);
  const double expected =
      kClosedFormIrradiance * transmitted(i1, t1) * transmitted(t2, i2) * narrowing * std::cos(down);
  EXPECT_NEAR(form_of("closed_prism", 2).regions[0].irradiance, expected, 1e-9 * expected);
}

TEST(ClosedForms, TheTurnedBeamLosesOnlyTwoReflectionsAtNormalIncidence) {
  const double r0 = std::pow((kGlassIor - 1.0) / (kGlassIor + 1.0), 2);
  const double once = kClosedFormIrradiance * (1.0 - r0) * (1.0 - r0);
  EXPECT_NEAR(form_of("closed_tir_prism", 3).regions[0].irradiance, once, 1e-9 * once);
  // Reflected at both legs in turn, the light comes back with r0^2 each time.
  EXPECT_NEAR(form_of("closed_tir_prism", kMany).regions[0].irradiance, once / (1.0 - r0 * r0), 1e-9 * once);
}

TEST(ClosedForms, TheFurnaceReceivesAllThatTheBallDoes) {
  const double cosine = std::sqrt(1.0 - 1.0 / 12.0), area = 6.0 * 36.0;
  const double all = kClosedFormIntensity * 2.0 * kPi * (1.0 - cosine) / area;
  // At grazing incidence light stays inside for any number of events: (1 - F) F^999 of it, at most 1e-3
  // there.
  EXPECT_NEAR(form_of("closed_furnace", kMany).regions[0].irradiance, all, 1e-5 * all);
  EXPECT_LT(form_of("closed_furnace", 2).regions[0].irradiance, all);
}

TEST(ClosedForms, TheMirrorImageOfTheLampLightsTheFloor) {
  const Region region = form_of("closed_plane_mirror", 1).regions[1];  // x from -1 to 0, z from -0.5 to 0.5
  double sum = 0.0;
  constexpr int kN = 400;
  for (int i = 0; i < kN; ++i)
    for (int j = 0; j < kN; ++j) {
      const double x = -1.0 + (i + 0.5) / kN, z = -0.5 + (j + 0.5) / kN;
      const double d2 = (x - 4.0) * (x - 4.0) + 4.0 + z * z;
      sum += kClosedFormIntensity * kMirrorReflectance * 2.0 / (d2 * std::sqrt(d2));
    }
  EXPECT_NEAR(region.irradiance, sum / (kN * kN), 1e-6 * region.irradiance);
}

TEST(ClosedForms, TheParaboloidsBeamHasTheKnownProfile) {
  const ClosedForm form = form_of("closed_paraboloid", 1);
  const double f = ParaboloidMirror::focal_length;
  const auto mean = [&](double a, double b) {
    double sum = 0.0;
    constexpr int kN = 20000;
    for (int i = 0; i < kN; ++i) {
      const double rho = a + (b - a) * (i + 0.5) / kN, q = rho * rho / (4.0 * f * f);
      sum += kClosedFormIntensity * kMirrorReflectance / std::pow(f * (1.0 + q), 2) * 2.0 * rho / kN;
    }
    return sum * (b - a) / (b * b - a * a);
  };
  EXPECT_NEAR(form.regions[0].irradiance, mean(0.0, 0.25), 1e-7 * form.regions[0].irradiance);
  EXPECT_NEAR(form.regions[3].irradiance, mean(0.75, 0.95), 1e-7 * form.regions[3].irradiance);
  // Up to the rim, which is as high as the focus: the upper half space.
  EXPECT_NEAR(form.regions[4].irradiance * form.regions[4].area,
              2.0 * kPi * kClosedFormIntensity * kMirrorReflectance, 1e-9);
}

}  // namespace
}  // namespace hybray::truth
