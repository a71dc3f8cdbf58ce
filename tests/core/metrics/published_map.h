// A FLIP error map held against numbers of the authors' implementation.
//
// Both compute in float and round differently, and FLIP's powers below 1 enlarge what is close to zero. A sum
// of 21 taps twice is good to some 1e-6 of the luminance, up to 1e-4 of lightness: where the images are the
// same, that alone is an error of (1e-4)^0.7 / 23 = 7e-5. A feature difference of 1e-7 that is none becomes
// sqrt(1e-7 / 2) = 2e-4 in the exponent, which moves an error e by e ln(1/e) 2e-4 <= 8e-5. (The greatest
// deviation found over all pixels of the maps here was 4.1e-5, that of a mean 5.4e-8; constant colours are
// off their closed form by up to 4.4e-5 here, 3.3e-5 there.)
#pragma once

#include "core/metrics/flip.h"
#include "tests/core/metrics/formula_images.h"

#include <array>

#include <gtest/gtest.h>

namespace hybray::test {

constexpr double kFlipTolerance = 1e-4;

// `values`: at rows 0, 11, 24, 47 and, in each, columns 0, 10, 21, 33, 52, 63.
inline void expect_published_map(const Image2D<float>& map, double mean,
                                 const std::array<float, 24>& values) {
  ASSERT_EQ(map.width(), kFormulaWidth);
  ASSERT_EQ(map.height(), kFormulaHeight);
  EXPECT_NEAR(metrics::mean_error(map), mean, 1e-6);
  size_t at = 0;
  for (const int y : {0, 11, 24, 47})
    for (const int x : {0, 10, 21, 33, 52, 63})
      EXPECT_NEAR(map(x, y), values[at++], kFlipTolerance) << x << ", " << y;
}

}  // namespace hybray::test
