#include "core/optics/ggx.h"

#include "core/base/hash.h"

#include <array>
#include <cmath>
#include <numbers>

#include <boost/math/distributions/chi_squared.hpp>
#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr double kPi = std::numbers::pi;

dvec3 direction(double cosine, double phi) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// Sum of f over the hemisphere, midpoint rule in (cosine, phi).
template <class F>
double over_hemisphere(const F& f, double cos0 = 0.0, double cos1 = 1.0, double phi0 = 0.0,
                       double phi1 = 2.0 * kPi, int n = 800) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += f(direction(cos0 + (cos1 - cos0) * (i + 0.5) / n, phi0 + (phi1 - phi0) * (j + 0.5) / n));
  return sum * (cos1 - cos0) * (phi1 - phi0) / (static_cast<double>(n) * n);
}

TEST(Ggx, DensityProjectsToOneAndVisibleNormalsIntegrateToOne) {
  for (double alpha : {0.2, 0.5, 1.0}) {
    EXPECT_NEAR(over_hemisphere([&](const dvec3& h) { return ggx_density(h, alpha) * h.z; }), 1.0, 2e-3);
    for (double cosine : {0.95, 0.5, 0.15}) {
      const dvec3 v = direction(cosine, 0.7);
      EXPECT_NEAR(over_hemisphere([&](const dvec3& h) { return visible_normal_pdf(h, v, alpha); }), 1.0, 2e-3)
          << alpha << ' ' << cosine;
    }
  }
}

// Chi-square over 8 x 16 cells of (cosine, phi), expected counts from the density alone.
TEST(Ggx, NormalsAreDrawnWithTheDensityOfVisibleNormals) {
  constexpr int kRows = 8, kColumns = 16, kSamples = 40'000;
  constexpr uint64_t kSeed = 20240517;
  RecordProperty("seed", static_cast<int>(kSeed));
  for (double alpha : {0.25, 0.7}) {
    for (double cosine : {0.9, 0.3}) {
      const dvec3 v = direction(cosine, 0.7);
      std::array<double, kRows * kColumns> observed{};
      for (uint32_t i = 0; i < kSamples; ++i) {
        const dvec3 h =
            sample_visible_normal(v, alpha, random_unit(i, 0, 0, kSeed), random_unit(i, 1, 0, kSeed));
        EXPECT_NEAR(glm::dot(h, h), 1.0, 1e-12);
        const double phi = std::atan2(h.y, h.x) + (h.y < 0.0 ? 2.0 * kPi : 0.0);
        const int row = std::min(kRows - 1, static_cast<int>(h.z * kRows)),
                  column = std::min(kColumns - 1, static_cast<int>(phi / (2.0 * kPi) * kColumns));
        ++observed[static_cast<size_t>(row * kColumns + column)];
      }
      double statistic = 0.0, rest_observed = 0.0, rest_expected = 0.0;
      int cells = 0;
      for (int r = 0; r < kRows; ++r) {
        for (int c = 0; c < kColumns; ++c) {
          const double share = over_hemisphere(
              [&](const dvec3& h) { return visible_normal_pdf(h, v, alpha); }, static_cast<double>(r) / kRows,
              (r + 1.0) / kRows, 2.0 * kPi * c / kColumns, 2.0 * kPi * (c + 1.0) / kColumns, 40);
          const double expected = kSamples * share, seen = observed[static_cast<size_t>(r * kColumns + c)];
          if (expected < 8.0) {
            rest_expected += expected, rest_observed += seen;
            continue;
          }
          statistic += (seen - expected) * (seen - expected) / expected;
          ++cells;
        }
      }
      if (rest_expected > 8.0) {
        statistic += (rest_observed - rest_expected) * (rest_observed - rest_expected) / rest_expected;
        ++cells;
      }
      const boost::math::chi_squared distribution(cells - 1);
      EXPECT_LT(statistic, boost::math::quantile(distribution, 1.0 - 1e-5))
          << "alpha " << alpha << ", cosine " << cosine << ", seed " << kSeed << ", cells " << cells;
    }
  }
}

TEST(Ggx, ASmoothSurfaceHasOneNormal) {
  for (double cosine : {1.0, 0.5, 0.01}) {
    for (uint32_t i = 0; i < 100; ++i) {
      const dvec3 h =
          sample_visible_normal(direction(cosine, 2.0), 0.0, random_unit(i, 0), random_unit(i, 1));
      EXPECT_EQ(h.x, 0.0);
      EXPECT_EQ(h.y, 0.0);
      EXPECT_NEAR(h.z, 1.0, 0x1p-52);  // the length is divided out
    }
  }
}

TEST(Ggx, CosineDirectionsHaveTheMomentsOfTheirDensity) {
  // E[z] = 2/3 with variance 1/18; E[x] = E[y] = 0 with variance 1/4.
  constexpr int kSamples = 100'000;
  constexpr uint64_t kSeed = 77;
  dvec3 sum(0.0);
  for (uint32_t i = 0; i < kSamples; ++i)
    sum += sample_cosine_hemisphere(random_unit(i, 0, 0, kSeed), random_unit(i, 1, 0, kSeed));
  const dvec3 mean = sum / static_cast<double>(kSamples);
  const double root = std::sqrt(static_cast<double>(kSamples));
  EXPECT_NEAR(mean.z, 2.0 / 3.0, 5.0 * std::sqrt(1.0 / 18.0) / root) << "seed " << kSeed;
  EXPECT_NEAR(mean.x, 0.0, 5.0 * 0.5 / root) << "seed " << kSeed;
  EXPECT_NEAR(mean.y, 0.0, 5.0 * 0.5 / root) << "seed " << kSeed;
}

}  // namespace
}  // namespace hybray
