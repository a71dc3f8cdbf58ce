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
    return load_config(folder_.write("c.json", text), experiments_, assignments_of("--set", assignments));
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
            "\"nan\", \"sleep\", \"wordy\", \"fragile\"; did "
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
            "c.json:1:42 (/sweep/count): found 3; expected a list [...] of values or a range {...}; a single "
            "value belongs in \"parameters\"");
  EXPECT_EQ(
      with_sweep("\"loud\": true"),
      "c.json:1:41 (/sweep/loud): found true; expected a list [...] of values; a single value belongs in "
      "\"parameters\"");
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

TEST_F(ConfigTest, ReadsPointsRangesAndOverridesOfScenes) {
  const Config config = load(R"({"experiment": "staged", "parameters": {"scene": "a"},
    "points": [{"count": 1, "length": 2}, {"count": 3, "scene": "b"}], "scenes": {"b": {"camera": "x"}},
    "sweep": {"loud": [true, false]}})");
  ASSERT_EQ(config.points.size(), 2u);
  const Parameter* count = config.points[0][0].parameter;
  EXPECT_EQ(count->name, "count");
  EXPECT_EQ(find_given(config.points[1], count)->value, Value(int64_t{3}));
  EXPECT_EQ(config.points[0][1].value, Value(2.0)) << "an integer is a number here";
  EXPECT_TRUE(config.points[1][1].place.ends_with("c.json:2:65 (/points/1/scene)"))
      << config.points[1][1].place;
  EXPECT_EQ(config.scene_overrides.at("b")[0].value, Value("x"));
  const std::vector<Given> scenes = scenes_of(config);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0].value, Value("a"));
  EXPECT_EQ(scenes[1].value, Value("b"));

  const Config range = load(R"({"experiment": "toy", "parameters": {"count": 1},
    "sweep": {"length": {"from": 0.5, "to": 4, "count": 4, "scale": "log"}}})");
  EXPECT_EQ(range.sweep[0].values, (std::vector<Value>{0.5, 1.0, 2.0, 4.0}));
  EXPECT_TRUE(range.sweep[0].places[3].ends_with("(/sweep/length)"));
}

TEST_F(ConfigTest, ExplainsWrongRanges) {
  EXPECT_EQ(with_sweep("\"count\": {\"from\": 1, \"to\": 10, \"count\": 4}"),
            "c.json:1:60 (/sweep/count/to): found 10; expected an integer from 1 to 9");
  EXPECT_EQ(with_sweep("\"count\": {\"from\": 1, \"to\": 9, \"stpe\": 4}"),
            "c.json:1:63 (/sweep/count/stpe): unknown key \"stpe\"; did you mean \"step\"?\n"
            "c.json:1:42 (/sweep/count): a range needs \"count\" or \"step\"");
  EXPECT_EQ(
      with_sweep("\"resolution\": {\"from\": 1, \"to\": 9, \"step\": 4}"),
      "c.json:1:47 (/sweep/resolution): found {\"from\":1,\"to\":9,\"step\":4}; expected a list [...] of "
      "values; a single value belongs in \"parameters\"");
  EXPECT_EQ(with_parameters("\"count\": {\"from\": 1, \"to\": 9, \"step\": 4}"),
            "c.json:1:47 (/parameters/count): found {\"from\":1,\"to\":9,\"step\":4}; expected an integer "
            "from 1 to "
            "9; a range of values belongs in \"sweep\"");
}

