#include "harness/config/range.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

const Parameter kInteger{"p", ParameterType::integer, "", {}, -100, 2e9, {}, ""};
const Parameter kNumber{"p", ParameterType::number, "", {}, {}, {}, {}, ""};

std::vector<Value> values(const Parameter& parameter, const std::string& range) {
  std::vector<RangeProblem> problems;
  const std::vector<Value> result = range_values(parameter, Json::parse(range), problems);
  for (const RangeProblem& problem : problems) ADD_FAILURE() << problem.member << ": " << problem.message;
  return result;
}

std::vector<Value> integers(const std::string& range) {
  return values(kInteger, range);
}
std::vector<Value> numbers(const std::string& range) {
  return values(kNumber, range);
}

// The problems as "member: message" lines.
std::string problems(const Parameter& parameter, const std::string& range) {
  std::vector<RangeProblem> found;
  EXPECT_TRUE(range_values(parameter, Json::parse(range), found).empty());
  std::string text;
  for (const RangeProblem& p : found) text += (text.empty() ? "" : "\n") + p.member + ": " + p.message;
  return text;
}

std::vector<Value> list(std::initializer_list<int64_t> of) {
  return {of.begin(), of.end()};
}

TEST(Range, GivesIntegersEvenlySpacedByDifferenceOrByRatio) {
  EXPECT_EQ(integers(R"({"from": 1, "to": 16, "count": 4})"), list({1, 6, 11, 16}));
  EXPECT_EQ(integers(R"({"from": 1, "to": 16, "count": 5, "scale": "log"})"), list({1, 2, 4, 8, 16}));
  EXPECT_EQ(integers(R"({"from": 1, "to": 1000000000, "count": 10, "scale": "log"})"),
            list({1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000}));
  EXPECT_EQ(integers(R"({"from": 0, "to": 8, "step": 2, "scale": "linear"})"), list({0, 2, 4, 6, 8}));
  EXPECT_EQ(integers(R"({"from": 1, "to": 81, "step": 3, "scale": "log"})"), list({1, 3, 9, 27, 81}));
  EXPECT_EQ(integers(R"({"from": -2, "to": 2, "count": 5})"), list({-2, -1, 0, 1, 2}));
}

TEST(Range, RunsBackwardsToo) {
  EXPECT_EQ(integers(R"({"from": 9, "to": 1, "step": -4})"), list({9, 5, 1}));
  EXPECT_EQ(integers(R"({"from": 8, "to": 1, "step": 0.5, "scale": "log"})"), list({8, 4, 2, 1}));
}

