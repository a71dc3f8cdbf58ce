#include "harness/config/parameter_rules.h"

#include "core/base/error.h"
#include "harness/experiments/resolution.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

using enum ParameterType;

Parameter ranged(ParameterType type, std::optional<double> least, std::optional<double> most,
                 std::string unit = "") {
  return {"p", type, std::move(unit), {}, least, most, {}, ""};
}

bool accepts(const Parameter& parameter, Value value) {
  return accept(parameter, value);
}

TEST(ParameterRules, SaysInWordsWhatIsExpected) {
  EXPECT_EQ(expectation(ranged(boolean, {}, {})), "true or false");
  EXPECT_EQ(expectation(ranged(integer, 1, 9)), "an integer from 1 to 9");
  EXPECT_EQ(expectation(ranged(number, 0, {}, "m")), "a number of at least 0 m");
  EXPECT_EQ(expectation(ranged(number, {}, 0.5)), "a number of at most 0.5");
  EXPECT_EQ(expectation(ranged(number, {}, {}, "m")), "a number (m)");
  EXPECT_EQ(expectation({"p", choice, "", {}, {}, {}, {"a", "b"}, ""}), "one of \"a\", \"b\"");
  EXPECT_EQ(expectation({"p", choice, "", {}, {}, {}, {"a"}, ""}), "\"a\"");
  EXPECT_EQ(expectation(ranged(resolution, 1, 16384)), "\"WIDTHxHEIGHT\" with each side 1 to 16384");
}

TEST(ParameterRules, KeepsToTheRangeEndsIncluded) {
  for (const int64_t i : {1, 9}) EXPECT_TRUE(accepts(ranged(integer, 1, 9), i));
  for (const int64_t i : {0, 10}) EXPECT_FALSE(accepts(ranged(integer, 1, 9), i));
  EXPECT_TRUE(accepts(ranged(number, 0, 1), 1.0));
  EXPECT_FALSE(accepts(ranged(number, 0, 1), 1.0000001));
}

TEST(ParameterRules, MakesANumberOfAnIntegerButNoIntegerOfANumber) {
  Value value = int64_t{3};
  EXPECT_TRUE(accept(ranged(number, {}, {}), value));
  EXPECT_EQ(value, Value(3.0));
  EXPECT_FALSE(accepts(ranged(integer, {}, {}), 3.0));
}

TEST(ParameterRules, TakesOnlyPlainResolutions) {
  const Parameter parameter = ranged(resolution, 1, 16384);
  for (const char* good : {"1x1", "1920x1080", "16384x16384"})
    EXPECT_TRUE(accepts(parameter, std::string(good))) << good;
  for (const char* bad : {"", "x", "19x", "x19", "0x5", "5x0", "05x5", "-5x5", "+5x5", "5 x5", "5x5 ",
                          "5x5x5", "5X5", "16385x1", "1x16385", "1x99999999999999999999", "1.5x2"}) {
    EXPECT_FALSE(accepts(parameter, std::string(bad))) << bad;
  }
}

TEST(ParameterRules, ReadsValuesFromTheCommandLineByTheirType) {
  EXPECT_EQ(value_from_text(ranged(number, 0, {}), "2", ""), Value(2.0));
  EXPECT_EQ(value_from_text(ranged(boolean, {}, {}), "true", ""), Value(true));
  EXPECT_EQ(value_from_text(ranged(scene, {}, {}), "12", ""), Value("12"));
  EXPECT_EQ(
      test::message_of<InputError>([] { value_from_text(ranged(integer, 1, 9), "many", "--set p=many"); }),
      "--set p=many: found \"many\"; expected an integer from 1 to 9");
  EXPECT_EQ(test::message_of<InputError>(
                [] { value_from_text(ranged(integer, 1, {}), "99999999999999999999", "x"); }),
            "x: found 1e+20; expected an integer of at least 1");
}

TEST(ParameterRules, SuggestsTheNearestNameOrListsAll) {
  EXPECT_EQ(unknown_name("scene", "shpere", {"atrium", "sphere"}),
            "unknown scene \"shpere\"; did you mean \"sphere\"?");
  EXPECT_EQ(unknown_name("scene", "q", {"atrium", "sphere"}),
            "unknown scene \"q\"; known are: atrium, sphere");
}

}  // namespace
}  // namespace hybray
