#include "core/optics/fresnel.h"

#include "core/base/hash.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray::optics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint64_t kSeed = 20244;

TEST(Fresnel, NormalIncidenceIsTheSquareOfTheIndexContrast) {
  for (const double eta : {1.0, 1.1, 4.0 / 3.0, 1.5, 2.4, 1.0 / 1.5}) {
    const double r = (eta - 1.0) / (eta + 1.0);
    EXPECT_NEAR(fresnel_dielectric(1.0, eta), r * r, 1e-15) << eta;
  }
}

TEST(Fresnel, AtBrewstersAngleOnlyThePerpendicularPolarisationReflects) {
  for (const double eta : {4.0 / 3.0, 1.5, 2.4, 1.0 / 1.5}) {
    const double rs = (1.0 - eta * eta) / (1.0 + eta * eta);
    EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(eta)), eta), 0.5 * rs * rs, 1e-15) << eta;
  }
}

TEST(Fresnel, AgreesWithTheEquationsInAnglesAndGrowsToOneAtGrazingIncidence) {
  for (const double eta : {4.0 / 3.0, 1.5, 2.4}) {
    for (int degrees = 1; degrees < 90; ++degrees) {
      const double i = degrees * kPi / 180.0, t = std::asin(std::sin(i) / eta);
      const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
      EXPECT_NEAR(fresnel_dielectric(std::cos(i), eta), 0.5 * (s * s + p * p), 1e-13) << degrees;
    }
    EXPECT_EQ(fresnel_dielectric(0.0, eta), 1.0);
  }
}

TEST(Fresnel, IsTotalBeyondTheCriticalAngleAndOnlyThere) {
  const double eta = 1.0 / 1.5, critical = std::sqrt(1.0 - eta * eta);
  EXPECT_EQ(fresnel_dielectric(critical - 1e-9, eta), 1.0);
  EXPECT_LT(fresnel_dielectric(critical + 1e-9, eta), 1.0);
  EXPECT_EQ(fresnel_dielectric(0.0, eta), 1.0);
}

TEST(Fresnel, ReflectsTheSameShareFromBothSides) {
  for (uint64_t i = 0; i < 1000; ++i) {
    const double eta = 1.0 + 2.0 * random_unit(i, 0, 0, kSeed), cosine = random_unit(i, 1, 0, kSeed);
    const double beyond = std::sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    // Near the critical angle the reflectance depends on the root of the difference of two near numbers.
    EXPECT_NEAR(fresnel_dielectric(cosine, eta), fresnel_dielectric(beyond, 1.0 / eta),
                1e-14 / std::max(1e-3, cosine * cosine))
        << "eta " << eta << " cosine " << cosine << " seed " << kSeed;
  }
}

TEST(Fresnel, TakesACosineThatRoundingPushedOutOfItsRange) {
  for (const double eta : {1.0, 1.5, 1.0 / 1.5}) {
    EXPECT_EQ(fresnel_dielectric(1.0 + 1e-12, eta), fresnel_dielectric(1.0, eta));
    EXPECT_EQ(fresnel_dielectric(-1e-12, eta), fresnel_dielectric(0.0, eta));
    EXPECT_EQ(fresnel_conductor(1.0 + 1e-12, eta, 2.0), fresnel_conductor(1.0, eta, 2.0));
  }
  EXPECT_FALSE(std::isnan(fresnel_dielectric(0.0, 1.0)));
  EXPECT_FALSE(std::isnan(fresnel_conductor(0.0, 0.0, 0.0)));
}

TEST(Fresnel, AMetalWithoutAbsorptionIsADielectric) {
  for (const double eta : {1.2, 1.5, 2.4, 1.0 / 1.5})
    for (int i = 1; i <= 100; ++i)
      EXPECT_NEAR(fresnel_conductor(0.01 * i, eta, 0.0), fresnel_dielectric(0.01 * i, eta), 1e-12)
          << eta << " " << i;
}

TEST(Fresnel, AMetalFollowsTheEquationsInComplexNumbers) {
  for (uint64_t i = 0; i < 1000; ++i) {
    const std::complex<double> n(0.1 + 3.0 * random_unit(i, 0, 1, kSeed), 6.0 * random_unit(i, 1, 1, kSeed));
    const double c = random_unit(i, 2, 1, kSeed);
    const std::complex<double> beyond = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
    const double s = std::abs((c - n * beyond) / (c + n * beyond));
    const double p = std::abs((n * c - beyond) / (n * c + beyond));
    EXPECT_NEAR(fresnel_conductor(c, n.real(), n.imag()), 0.5 * (s * s + p * p), 1e-12)
        << n << " " << c << " seed " << kSeed;
  }
}

// Index of refraction and reflectance at normal incidence as the CRC Handbook lists them side by side
// ("Optical properties of selected elements"): gold and silver at 2.0 eV (620 nm).
TEST(Fresnel, GoldAndSilverReflectWhatTheirTablesSay) {
  EXPECT_NEAR(fresnel_conductor(1.0, 0.13, 3.16), 0.953, 0.002);  // gold
  EXPECT_NEAR(fresnel_conductor(1.0, 0.27, 4.18), 0.944, 0.003);  // silver
}

// Duntley's closed form (1942) of the external reflectance for diffuse light.
double duntley(double n) {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) +
         n2 * (n2 - 1.0) * (n2 - 1.0) / std::pow(n2 + 1.0, 3) * std::log((n - 1.0) / (n + 1.0)) -
         2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0)) +
         8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0) * (n4 - 1.0)) * std::log(n);
}

