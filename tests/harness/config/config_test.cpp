#include "harness/config/config.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "tests/harness/support/toy_experiment.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

class ConfigTest : public ::testing::Test {
 protected:
  Config load(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return load_config(folder_.write("c.json", text), experiments_, assignments);
  }

  // The message with the folder's name taken out of it.
  std::string problem(const std::string& text, const std::vector<std::string>& assignments = {}) {
    std::string message = test::message_of<InputError>([&] { load(text, assignments); });
    const std::string folder = folder_.path().string() + "/";
    for (size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

  // The problem of a toy config whose "parameters" are these.
  std::string with_parameters(const std::string& members) {
    return problem("{\"experiment\": \"toy\", \"parameters\": {" + members + "}}");
  }
  std::string with_sweep(const std::string& members) {
    return problem("{\"experiment\": \"toy\", \"sweep\": {" + members + "}}");
  }

  const test::TemporaryFolder folder_;
  const std::vector<Experiment> experiments_ = test::toy_experiments();
};

TEST_F(ConfigTest, ReadsEveryPart) {
  const Config config =
      load(R"({"$schema": "s.json", "experiment": "staged", "title": "T", "text": "X", "seed": 7,
    "parameters": {"count": 2}, "sweep": {"length": [1, 0.5], "scene": ["b", "a"]}, "optional_scenes": ["b"]})");
  EXPECT_EQ(config.name, "c");
  EXPECT_EQ(config.experiment->name, "staged");
  EXPECT_EQ(config.title, "T");
  EXPECT_EQ(config.text, "X");
  EXPECT_EQ(config.seed, 7);
  ASSERT_EQ(config.sweep.size(), 2u);
  EXPECT_EQ(config.sweep[0].parameter->name, "length");
  EXPECT_EQ(config.sweep[0].values, (std::vector<Value>{1.0, 0.5}));
  EXPECT_EQ(config.sweep[1].values, (std::vector<Value>{"b", "a"}));
  EXPECT_EQ(config.setting("count").values, std::vector<Value>{int64_t{2}});
  EXPECT_EQ(config.setting("resolution").values, std::vector<Value>{"8x8"});
  EXPECT_EQ(config.optional_scenes, std::vector<std::string>{"b"});
}

TEST_F(ConfigTest, ExplainsUnknownKeys) {
  EXPECT_EQ(problem("{\"experiment\": \"toy\",\n \"sweeps\": {}}"),
            "c.json:2:2 (/sweeps): unknown key \"sweeps\"; did you mean \"sweep\"?");
  EXPECT_EQ(with_parameters("\"lenght\": 1"),
            "c.json:1:38 (/parameters/lenght): unknown parameter \"lenght\"; did you mean \"length\"?");
  EXPECT_EQ(with_sweep("\"zzz\": [1]"),
            "c.json:1:33 (/sweep/zzz): unknown parameter \"zzz\"; known are: count, length, loud, behaviour, "
            "resolution");
}

TEST_F(ConfigTest, ExplainsWrongValues) {
  EXPECT_EQ(with_parameters("\"count\": \"two\""),
            "c.json:1:47 (/parameters/count): found \"two\"; expected an integer from 1 to 9");
  EXPECT_EQ(with_parameters("\"count\": 2.0"),
            "c.json:1:47 (/parameters/count): found 2.0; expected an integer from 1 to 9");
  EXPECT_EQ(with_parameters("\"count\": 10"),
            "c.json:1:47 (/parameters/count): found 10; expected an integer from 1 to 9");
  EXPECT_EQ(with_parameters("\"count\": null"),
            "c.json:1:47 (/parameters/count): found null; expected an integer from 1 to 9");
  EXPECT_EQ(with_parameters("\"count\": 18446744073709551615"),
            "c.json:1:47 (/parameters/count): found 18446744073709551615; expected an integer from 1 to 9");
  EXPECT_EQ(with_parameters("\"length\": -1"),
            "c.json:1:48 (/parameters/length): found -1; expected a number of at least 0 m");
  EXPECT_EQ(with_parameters("\"loud\": 1"),
            "c.json:1:46 (/parameters/loud): found 1; expected true or false");
  EXPECT_EQ(with_parameters("\"behaviour\": \"trow\""),
            "c.json:1:51 (/parameters/behaviour): found \"trow\"; expected one of \"plain\", \"throw\", "
            "\"nan\", \"sleep\"; did "
            "you mean \"throw\"?");
  EXPECT_EQ(with_parameters("\"count\": [1, 2]"),
            "c.json:1:47 (/parameters/count): found [1,2]; expected an integer from 1 to 9; a list of values "
            "belongs in \"sweep\"");
}

TEST_F(ConfigTest, ExplainsWrongSweeps) {
  EXPECT_EQ(
      problem("{\"experiment\": \"toy\",\n \"sweep\": {\"resolution\": [\"8x8\", \"9x9\",\n  \"19x\"]}}"),
      "c.json:3:3 (/sweep/resolution/2): found \"19x\"; expected \"WIDTHxHEIGHT\" with each side 1 to 16384");
  EXPECT_EQ(with_sweep("\"count\": 3"),
            "c.json:1:42 (/sweep/count): found 3; expected a list [...] of values; a single value "
            "belongs in \"parameters\"");
  EXPECT_EQ(with_sweep("\"count\": []"),
            "c.json:1:42 (/sweep/count): found an empty list; expected at least one value");
  EXPECT_EQ(with_sweep("\"length\": [1, 2, 1.0]"),
            "c.json:1:50 (/sweep/length/2): the value 1 stands twice in this list");
  EXPECT_EQ(
      problem(R"({"experiment": "staged", "sweep": {"camera": ["*", "x"], "scene": ["s"], "count": [1]}})"),
      "c.json:1:47 (/sweep/camera/0): \"*\" stands for every camera of the scene, so it must be the only "
      "value here");
  EXPECT_EQ(
      problem("{\"experiment\": \"toy\", \"parameters\": {\"count\": 1},\n \"sweep\": {\"count\": [2]}}"),
      "c.json:2:12 (/sweep/count): the parameter \"count\" stands in \"parameters\" too, at c.json:1:38 "
      "(/parameters/count)");
}

TEST_F(ConfigTest, ExplainsWrongParts) {
  EXPECT_EQ(problem("[1]"), "c.json:1:1: found [1]; expected an object {...}");
  EXPECT_EQ(problem("{}"), "c.json:1:1: the key \"experiment\" is missing: it names the experiment to run");
  EXPECT_EQ(problem("{\"experiment\": \"tyo\"}"),
            "c.json:1:16 (/experiment): unknown experiment \"tyo\"; did you mean \"toy\"?");
  EXPECT_EQ(problem("{\"experiment\": 5}"),
            "c.json:1:16 (/experiment): found 5; expected the name of an experiment");
  EXPECT_EQ(problem("{\"experiment\": \"toy\", \"title\": 5}"),
            "c.json:1:32 (/title): found 5; expected text");
  EXPECT_EQ(problem("{\"experiment\": \"toy\", \"seed\": -1}"),
            "c.json:1:31 (/seed): found -1; expected an integer from 0 to 9007199254740991");
  EXPECT_EQ(problem("{\"experiment\": \"toy\", \"parameters\": 5}"),
            "c.json:1:37 (/parameters): found 5; expected an object {...}");
  EXPECT_EQ(
      problem(
          R"({"experiment": "staged", "parameters": {"count": 1, "scene": "a"}, "optional_scenes": ["b"]})"),
      "c.json:1:88 (/optional_scenes/0): \"b\" is not among the scenes of this config");
  EXPECT_EQ(problem("{\"experiment\": \"toy\"}"),
            "c.json:1:1: the parameter \"count\" has no default: \"parameters\" or \"sweep\" must give it "
            "(an integer from 1 to 9)");
}

TEST_F(ConfigTest, ReportsEveryProblemOnALineOfItsOwn) {
  EXPECT_EQ(with_parameters("\"count\": 0, \"lond\": true"),
            "c.json:1:47 (/parameters/count): found 0; expected an integer from 1 to 9\n"
            "c.json:1:50 (/parameters/lond): unknown parameter \"lond\"; did you mean \"loud\"?");
}

TEST_F(ConfigTest, AnswersAnyDamageToAFileWithAMessageOrAConfig) {
  const std::string good =
      R"({"$schema": "s", "experiment": "staged", "seed": 7, "parameters": {"count": 2, "length": 1.5e0},
    "sweep": {"resolution": ["8x8", "9x9"], "scene": ["b", "a"], "loud": [true]}, "optional_scenes": ["b"]})";
  const std::string alphabet = "{}[]\",:0x-.e *\\\n\xff";
  size_t refused = 0;
  for (uint64_t i = 0; i < 3000; ++i) {
    std::string damaged = good;
    for (uint32_t edit = 0; edit <= i % 3; ++edit) {
      const size_t at = random_bits(i, 2 * edit) % damaged.size();
      const uint64_t choice = random_bits(i, 2 * edit + 1);
      if (choice % 3 == 0)
        damaged.erase(at, 1 + choice / 3 % 8);
      else
        damaged[at] = alphabet[choice / 3 % alphabet.size()];
    }
    try {
      load(damaged);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_NE(error.where().find("c.json:"), std::string::npos) << "damage " << i << ": " << damaged;
    }
  }
  EXPECT_GT(refused, 2000u);
}

