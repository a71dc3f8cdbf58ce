#include "harness/table/value.h"

#include "core/base/hash.h"

#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Value, ReadsAsPeopleWriteIt) {
  EXPECT_EQ(to_text(Value()), "");
  EXPECT_EQ(to_text(Value(true)), "true");
  EXPECT_EQ(to_text(Value(int64_t{-3})), "-3");
  EXPECT_EQ(to_text(Value(0.1)), "0.1");
  EXPECT_EQ(to_text(Value(std::string("a,b"))), "a,b");
}

TEST(Value, WritesEveryDoubleSoThatItReadsBackTheSame) {
  for (uint64_t i = 0; i < 10000; ++i) {
    const uint64_t bits = random_bits(i, 0);
    double number;
    static_assert(sizeof number == sizeof bits);
    __builtin_memcpy(&number, &bits, sizeof number);
    if (number != number || number - number != 0) continue;
    EXPECT_EQ(std::strtod(to_text(Value(number)).c_str(), nullptr), number);
  }
}

TEST(ValueDeathTest, NeverWritesNaN) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(to_text(Value(std::numeric_limits<double>::quiet_NaN())), "isfinite");
}

}  // namespace
}  // namespace hybray
