#include "harness/config/schema.h"

#include "harness/config/config_check.h"
#include "harness/experiments/experiment.h"
#include "tests/harness/support/toy_experiment.h"
#include "tests/temporary_folder.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

class SchemaTest : public ::testing::Test {
 protected:
  std::vector<SchemaViolation> violations(const std::string& document) {
    return schema_violations(config_schema(staged_), Json::parse(document));
  }

  const std::vector<Experiment> experiments_ = test::toy_experiments();
  const Experiment& staged_ = experiments_[1];
};

TEST_F(SchemaTest, FollowsFromTheDeclaration) {
  const Json schema = config_schema(staged_);
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_EQ(schema["additionalProperties"], false);
  const Json& count = schema["definitions"]["count"];
  EXPECT_EQ(count["type"], "integer");
  EXPECT_EQ(count["minimum"], 1);
  EXPECT_EQ(count["maximum"], 9);
  EXPECT_FALSE(count.contains("default"));
  const Json& length = schema["definitions"]["length"];
  EXPECT_EQ(length["default"], 0.5);
  EXPECT_EQ(length["description"], "How long. (m) Expects a number of at least 0 m.");
  EXPECT_EQ(schema["definitions"]["behaviour"]["enum"],
            (Json{"plain", "throw", "nan", "sleep", "wordy", "fragile"}));
}

TEST_F(SchemaTest, AcceptsAGoodConfig) {
  EXPECT_TRUE(
      violations(
          R"({"$schema": "x", "experiment": "staged", "seed": 0, "parameters": {"count": 9, "length": 1,
    "loud": true, "camera": "*"}, "sweep": {"scene": ["a"], "resolution": ["1x1", "1920x1080"]}})")
          .empty());
  EXPECT_TRUE(violations(R"({"experiment": "staged", "points": [{}, {"scene": "a", "count": 2}],
    "scenes": {"a": {"camera": "x", "length": 0.5}}, "sweep": {"length": {"from": 0, "to": 1, "step": 0.5},
    "loud": [true, false]}})")
                  .empty());
  EXPECT_TRUE(violations(R"({"experiment": "staged",
    "sweep": {"count": {"from": 1, "to": 8, "count": 4, "scale": "log"}}})")
                  .empty());
}

// Each document breaks one rule, at the pointer beside it.
const std::pair<const char*, const char*> kBroken[] = {
    {R"({"experiment": "toy"})", "/experiment"},
    {R"({"experiment": "staged", "seed": -1})", "/seed"},
    {R"({"experiment": "staged", "seed": 1.5})", "/seed"},
    {R"({"experiment": "staged", "title": 1})", "/title"},
    {R"({"experiment": "staged", "extra": 1})", ""},
    {R"({"experiment": "staged", "parameters": {"count": 0}})", "/parameters/count"},
    {R"({"experiment": "staged", "parameters": {"count": 10}})", "/parameters/count"},
    {R"({"experiment": "staged", "parameters": {"count": 1.5}})", "/parameters/count"},
    {R"({"experiment": "staged", "parameters": {"length": "1"}})", "/parameters/length"},
    {R"({"experiment": "staged", "parameters": {"loud": 0}})", "/parameters/loud"},
    {R"({"experiment": "staged", "parameters": {"behaviour": "loud"}})", "/parameters/behaviour"},
    {R"({"experiment": "staged", "parameters": {"resolution": "19x"}})", "/parameters/resolution"},
    {R"({"experiment": "staged", "parameters": {"scene": ""}})", "/parameters/scene"},
    {R"({"experiment": "staged", "parameters": {"extra": 1}})", "/parameters"},
    {R"({"experiment": "staged", "parameters": []})", "/parameters"},
    {R"({"experiment": "staged", "sweep": {"count": 1}})", "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"count": []}})", "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"count": [1, 1]}})", "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"count": [1, "2"]}})", "/sweep/count/1"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "to": 9}}})", "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "count": 3}}})", "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "to": 9, "count": 3, "step": 4}}})",
     "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "to": 10, "count": 4}}})", "/sweep/count/to"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "to": 9, "count": 1}}})",
     "/sweep/count/count"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "to": 9, "step": 2, "scale": "cubic"}}})",
     "/sweep/count/scale"},
    {R"({"experiment": "staged", "sweep": {"count": {"from": 1, "to": 9, "steps": 2}}})", "/sweep/count"},
    {R"({"experiment": "staged", "sweep": {"loud": {"from": 1, "to": 9, "count": 2}}})", "/sweep/loud"},
    {R"({"experiment": "staged", "points": []})", "/points"},
    {R"({"experiment": "staged", "points": {}})", "/points"},
    {R"({"experiment": "staged", "points": [1]})", "/points/0"},
    {R"({"experiment": "staged", "points": [{"count": 1}, {"count": 1}]})", "/points"},
    {R"({"experiment": "staged", "points": [{"count": 0}]})", "/points/0/count"},
    {R"({"experiment": "staged", "points": [{"count": [1]}]})", "/points/0/count"},
    {R"({"experiment": "staged", "points": [{"extra": 1}]})", "/points/0"},
    {R"({"experiment": "staged", "scenes": []})", "/scenes"},
    {R"({"experiment": "staged", "parameters": {"scene": "a"}, "scenes": {"a": 1}})", "/scenes/a"},
    {R"({"experiment": "staged", "parameters": {"scene": "a"}, "scenes": {"a": {"scene": "a"}}})",
     "/scenes/a"},
    {R"({"experiment": "staged", "parameters": {"scene": "a"}, "scenes": {"a": {"count": 0}}})",
     "/scenes/a/count"},
    {R"({"experiment": "staged", "optional_scenes": "a"})", "/optional_scenes"},
    {R"({"experiment": "staged", "optional_scenes": [1]})", "/optional_scenes/0"},
};

TEST_F(SchemaTest, RejectsABrokenConfigAtTheRightPlace) {
  for (const auto& [document, pointer] : kBroken) {
    const auto found = violations(document);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const auto& v) { return v.pointer == pointer; }))
        << document;
  }
}

// Where the schema's own words would have to do, config_problems gives them; these show that its own come
// first.
TEST_F(SchemaTest, RejectsOnlyWhatHasAMessageFromTheDeclaration) {
  for (const auto& [document, pointer] : kBroken) {
    const JsonSource source(document, "c.json");
    if (source.root()["experiment"] != "staged") continue;
    const auto problems = config_problems(source, staged_);
    ASSERT_FALSE(problems.empty()) << document;
    const bool ours =
        problems[0].message.starts_with("found ") || problems[0].message.starts_with("unknown ") ||
        problems[0].message.starts_with("the ") || problems[0].message.starts_with("this point ") ||
        problems[0].message.starts_with("a range ");
    EXPECT_TRUE(ours) << document << ": " << problems[0].message;
  }
}

// The schemas in the repository are what editors complete from.
TEST(CheckedInSchemas, AreWhatTheDeclarationsSay) {
  ASSERT_FALSE(experiments().empty());
  for (const Experiment& experiment : experiments()) {
    const std::string file = HYBRAY_PROJECT_DIR "/configs/schema/" + experiment.name + ".schema.json";
    EXPECT_EQ(test::content_of(file), config_schema_text(experiment))
        << "make it anew: hybray describe " << experiment.name << " --schema > configs/schema/"
        << experiment.name << ".schema.json";
  }
  EXPECT_EQ(test::content_of(HYBRAY_PROJECT_DIR "/configs/schema/suite.schema.json"), suite_schema_text())
      << "make it anew: hybray describe suite --schema > configs/schema/suite.schema.json";
}

}  // namespace
}  // namespace hybray