TEST_F(ConfigTest, LetsTheCommandLineReplaceParametersSweepsAndTheSeed) {
  const std::string text =
      R"({"experiment": "toy", "parameters": {"length": 3}, "sweep": {"loud": [false, true]}})";
  const Config config = load(text, {"loud=true", "length=4", "count=5", "seed=9", "count=6"});
  EXPECT_TRUE(config.sweep.empty());
  EXPECT_EQ(config.setting("loud").values, std::vector<Value>{true});
  EXPECT_EQ(config.setting("length").values, std::vector<Value>{4.0});
  EXPECT_EQ(config.setting("count").values, std::vector<Value>{int64_t{6}}) << "the last one counts";
  EXPECT_EQ(config.seed, 9);
}

TEST_F(ConfigTest, ExplainsWrongAssignments) {
  const std::string good = R"({"experiment": "toy", "parameters": {"count": 3}})";
  EXPECT_EQ(problem(good, {"cuont=1"}),
            "--set cuont=1: unknown parameter \"cuont\"; did you mean \"count\"?");
  EXPECT_EQ(problem(good, {"count=11"}), "--set count=11: found 11; expected an integer from 1 to 9");
  EXPECT_EQ(problem(good, {"count"}), "--set count: expected KEY=VALUE");
  EXPECT_EQ(problem(good, {"seed=x"}),
            "--set seed=x: found \"x\"; expected an integer from 0 to 9007199254740991");
}

}  // namespace
}  // namespace hybray
