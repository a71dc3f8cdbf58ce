#include "harness/config/suite.h"

#include "core/base/error.h"
#include "harness/config/schema.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class SuiteTest : public ::testing::Test {
 protected:
  SuiteTest() {
    for (const char* name : {"a.json", "b.json", "more/a.json"}) folder_.write(name, "{}");
  }

  Suite read(const std::string& text) {
    const std::filesystem::path file = folder_.write("s.json", text);
    return read_suite(JsonSource::read(file), file);
  }

  // The message with the folder's name taken out of it.
  std::string problem(const std::string& text) {
    std::string message = test::message_of<InputError>([&] { read(text); });
    const std::string folder = folder_.path().string() + "/";
    for (size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(SuiteTest, ReadsConfigsAndTheirChanges) {
  const Suite suite = read(R"({"$schema": "x", "title": "T", "text": "X", "configs": ["a.json",
    {"config": "b.json", "set": {"count": 3, "camera": "nave", "length": [1, 2.5], "loud": true,
     "near": {"from": 1, "to": 2, "count": 2}, "scene": "odd, name"}, "filter": {"scene": ["x", "y"]}}]})");
  EXPECT_EQ(suite.title, "T");
  EXPECT_EQ(suite.text, "X");
  ASSERT_EQ(suite.entries.size(), 2u);
  EXPECT_EQ(suite.entries[0].config, folder_ / "a.json");
  EXPECT_TRUE(suite.entries[0].assignments.empty());
  const SuiteEntry& b = suite.entries[1];
  std::vector<std::string> texts;
  for (const Assignment& a : b.assignments) texts.push_back(a.key + "=" + a.text);
  EXPECT_EQ(texts,
            (std::vector<std::string>{"count=3", "camera=nave", "length=[1,2.5]", "loud=true",
                                      R"(near={"from":1,"to":2,"count":2})", R"(scene=["odd, name"])"}));
  ASSERT_EQ(b.filters.size(), 1u);
  EXPECT_EQ(b.filters[0].text, R"(["x","y"])");
  EXPECT_TRUE(b.filters[0].place.ends_with("s.json:3:91 (/configs/1/filter/scene)")) << b.filters[0].place;
}

TEST_F(SuiteTest, IsToldFromAConfigByItsKeys) {
  EXPECT_TRUE(is_suite(JsonSource(R"({"configs": []})", "s")));
  EXPECT_FALSE(is_suite(JsonSource(R"({"configs": [], "experiment": "toy"})", "s")));
  EXPECT_FALSE(is_suite(JsonSource("{}", "s")));
  EXPECT_FALSE(is_suite(JsonSource("[\"configs\"]", "s")));
}

TEST_F(SuiteTest, ExplainsWhatIsWrong) {
  EXPECT_EQ(problem(R"({"configs": ["a.json"], "tilte": "x"})"),
            "s.json:1:25 (/tilte): unknown key \"tilte\"; did you mean \"title\"?");
  EXPECT_EQ(problem(R"({"configs": ["a.json"], "title": 1})"),
            "s.json:1:34 (/title): found 1; expected text");
  EXPECT_EQ(problem(R"({"configs": []})"),
            "s.json:1:13 (/configs): found an empty list; expected a list [...] of configs");
  EXPECT_EQ(problem(R"({"configs": "a.json"})"),
            "s.json:1:13 (/configs): found \"a.json\"; expected a list [...] of configs");
  EXPECT_EQ(problem(R"({"configs": [1]})"),
            "s.json:1:14 (/configs/0): found 1; expected the path of a config, or an object {...}");
  EXPECT_EQ(problem(R"({"configs": [{"set": {}}]})"),
            "s.json:1:14 (/configs/0): the key \"config\" is missing: it gives the config's path");
  EXPECT_EQ(problem(R"({"configs": [{"config": "a.json", "sets": {}}]})"),
            "s.json:1:35 (/configs/0/sets): unknown key \"sets\"; did you mean \"set\"?");
  EXPECT_EQ(problem(R"({"configs": [{"config": 1}]})"),
            "s.json:1:25 (/configs/0/config): found 1; expected the path of a config");
  EXPECT_EQ(problem(R"({"configs": [{"config": "a.json", "set": 1}]})"),
            "s.json:1:42 (/configs/0/set): found 1; expected an object {...}");
  EXPECT_EQ(
      problem(R"({"configs": [{"config": "a.json", "filter": {"x": null}}]})"),
      "s.json:1:51 (/configs/0/filter/x): found null; expected a value, a list [...] of values or a range "
      "{...}");
}

TEST_F(SuiteTest, RefusesConfigsThatAreNotThereAndTwoOfOneName) {
  EXPECT_EQ(problem(R"({"configs": ["aa.json"]})"),
            "s.json:1:14 (/configs/0): there is no config aa.json; did you mean \"a.json\"?");
  EXPECT_EQ(
      problem(R"({"configs": ["a.json", {"config": "a.json"}]})"),
      "s.json:1:35 (/configs/1/config): a config named \"a\" stands in this list before, at s.json:1:14 "
      "(/configs/0)");
  EXPECT_EQ(problem(R"({"configs": ["a.json", "more/a.json"]})"),
            "s.json:1:24 (/configs/1): a config named \"a\" stands in this list before, at s.json:1:14 "
            "(/configs/0)")
      << "their results would have one folder";
}

// What the schema rejects has a message of the reader's own, and the other way round for all that a schema
// can say.
TEST_F(SuiteTest, AgreesWithItsSchema) {
  const auto violations = [](const char* text) {
    return schema_violations(suite_schema(), nlohmann::ordered_json::parse(text)).size();
  };
  EXPECT_EQ(
      violations(
          R"({"$schema": "x", "title": "T", "configs": ["a", {"config": "b", "set": {"n": [1, {}]}}]})"),
      0u);
  for (const char* bad :
       {R"({})", R"({"configs": []})", R"({"configs": [1]})", R"({"configs": [""]})",
        R"({"configs": ["a", "a"]})", R"({"configs": [{"set": {}}]})",
        R"({"configs": [{"config": "a", "sets": {}}]})",
        R"({"configs": [{"config": "a", "filter": {"x": null}}]})", R"({"configs": ["a"], "extra": 1})"}) {
    EXPECT_GT(violations(bad), 0u) << bad;
  }
}

}  // namespace
}  // namespace hybray