TEST_F(ConfigTest, ExplainsWrongPoints) {
  const auto with_points = [&](const std::string& list, const std::string& more = "") {
    return problem("{\"experiment\": \"toy\", \"points\": " + list + more + "}");
  };
  EXPECT_EQ(
      with_points("{}"),
      "c.json:1:33 (/points): found {}; expected a list [...] of objects {...}, each with the parameters of "
      "a point");
  EXPECT_EQ(
      with_points("[]"),
      "c.json:1:33 (/points): found an empty list; expected a list [...] of objects {...}, each with the "
      "parameters of a point");
  EXPECT_EQ(with_points("[1]"), "c.json:1:34 (/points/0): found 1; expected an object {...}");
  EXPECT_EQ(with_points("[{\"cuont\": 1}]"),
            "c.json:1:35 (/points/0/cuont): unknown parameter \"cuont\"; did you mean \"count\"?");
  EXPECT_EQ(with_points("[{\"count\": 10}]"),
            "c.json:1:44 (/points/0/count): found 10; expected an integer from 1 to 9");
  EXPECT_EQ(
      with_points("[{\"count\": [1, 2]}]"),
      "c.json:1:44 (/points/0/count): found [1,2]; expected an integer from 1 to 9; a list of values belongs "
      "in \"sweep\"");
  EXPECT_EQ(with_points("[{\"count\": 1, \"length\": 2}, {\"length\": 2.0, \"count\": 1}]"),
            "c.json:1:61 (/points/1): this point stands in the list before, at c.json:1:34 (/points/0)");
  EXPECT_EQ(with_points("[{\"count\": 1}]", ", \"sweep\": {\"count\": [2]}"),
            "c.json:1:35 (/points/0/count): the parameter \"count\" stands in \"sweep\" too, at c.json:1:59 "
            "(/sweep/count)");
  EXPECT_EQ(
      with_points("[{\"count\": 1}, {\"count\": 2}]", ", \"parameters\": {\"count\": 3}"),
      "c.json:1:78 (/parameters/count): every point of \"points\" gives the parameter \"count\", so this "
      "would have no effect");
  EXPECT_EQ(
      with_points("[{\"count\": 1}, {}]"),
      "c.json:1:1: the parameter \"count\" has no default: \"parameters\" or \"sweep\" must give it (an "
      "integer from 1 to 9)");
}

TEST_F(ConfigTest, ExplainsWrongOverridesOfScenes) {
  const auto with_scenes = [&](const std::string& object, const std::string& more = "") {
    return problem(
        "{\"experiment\": \"staged\", \"parameters\": {\"scene\": \"hall\", \"count\": 1},\n \"scenes\": " +
        object + more + "}");
  };
  EXPECT_EQ(
      with_scenes("{\"hlal\": {}}"),
      "c.json:2:13 (/scenes/hlal): \"hlal\" is not among the scenes of this config; did you mean \"hall\"?");
  EXPECT_EQ(with_scenes("[]"),
            "c.json:2:12 (/scenes): found []; expected an object {...} with a scene's name for each key");
  EXPECT_EQ(with_scenes("{\"hall\": 1}"), "c.json:2:21 (/scenes/hall): found 1; expected an object {...}");
  EXPECT_EQ(with_scenes("{\"hall\": {\"lenght\": 1}}"),
            "c.json:2:22 (/scenes/hall/lenght): unknown parameter \"lenght\"; did you mean \"length\"?");
  EXPECT_EQ(with_scenes("{\"hall\": {\"length\": -1}}"),
            "c.json:2:32 (/scenes/hall/length): found -1; expected a number of at least 0 m");
  EXPECT_EQ(with_scenes("{\"hall\": {\"scene\": \"hall\"}}"),
            "c.json:2:22 (/scenes/hall/scene): the scene is named by the key of these parameters already");
  EXPECT_EQ(
      with_scenes("{\"hall\": {\"length\": 1}}", ", \"sweep\": {\"length\": [2]}"),
      "c.json:2:22 (/scenes/hall/length): the parameter \"length\" stands in \"sweep\" too, at c.json:2:47 "
      "(/sweep/length)");
  EXPECT_EQ(
      with_scenes("{\"hall\": {\"length\": 1}}", ", \"points\": [{\"length\": 2}]"),
      "c.json:2:22 (/scenes/hall/length): every point of \"points\" gives the parameter \"length\", so this "
      "would have no effect");
  EXPECT_EQ(problem("{\"experiment\": \"toy\", \"scenes\": {}}"),
            "c.json:1:23 (/scenes): the experiment \"toy\" has no scenes");
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
      R"({"$schema": "s", "experiment": "staged", "seed": 7, "parameters": {"count": 2},
    "points": [{"behaviour": "nan"}, {}], "scenes": {"a": {"camera": "x"}}, "sweep": {"resolution": ["8x8", "9x9"],
    "scene": ["b", "a"], "loud": [true], "length": {"from": 1, "to": 4, "step": 1.5}}, "optional_scenes": ["b"],
    "gates": [{"name": "n", "column": "doubled_m", "where": {"count": [1, 2], "note": "x"}, "min": 0, "max": 1,
    "baseline": {"worse_by_at_most": 0.1, "relative": true, "better": "lower"}}]})";
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

