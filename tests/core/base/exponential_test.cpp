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
    // Evenly over [-87, 0], and over the exponents of small arguments.
    const double u = random_unit(i, 0);
    const auto x = static_cast<float>(i % 2 ? -87.0 * u : -std::exp2(-40.0 * u));
    const double exact = std::exp(static_cast<double>(x));
    ASSERT_NEAR(static_cast<double>(exp_of_negative(x)), exact,
                2.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * exact)
        << x;
  }
}

TEST(ExpOfNegative, ItsEndsAreExact) {
  EXPECT_EQ(exp_of_negative(0.0f), 1.0f);
  EXPECT_EQ(exp_of_negative(-0.0f), 1.0f);
  EXPECT_GT(exp_of_negative(-87.0f), 0.0f);
  EXPECT_EQ(exp_of_negative(-88.0f), 0.0f);
  EXPECT_EQ(exp_of_negative(-std::numeric_limits<float>::infinity()), 0.0f);
}

}  // namespace
}  // namespace hybray