TEST(Fresnel, TheHemisphericalReflectanceIsTheCosineWeightedMean) {
  // As printed in tables for n = 1.5.
  EXPECT_NEAR(hemispherical_reflectance(1.5), 0.0918, 5e-5);
  EXPECT_NEAR(hemispherical_reflectance(1.0 / 1.5), 0.596, 5e-4);
  EXPECT_NEAR(hemispherical_reflectance(1.0), 0.0, 1e-12);
  for (const double eta : {1.2, 4.0 / 3.0, 1.5, 2.4}) {
    EXPECT_NEAR(hemispherical_reflectance(eta), duntley(eta), 1e-6) << eta;
    // What enters diffusely and what leaves diffusely are tied by the etendue, n^2.
    EXPECT_NEAR(hemispherical_reflectance(1.0 / eta), 1.0 - (1.0 - duntley(eta)) / (eta * eta), 1e-6) << eta;
    double sum = 0.0;
    constexpr int kN = 1000000;
    for (int i = 0; i < kN; ++i) {
      const double c = (i + 0.5) / kN;
      sum += 2.0 * c * fresnel_dielectric(c, eta) / kN;
    }
    EXPECT_NEAR(hemispherical_reflectance(eta), sum, 1e-6) << eta;
  }
}

TEST(Fresnel, AThinSheetSumsTheBouncesBetweenItsFaces) {
  for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
    const double r = fresnel_dielectric(cosine, 1.5);
    // Reflected at once, or let in, reflected an odd number of times inside, and let out.
    double sum = r;
    for (int k = 0; k < 2000; ++k) sum += (1.0 - r) * (1.0 - r) * std::pow(r, 2 * k + 1);
    EXPECT_NEAR(thin_sheet_reflectance(cosine, 1.5), sum, 1e-12) << cosine;
  }
  EXPECT_EQ(thin_sheet_reflectance(0.0, 1.5), 1.0);
}

dvec3 random_direction(uint64_t i, uint32_t first) {
  const double y = 2.0 * random_unit(i, first, 2, kSeed) - 1.0,
               phi = 2.0 * kPi * random_unit(i, first + 1, 2, kSeed);
  const double r = std::sqrt(1.0 - y * y);
  return {r * std::cos(phi), y, r * std::sin(phi)};
}

TEST(Refraction, ObeysSnellInThePlaneOfIncidenceAndIsReversible) {
  int total = 0;
  for (uint64_t i = 0; i < 5000; ++i) {
    dvec3 n = random_direction(i, 0);
    const dvec3 d = random_direction(i, 2);
    if (glm::dot(d, n) > 0.0) n = -n;
    const double eta = i % 2 ? 1.5 : 1.0 / 1.5;
    const double sine = glm::length(glm::cross(d, n));
    dvec3 out(9.0);
    if (!refracted(d, n, eta, out)) {
      EXPECT_GE(sine / eta, 1.0 - 1e-12);
      EXPECT_EQ(out, dvec3(9.0)) << "left alone";
      ++total;
      continue;
    }
    EXPECT_LT(sine / eta, 1.0 + 1e-12);
    EXPECT_NEAR(glm::length(out), 1.0, 1e-14);
    EXPECT_NEAR(eta * glm::length(glm::cross(out, n)), sine, 1e-13);
    EXPECT_LT(glm::dot(out, n), 0.0) << "goes on to the other side";
    EXPECT_NEAR(glm::dot(out, glm::cross(d, n)), 0.0, 1e-14) << "stays in the plane of incidence";
    dvec3 back;
    ASSERT_TRUE(refracted(-out, -n, 1.0 / eta, back));
    // Near grazing incidence the cosine is the root of a small difference, whose rounding it divides by.
    const double grazing = std::min(std::abs(glm::dot(d, n)), std::abs(glm::dot(out, n)));
    EXPECT_LT(glm::length(back + d), 1e-14 / grazing) << i;
  }
  EXPECT_GT(total, 500);
}

TEST(Refraction, GrazingLightEntersAtTheCriticalAngleAndNothingIsNan) {
  const dvec3 n(0, 1, 0);
  dvec3 out;
  ASSERT_TRUE(refracted({1, 0, 0}, n, 1.5, out));
  EXPECT_NEAR(out.x, 1.0 / 1.5, 1e-15);
  // A direction a little longer than unit makes the cosine exceed 1.
  ASSERT_TRUE(refracted({0, -1.0 - 1e-12, 0}, n, 1.0 / 1.5, out));
  EXPECT_NEAR(out.y, -1.0, 1e-12);
  ASSERT_TRUE(refracted({0, -1.0 - 1e-12, 0}, n, 1.5, out));
  EXPECT_NEAR(glm::length(out), 1.0, 1e-14);
  EXPECT_FALSE(refracted({1, 0, 0}, n, 1.0 / 1.5, out));
}

TEST(Refraction, WithoutAnInterfaceLightGoesStraightOn) {
  for (uint64_t i = 0; i < 100; ++i) {
    dvec3 n = random_direction(i, 0), out;
    const dvec3 d = random_direction(i, 2);
    if (glm::dot(d, n) > 0.0) n = -n;
    ASSERT_TRUE(refracted(d, n, 1.0, out));
    EXPECT_LT(glm::length(out - d), 1e-12);
  }
}

TEST(Reflection, MirrorsTheNormalComponentFromEitherSide) {
  for (uint64_t i = 0; i < 100; ++i) {
    const dvec3 n = random_direction(i, 0), d = random_direction(i, 2);
    const dvec3 r = reflected(d, n);
    EXPECT_NEAR(glm::dot(r, n), -glm::dot(d, n), 1e-15);
    EXPECT_LT(glm::length(glm::cross(r - d, n)), 1e-15);
    EXPECT_LT(glm::length(reflected(d, -n) - r), 1e-15);
  }
}

}  // namespace
}  // namespace hybray::optics