// Decimal literals are the doubles nearest to what a person writes; i * 0.1 is another one for 3, 6 and 7.
TEST(Range, GivesTheNumbersThatAPersonWouldWrite) {
  EXPECT_EQ(numbers(R"({"from": 0.1, "to": 0.8, "step": 0.1})"),
            (std::vector<Value>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}));
  EXPECT_EQ(numbers(R"({"from": -0.3, "to": 0.3, "count": 7})"),
            (std::vector<Value>{-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(numbers(R"({"from": 0.25, "to": 8, "count": 6, "scale": "log"})"),
            (std::vector<Value>{0.25, 0.5, 1.0, 2.0, 4.0, 8.0}));
  EXPECT_EQ(numbers(R"({"from": 1e-6, "to": 1e-3, "count": 4, "scale": "log"})"),
            (std::vector<Value>{1e-6, 1e-5, 1e-4, 1e-3}));
}

TEST(Range, RoundsWhatLiesBetweenItsEndsToTwelveDigits) {
  // The square root of 10 is 3.16227766016838, a third is 0.333333333333333.
  EXPECT_EQ(numbers(R"({"from": 1, "to": 10, "count": 3, "scale": "log"})"),
            (std::vector<Value>{1.0, 3.16227766017, 10.0}));
  EXPECT_EQ(numbers(R"({"from": 0, "to": 1, "count": 4})"),
            (std::vector<Value>{0.0, 0.33333333333, 0.66666666667, 1.0}))
      << "twelve digits of 1 are eleven after the point";
  EXPECT_EQ(numbers(R"({"from": 0.12345678901234567, "to": 1, "count": 2})"),
            (std::vector<Value>{0.12345678901234567, 1.0}))
      << "the ends stay as they are";
}

TEST(Range, RefusesAnIntegerThatWouldComeOutBroken) {
  EXPECT_EQ(
      problems(kInteger, R"({"from": 1, "to": 16, "count": 5})"),
      ": value 2 of this range is 4.75; expected an integer from -100 to 2000000000; a list can give any "
      "integers");
  EXPECT_EQ(
      problems(kInteger, R"({"from": 1, "to": 3, "step": 0.5})"),
      ": value 2 of this range is 1.5; expected an integer from -100 to 2000000000; a list can give any "
      "integers");
  EXPECT_EQ(problems(kInteger, R"({"from": 1.5, "to": 3, "count": 2})"),
            "from: found 1.5; expected an integer from -100 to 2000000000");
}

TEST(Range, ExplainsWhatIsMissingAndWhatIsTooMuch) {
  EXPECT_EQ(problems(kNumber, R"({})"),
            ": a range needs \"count\" or \"step\"\n: a range needs \"from\"\n: a range needs \"to\"");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 2, "count": 2, "step": 1})"),
            "step: a range has \"count\" or \"step\", not both");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 2, "cuont": 2})"),
            "cuont: unknown key \"cuont\"; did you mean \"count\"?\n: a range needs \"count\" or \"step\"");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 2, "count": 2, "scale": "lgo"})"),
            "scale: found \"lgo\"; expected one of \"linear\", \"log\"; did you mean \"log\"?");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": "2", "count": 1})"), "to: found \"2\"; expected a number");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 2, "count": 1})"),
            "count: found 1; expected an integer from 2 to 10000");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 2, "count": 10001})"),
            "count: found 10001; expected an integer from 2 to 10000");
  EXPECT_EQ(problems(kNumber, R"({"from": 2, "to": 2.0, "count": 3})"),
            "to: found the same value as \"from\"; expected another one");
  EXPECT_EQ(problems(kNumber, R"({"from": 0, "to": 2, "count": 3, "scale": "log"})"),
            "from: found 0; a log scale needs ends above 0");
  EXPECT_EQ(problems(kNumber, R"({"from": 2, "to": -1, "count": 3, "scale": "log"})"),
            "to: found -1; a log scale needs ends above 0");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 1.0000000000000002, "count": 9})"),
            ": the values of this range lie so close that they come out equal");
}

TEST(Range, RefusesAStepThatDoesNotLeadToItsEnd) {
  EXPECT_EQ(problems(kNumber, R"({"from": 0, "to": 10, "step": 3})"),
            "step: found 3, which leads from 0 past 10, not to it");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 2, "step": 5})"),
            "step: found 5, which leads from 1 past 2, not to it");
  EXPECT_EQ(problems(kNumber, R"({"from": 1, "to": 10, "step": 2, "scale": "log"})"),
            "step: found 2, which leads from 1 past 10, not to it");
  for (const char* step : {"0", "-1", "\"1\"", "null"}) {
    EXPECT_EQ(problems(kNumber, fmt::format(R"({{"from": 1, "to": 3, "step": {}}})", step)),
              fmt::format("step: found {}; expected a number that, added again and again, leads from 1 to 3",
                          step));
  }
  for (const char* step : {"1", "0", "-2", "0.5"}) {
    EXPECT_EQ(
        problems(kNumber, fmt::format(R"({{"from": 1, "to": 4, "step": {}, "scale": "log"}})", step)),
        fmt::format("step: found {}; expected a number that, multiplied again and again, leads from 1 to 4",
                    step));
  }
  EXPECT_EQ(problems(kNumber, R"({"from": 0, "to": 1, "step": 1e-9})"),
            "step: found 1e-09, which makes more than 10000 values");
}

}  // namespace
}  // namespace hybray
