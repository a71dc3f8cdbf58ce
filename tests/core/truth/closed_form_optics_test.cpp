#include "core/truth/closed_form_optics.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace hybray::truth {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(ClosedFormOptics, HasTheTextbookReflectances) {
  EXPECT_NEAR(unpolarised_reflectance(0.0, 1.5), 0.04, 1e-12);
  EXPECT_NEAR(unpolarised_reflectance(1e-3, 1.5), 0.04, 1e-6);  // flat at the normal
  // At Brewster's angle R_p vanishes and R_s is ((n^2 - 1) / (n^2 + 1))^2.
  EXPECT_NEAR(unpolarised_reflectance(std::atan(1.5), 1.5), 0.5 * std::pow(1.25 / 3.25, 2), 1e-12);
  EXPECT_NEAR(unpolarised_reflectance(90.0 * kDegree, 1.5), 1.0, 1e-12);
  EXPECT_EQ(unpolarised_reflectance(60.0 * kDegree, 1.0 / 1.5), 1.0);
}

TEST(ClosedFormOptics, IsTheSameFromBothSidesAndNothingWithoutAnInterface) {
  for (int degrees = 1; degrees < 90; ++degrees) {
    const double i = degrees * kDegree, t = refraction_angle(i, 1.5);
    EXPECT_NEAR(unpolarised_reflectance(i, 1.5), unpolarised_reflectance(t, 1.0 / 1.5), 1e-10) << degrees;
    EXPECT_NEAR(unpolarised_reflectance(i, 1.0), 0.0, 1e-12) << degrees;
    EXPECT_NEAR(1.5 * std::sin(t), std::sin(i), 1e-15);
  }
}

}  // namespace
}  // namespace hybray::truth
