// The exponential against the library's.
#include "core/base/exponential.h"

#include "core/base/hash.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(ExpOfNegative, IsWithinTwoUnitsInTheLastPlaceOfTheLibrary) {
  for (uint64_t i = 0; i < 200000; ++i) {
    // Evenly over [-708, 0], and over the exponents of small arguments.
    const double u = random_unit(i, 0);
    const double x = i % 2 ? -708.0 * u : -std::exp2(-60.0 * u);
    const double exact = std::exp(x);
    ASSERT_NEAR(exp_of_negative(x), exact, 2.0 * std::numeric_limits<double>::epsilon() * exact) << x;
  }
}

TEST(ExpOfNegative, ItsEndsAreExact) {
  EXPECT_EQ(exp_of_negative(0.0), 1.0);
  EXPECT_EQ(exp_of_negative(-0.0), 1.0);
  EXPECT_GT(exp_of_negative(-708.0), 0.0);
  EXPECT_EQ(exp_of_negative(-709.0), 0.0);
  EXPECT_EQ(exp_of_negative(-std::numeric_limits<double>::infinity()), 0.0);
}

}  // namespace
}  // namespace hybray
