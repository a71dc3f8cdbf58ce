#include "harness/config/assignment.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

const Parameter kCount{"count", ParameterType::integer, "", {}, 1, 9, {}, ""};
const Parameter kCamera{"camera", ParameterType::camera, "", {}, {}, {}, {}, ""};

std::vector<Value> values(const Parameter& parameter, const std::string& text) {
  return values_of({parameter.name, text, "--set"}, parameter);
}

std::string problem(const std::string& text) {
  return test::message_of<InputError>([&] { values(kCount, text); });
}

TEST(Assignment, SplitsAtTheFirstEqualsSign) {
  const std::vector<std::string> arguments{"camera=a=b", "count="};
  const auto assignments = assignments_of("--set", arguments);
  ASSERT_EQ(assignments.size(), 2u);
  EXPECT_EQ(assignments[0].key, "camera");
  EXPECT_EQ(assignments[0].text, "a=b");
  EXPECT_EQ(assignments[0].place, "--set camera=a=b");
  EXPECT_EQ(assignments[1].text, "");
  for (const std::string bad : {"count", "=1", ""}) {
    EXPECT_EQ(test::message_of<InputError>([&] {
                assignments_of("--filter", {&bad, 1});
              }),
              "--filter " + bad + ": expected KEY=VALUE");
  }
}

TEST(Assignment, GivesOneValueOrSeveral) {
  EXPECT_EQ(values(kCount, "3"), std::vector<Value>{int64_t{3}});
  EXPECT_EQ(values(kCount, "1,2,4"), (std::vector<Value>{int64_t{1}, int64_t{2}, int64_t{4}}));
  EXPECT_EQ(values(kCount, "[1, 2]"), (std::vector<Value>{int64_t{1}, int64_t{2}}));
  EXPECT_EQ(values(kCount, R"({"from": 1, "to": 8, "count": 4, "scale": "log"})"),
            (std::vector<Value>{int64_t{1}, int64_t{2}, int64_t{4}, int64_t{8}}));
  EXPECT_EQ(values(kCamera, "nave,aisle"), (std::vector<Value>{"nave", "aisle"}));
  EXPECT_EQ(values(kCamera, R"(["nave, left", "12"])"), (std::vector<Value>{"nave, left", "12"}));
}

TEST(Assignment, RefusesWhatTheParameterDoesNotAccept) {
  EXPECT_EQ(problem("1,10"), "--set: found 10; expected an integer from 1 to 9");
  EXPECT_EQ(problem("1,,2"), "--set: found \"\"; expected an integer from 1 to 9");
  EXPECT_EQ(problem("1,2,1"), "--set: the value 1 stands twice in this list");
  EXPECT_EQ(problem("[]"), "--set: found an empty list; expected at least one value");
  EXPECT_EQ(problem("[1, [2]]"), "--set: found [2]; expected an integer from 1 to 9");
  EXPECT_EQ(problem("[1"), "--set: found \"[1\"; expected an integer from 1 to 9, or a list [...] of such");
  EXPECT_EQ(problem(R"({"from": 1, "to": 9})"), "--set: a range needs \"count\" or \"step\"");
  EXPECT_EQ(problem(R"({"from": 1, "to": 10, "count": 4})"),
            "--set: \"to\": found 10; expected an integer from 1 to 9");
  EXPECT_EQ(test::message_of<InputError>([&] { values(kCamera, "{}"); }),
            "--set: found \"{}\"; expected the name of a camera, \"*\" for each camera of the scene, "
            "\"seeded/N\" (N from "
            "0 to 999999) for the N-th of the cameras that a generator places in any scene, or "
            "\"seeded*COUNT\" (1 to "
            "4096) for the first so many of them, or a list "
            "[...] of such");
}

}  // namespace
}  // namespace hybray