TEST_F(ConfigTest, MakesASweepOfSeveralValuesFromTheCommandLine) {
  const std::string text =
      R"({"experiment": "toy", "parameters": {"length": 3}, "sweep": {"count": [1, 2], "loud": [false, true]}})";
  const Config config = load(text, {"length=1,2", "count=[3,4,5]"});
  ASSERT_EQ(config.sweep.size(), 3u);
  EXPECT_EQ(config.sweep[0].parameter->name, "count") << "a sweep stays in its place";
  EXPECT_EQ(config.sweep[0].values, (std::vector<Value>{int64_t{3}, int64_t{4}, int64_t{5}}));
  EXPECT_EQ(config.sweep[2].parameter->name, "length") << "a new one varies fastest";
  EXPECT_EQ(config.sweep[2].values, (std::vector<Value>{1.0, 2.0}));
  EXPECT_EQ(load(text, {"length=1,2", "length=4"}).sweep.size(), 2u) << "the last one counts";
}

TEST_F(ConfigTest, LetsTheCommandLineReplaceWhatPointsAndScenesGive) {
  const std::string text = R"({"experiment": "staged", "parameters": {"scene": "a"},
    "points": [{"count": 1, "length": 1}, {"count": 2, "length": 1}, {"count": 2, "length": 2}],
    "scenes": {"a": {"loud": true, "camera": "x"}}})";
  const Config fixed = load(text, {"count=7", "loud=false"});
  ASSERT_EQ(fixed.points.size(), 2u) << "points that are then equal become one";
  EXPECT_EQ(fixed.points[0].size(), 1u);
  EXPECT_EQ(fixed.points[0][0].value, Value(1.0));
  EXPECT_EQ(fixed.points[1][0].value, Value(2.0));
  EXPECT_EQ(fixed.setting("count").values, std::vector<Value>{int64_t{7}});
  EXPECT_EQ(fixed.scene_overrides.at("a").size(), 1u);
  EXPECT_EQ(fixed.setting("loud").values, std::vector<Value>{false});

  const Config swept = load(text, {"count=3,4"});
  EXPECT_EQ(swept.points.size(), 2u);
  EXPECT_EQ(swept.setting("count").values, (std::vector<Value>{int64_t{3}, int64_t{4}}));
  EXPECT_EQ(load(text, {"count=3", "length=1"}).points.size(), 1u);
}

TEST_F(ConfigTest, ExplainsWrongAssignments) {
  const std::string good = R"({"experiment": "toy", "parameters": {"count": 3}})";
  EXPECT_EQ(problem(good, {"cuont=1"}),
            "--set cuont=1: unknown parameter \"cuont\"; did you mean \"count\"?");
  EXPECT_EQ(problem(good, {"count=11"}), "--set count=11: found 11; expected an integer from 1 to 9");
  EXPECT_EQ(problem(good, {"count"}), "--set count: expected KEY=VALUE");
  EXPECT_EQ(problem(good, {"count=1,10"}), "--set count=1,10: found 10; expected an integer from 1 to 9");
  EXPECT_EQ(
      problem(R"({"experiment": "staged", "parameters": {"count": 3, "scene": "a"}})", {"camera=*,x"}),
      "--set camera=*,x: \"*\" stands for every camera of the scene, so it must be the only value here");
  EXPECT_EQ(problem(good, {"seed=x"}),
            "--set seed=x: found \"x\"; expected an integer from 0 to 9007199254740991");
}

}  // namespace
}  // namespace hybray
