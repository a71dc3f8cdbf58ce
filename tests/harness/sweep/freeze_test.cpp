#include "harness/sweep/freeze.h"

#include "core/base/error.h"
#include "harness/sweep/memory.h"
#include "harness/sweep/run_sweep.h"
#include "tests/harness/support/toy_experiment.h"
#include "tests/temporary_folder.h"

#include <limits>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hybray {
namespace {

// What the command line asks of a sweep.
struct Asked {
  std::vector<std::string> filters;
  double memory_bytes = std::numeric_limits<double>::infinity();
  std::vector<std::string> assignments = {};
};

class FreezeTest : public ::testing::Test {
 protected:
  FreezeTest()
      : catalog_(
            [this](const std::string& name) {
              return states_.contains(name) ? states_[name] : SceneState::unknown;
            },
            [this](const std::string& name) {
              if (!facts_.contains(name)) throw InputError(name, "there is no such scene");
              ++loads_;
              return facts_[name];
            }) {}

  Config load(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return load_config(folder_.write("c.json", text), experiments_, assignments_of("--set", assignments));
  }

  FrozenSweep frozen(const std::string& text, const Asked& asked = {}) {
    config_ = load(text, asked.assignments);
    return freeze(config_, catalog_, {assignments_of("--filter", asked.filters), asked.memory_bytes});
  }

  std::vector<std::string> labels(const std::string& text, const Asked& asked = {}) {
    std::vector<std::string> result;
    const FrozenSweep sweep = frozen(text, asked);
    for (const Point& point : sweep.points) result.push_back(point_label(config_, point));
    return result;
  }

  std::string problem(const std::string& text, const Asked& asked = {}) {
    std::string message = test::message_of<InputError>([&] { frozen(text, asked); });
    const std::string folder = folder_.path().string() + "/";
    for (size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

  std::string id(const std::string& text) { return frozen(text).points.at(0).id; }

  const test::TemporaryFolder folder_;
  const std::vector<Experiment> experiments_ = test::toy_experiments();
  std::map<std::string, SceneState> states_ = {
      {"hall", SceneState::available}, {"yard", SceneState::available}, {"far", SceneState::source_missing}};
  std::map<std::string, SceneFacts> facts_ = {{"hall", {11, 100, {"door", "window"}}},
                                              {"yard", {12, 200, {"gate"}}}};
  int loads_ = 0;
  SceneCatalog catalog_;
  Config config_;
};

using Labels = std::vector<std::string>;

TEST_F(FreezeTest, VariesTheFirstKeyOfTheFileSlowest) {
  EXPECT_EQ(labels(R"({"experiment": "toy", "sweep": {"count": [2, 1], "length": [1, 2]}})"),
            (Labels{"count=2 length=1", "count=2 length=2", "count=1 length=1", "count=1 length=2"}));
  EXPECT_EQ(labels(R"({"experiment": "toy", "sweep": {"length": [1, 2], "count": [2, 1]}})"),
            (Labels{"length=1 count=2", "length=1 count=1", "length=2 count=2", "length=2 count=1"}));
}

TEST_F(FreezeTest, KeepsThePointsOfASceneTogether) {
  facts_["yard"].cameras = {"door"};
  const FrozenSweep sweep = frozen(R"({"experiment": "staged", "parameters": {"camera": "door"},
    "sweep": {"count": [1, 2], "scene": ["yard", "hall"]}})");
  Labels scenes;
  for (const Point& point : sweep.points) scenes.push_back(point.text("scene"));
  EXPECT_EQ(scenes, (Labels{"yard", "yard", "hall", "hall"}));
}

TEST_F(FreezeTest, PutsEveryCameraOfItsSceneInThePlaceOfAStar) {
  EXPECT_EQ(
      labels(
          R"({"experiment": "staged", "sweep": {"scene": ["hall", "yard"], "camera": ["*"], "count": [1, 2]}})"),
      (Labels{"scene=hall camera=door count=1", "scene=hall camera=door count=2",
              "scene=hall camera=window count=1", "scene=hall camera=window count=2",
              "scene=yard camera=gate count=1", "scene=yard camera=gate count=2"}));
  EXPECT_EQ(
      labels(R"({"experiment": "staged", "parameters": {"scene": "hall"}, "sweep": {"count": [1, 2]}})"),
      (Labels{"count=1 camera=door", "count=2 camera=door", "count=1 camera=window",
              "count=2 camera=window"}));
}

TEST_F(FreezeTest, PutsSeededCamerasInThePlaceOfTheirPattern) {
  const Labels four = {"camera=seeded/0", "camera=seeded/1", "camera=seeded/2", "camera=seeded/3"};
  const std::string head = R"({"experiment": "staged", "parameters": {"scene": "hall", "count": 1)";
  EXPECT_EQ(labels(head + R"(, "camera": "seeded*4"}})"), four);
  EXPECT_EQ(labels(head + R"(}, "sweep": {"camera": ["seeded*4"]}})"), four);
  EXPECT_EQ(labels(head + R"(}, "points": [{"camera": "seeded*4"}]})"), four);
  EXPECT_EQ(labels(head + R"(}, "sweep": {"camera": ["door", "seeded/9"]}})"),
            (Labels{"camera=door", "camera=seeded/9"}));
  EXPECT_EQ(labels(head + R"(, "camera": "seeded*64"}})", {{"camera=seeded/3", "camera=seeded*2"}}),
            (Labels{"camera=seeded/0", "camera=seeded/1", "camera=seeded/3"}));
  facts_["hall"].cameras = {};
  EXPECT_EQ(frozen(head + R"(, "camera": "seeded*64"}})").points.size(), 64u);
}

TEST_F(FreezeTest, SaysWhatASeededCameraMustLookLike) {
  const std::string head =
      R"({"experiment": "staged", "parameters": {"scene": "hall", "count": 1, "camera": )";
  for (const char* wrong : {"\"seeded/x\"", "\"seeded*0\"", "\"seeded*9999\"", "\"seeded/-1\""}) {
    const std::string message = problem(head + wrong + "}}");
    EXPECT_NE(message.find(wrong), std::string::npos) << message;
    EXPECT_NE(message.find("\"seeded/N\" (N from 0 to 999999)"), std::string::npos) << message;
  }
}

TEST_F(FreezeTest, GivesEveryPointEveryParameterAndAnIdOfItsOwn) {
  const FrozenSweep sweep =
      frozen(R"({"experiment": "staged", "parameters": {"count": 1}, "sweep": {"scene": ["hall", "yard"],
    "length": [1, 2, 3], "loud": [false, true]}})");
  ASSERT_EQ(sweep.points.size(), 18u);
  std::set<std::string> ids;
  for (const Point& point : sweep.points) {
    EXPECT_EQ(point.parameters.size(), 7u);
    EXPECT_EQ(point.id.size(), 16u);
    EXPECT_EQ(point.id.find_first_not_of("0123456789abcdef"), std::string::npos);
    ids.insert(point.id);
  }
  EXPECT_EQ(ids.size(), 18u);
}

TEST_F(FreezeTest, KeepsAnIdWhenTheFileSaysTheSameInOtherWords) {
  const std::string base = id(R"({"experiment": "toy", "parameters": {"count": 1, "length": 2}})");
  EXPECT_EQ(
      id(R"({"title": "x", "parameters": {"length": 2.0, "count": 1, "loud": false}, "experiment": "toy"})"),
      base);
  EXPECT_EQ(id(R"({"experiment": "toy", "sweep": {"length": [2, 3]}, "parameters": {"count": 1}})"), base);
  EXPECT_EQ(id(R"({"experiment": "toy", "seed": 1, "sweep": {"count": [1], "length": [2]}})"), base);
}

TEST_F(FreezeTest, ChangesTheIdWithAnyParameterTheSeedTheExperimentAndTheScene) {
  std::set<std::string> ids;
  for (const char* text :
       {R"({"experiment": "toy", "parameters": {"count": 1}})",
        R"({"experiment": "toy", "parameters": {"count": 2}})",
        R"({"experiment": "toy", "parameters": {"count": 1, "length": 0.50000000000000011}})",
        R"({"experiment": "toy", "parameters": {"count": 1, "loud": true}})",
        R"({"experiment": "toy", "parameters": {"count": 1}, "seed": 2})"}) {
    ids.insert(id(text));
  }
  const std::map<std::string, Value> same = {{"count", int64_t{1}}};
  for (const char* experiment : {"toy", "staged"}) {
    for (const uint64_t scene : {0, 1}) ids.insert(point_id(experiment, same, 1, scene));
  }
  EXPECT_EQ(ids.size(), 9u);
}

// Tables of different machines and days are joined by id, so it may not drift. The number is XXH3_64 of
// {"experiment":"toy","parameters":{"a":1,"b":0.1,"c":"x","d":true},"scene":"0123456789abcdef","seed":1}.
TEST_F(FreezeTest, KeepsItsIdsFromOneVersionToTheNext) {
  const std::map<std::string, Value> parameters = {
      {"b", 0.1}, {"a", int64_t{1}}, {"c", std::string("x")}, {"d", true}};
  EXPECT_EQ(point_id("toy", parameters, 1, 0x0123456789abcdefull), "6b95a0572ce826e8");
}

TEST_F(FreezeTest, KeepsThePointsThatPassTheFilters) {
  const std::string text = R"({"experiment": "toy", "sweep": {"count": [1, 2, 3], "length": [1, 2]}})";
  EXPECT_EQ(labels(text, {{"count=2"}}), (Labels{"count=2 length=1", "count=2 length=2"}));
  EXPECT_EQ(labels(text, {{"count=3", "length=1", "count=1"}}),
            (Labels{"count=1 length=1", "count=3 length=1"}));
  EXPECT_EQ(problem(text, {{"count=4"}}), "--filter count=4: no point of c.json matches");
  EXPECT_EQ(problem(text, {{"cuont=4"}}),
            "--filter cuont=4: unknown parameter \"cuont\"; did you mean \"count\"?");
  EXPECT_EQ(problem(text, {{"count=0"}}), "--filter count=0: found 0; expected an integer from 1 to 9");
}

TEST_F(FreezeTest, CombinesListedPointsWithTheSweep) {
  EXPECT_EQ(labels(R"({"experiment": "toy", "sweep": {"loud": [false, true]},
    "points": [{"count": 2, "length": 1}, {"count": 1, "length": 3}]})"),
            (Labels{"count=2 length=1 loud=false", "count=2 length=1 loud=true",
                    "count=1 length=3 loud=false", "count=1 length=3 loud=true"}));
}

TEST_F(FreezeTest, FillsInWhatAListedPointLeavesOut) {
  EXPECT_EQ(
      labels(
          R"({"experiment": "toy", "parameters": {"count": 5}, "points": [{}, {"count": 6}, {"length": 3}]})"),
      (Labels{"count=5 length=0.5", "count=6 length=0.5", "count=5 length=3"}));
  EXPECT_EQ(problem(R"({"experiment": "toy", "parameters": {"count": 5}, "points": [{}, {"count": 5}]})"),
            "c.json: two of \"points\" are the same, with what they leave out filled in: count=5");
}

TEST_F(FreezeTest, TakesScenesAndCamerasFromListedPoints) {
  const std::string text = R"({"experiment": "staged", "sweep": {"count": [1, 2]}, "points": [
    {"scene": "yard", "camera": "gate"}, {"scene": "hall", "camera": "*"}, {"scene": "yard", "length": 2}]})";
  EXPECT_EQ(
      labels(text, {{"count=1"}}),
      (Labels{"scene=yard camera=gate length=0.5 count=1", "scene=yard camera=gate length=2 count=1",
              "scene=hall camera=door length=0.5 count=1", "scene=hall camera=window length=0.5 count=1"}));
  EXPECT_EQ(labels(text, {{"camera=window"}}).size(), 2u);
  EXPECT_EQ(labels(text, {{}, 1e12, {"scene=hall", "camera=door"}}),
            (Labels{"length=0.5 count=1", "length=0.5 count=2", "length=2 count=1", "length=2 count=2"}));
  EXPECT_EQ(
      problem(R"({"experiment": "staged", "parameters": {"count": 1},
    "points": [{"scene": "yard", "camera": "gtae"}]})"),
      "c.json:2:44 (/points/0/camera): the scene \"yard\" has no camera \"gtae\"; did you mean \"gate\"?");
}

TEST_F(FreezeTest, KeepsPointsWithoutASceneToTheScenesOfTheSweep) {
  EXPECT_EQ(labels(R"({"experiment": "staged", "parameters": {"count": 1, "camera": "*"},
    "sweep": {"scene": ["yard", "hall"]}, "points": [{"length": 1}, {"length": 2}]})"),
            (Labels{"length=1 scene=yard camera=gate", "length=2 scene=yard camera=gate",
                    "length=1 scene=hall camera=door", "length=2 scene=hall camera=door",
                    "length=1 scene=hall camera=window", "length=2 scene=hall camera=window"}));
}

// Default < parameters < override of the scene < points and sweep < --set.
TEST_F(FreezeTest, LetsTheMoreSpecificPlaceOfAParameterWin) {
  const std::string text = R"({"experiment": "staged", "parameters": {"count": 1, "length": 2},
    "sweep": {"scene": ["hall", "yard"]}, "points": [{}, {"length": 4}],
    "scenes": {"hall": {"camera": "door", "length": 3}, "yard": {"loud": true, "count": 2}}})";
  const auto lengths_and_counts = [&](const std::vector<std::string>& assignments) {
    Labels result;
    const FrozenSweep sweep = frozen(text, {{}, 1e12, assignments});
    for (const Point& p : sweep.points)
      result.push_back(fmt::format("{}/{}/{}/{}/{}", p.text("scene"), p.text("camera"), p.integer("count"),
                                   p.number("length"), p.boolean("loud")));
    return result;
  };
  EXPECT_EQ(lengths_and_counts({}), (Labels{"hall/door/1/3/false", "hall/door/1/4/false",
                                            "yard/gate/2/2/true", "yard/gate/2/4/true"}));
  EXPECT_EQ(lengths_and_counts({"length=7"}), (Labels{"hall/door/1/7/false", "yard/gate/2/7/true"}));
  EXPECT_EQ(
      lengths_and_counts({"count=8,9", "loud=false", "length=1"}),
      (Labels{"hall/door/8/1/false", "hall/door/9/1/false", "yard/gate/8/1/false", "yard/gate/9/1/false"}));
}

TEST_F(FreezeTest, AcceptsARequiredParameterThatEverySceneGives) {
  const std::string text = R"({"experiment": "staged", "sweep": {"scene": ["hall", "yard"]},
    "scenes": {"hall": {"count": 1}, "yard": {"count": 2}}})";
  EXPECT_EQ(frozen(text).points.size(), 3u);
  EXPECT_EQ(problem(R"({"experiment": "staged", "sweep": {"scene": ["hall", "yard"]},
    "scenes": {"hall": {"count": 1}}})"),
            "c.json:1:1: the parameter \"count\" has no default: \"parameters\" or \"sweep\" must give it "
            "(an integer from 1 to 9)");
}

TEST_F(FreezeTest, GivesAPointOneIdInWhateverFormItsValuesAreGiven) {
  const std::string end = R"(, "parameters": {"scene": "yard", "camera": "gate"}})";
  const auto ids = [&](const std::string& forms, const std::vector<std::string>& assignments = {}) {
    Labels result;
    const FrozenSweep sweep = frozen(R"({"experiment": "staged", )" + forms + end, {{}, 1e12, assignments});
    for (const Point& p : sweep.points) result.push_back(p.id);
    return result;
  };
  const Labels list = ids(R"("sweep": {"count": [1, 2, 3], "length": [0.1, 0.2, 0.3]})");
  ASSERT_EQ(list.size(), 9u);
  EXPECT_EQ(
      ids(R"("sweep": {"count": {"from": 1, "to": 3, "step": 1}, "length": {"from": 0.1, "to": 0.3, "count": 3}})"),
      list);
  EXPECT_EQ(
      ids(R"("sweep": {"count": [1, 2, 3]}, "points": [{"length": 0.1}, {"length": 0.2}, {"length": 0.3}])")
          .size(),
      9u);
  EXPECT_EQ(
      ids(R"("points": [{"count": 1}, {"count": 2}, {"count": 3}], "sweep": {"length": [0.1, 0.2, 0.3]})"),
      list);
  EXPECT_EQ(
      ids(R"("points": [{"count": 1}, {"count": 2}, {"count": 3}], "scenes": {"yard": {"length": 0.2}})"),
      (Labels{list[1], list[4], list[7]}));
  EXPECT_EQ(
      ids(R"("sweep": {"count": [1]})", {"count=1,2,3", R"(length={"from": 0.1, "to": 0.3, "step": 0.1})"}),
      list);
  EXPECT_EQ(ids(R"("sweep": {"count": [1, 2, 3], "length": {"from": 0.3, "to": -0.0, "step": -0.3}})"),
            ids(R"("sweep": {"count": [1, 2, 3], "length": [0.3, 0]})"))
      << "-0 is 0";
}

TEST_F(FreezeTest, FiltersByAnyOfSeveralValuesAndByWhatPointsGive) {
  const std::string text =
      R"({"experiment": "toy", "points": [{"count": 1, "length": 2}, {"count": 2, "length": 0.3},
    {"count": 3}], "sweep": {"loud": [false, true]}})";
  EXPECT_EQ(labels(text, {{"count=1,3", "loud=true"}}),
            (Labels{"count=1 length=2 loud=true", "count=3 length=0.5 loud=true"}));
  EXPECT_EQ(labels(text, {{R"(length={"from": 0.1, "to": 0.5, "step": 0.2})", "loud=true"}}),
            (Labels{"count=2 length=0.3 loud=true", "count=3 length=0.5 loud=true"}));
}

TEST_F(FreezeTest, RefusesMorePointsThanAnybodyMeans) {
  EXPECT_EQ(problem(R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {
    "length": {"from": 1, "to": 10000, "count": 10000}, "loud": [false, true],
    "behaviour": ["plain", "throw", "nan", "sleep"], "resolution": ["1x1", "2x2"]}})"),
            "c.json: it has 160000 points; expected at most 100000");
}

TEST_F(FreezeTest, FiltersTheCamerasThatAStarStandsFor) {
  EXPECT_EQ(
      labels(R"({"experiment": "staged", "parameters": {"count": 1}, "sweep": {"scene": ["hall", "yard"]}})",
             {{"camera=window"}}),
      Labels{"scene=hall camera=window"});
}

TEST_F(FreezeTest, LoadsNoSceneThatTheFiltersTakeOut) {
  frozen(
      R"({"experiment": "staged", "parameters": {"count": 1}, "sweep": {"scene": ["nowhere", "hall", "yard"]}})",
      {{"scene=yard"}});
  EXPECT_EQ(loads_, 1);
}

TEST_F(FreezeTest, LeavesOutOptionalScenesWithoutASourceAndCountsTheirPoints) {
  const FrozenSweep sweep =
      frozen(R"({"experiment": "staged", "sweep": {"scene": ["far", "yard"], "count": [1, 2]},
    "optional_scenes": ["far"]})");
  EXPECT_EQ(sweep.points.size(), 2u);
  ASSERT_EQ(sweep.skipped.size(), 1u);
  EXPECT_EQ(sweep.skipped[0].scene, "far");
  EXPECT_EQ(sweep.skipped[0].points, 2u);
  EXPECT_TRUE(sweep.skipped[0].for_each_camera);
}

TEST_F(FreezeTest, RefusesScenesAndCamerasThatAreNotThere) {
  EXPECT_EQ(
      problem(
          R"({"experiment": "staged", "parameters": {"count": 1}, "sweep": {"scene": ["yard", "nowhere"]}})"),
      "c.json:1:82 (/sweep/scene/1): nowhere: there is no such scene");
  EXPECT_EQ(
      problem(R"({"experiment": "staged", "parameters": {"count": 1, "scene": "hall", "camera": "widnow"}})"),
      "c.json:1:80 (/parameters/camera): the scene \"hall\" has no camera \"widnow\"; did you mean "
      "\"window\"?");
  facts_["yard"].cameras.clear();
  EXPECT_EQ(
      problem(R"({"experiment": "staged", "parameters": {"count": 1, "scene": "yard", "camera": "*"}})"),
      "c.json:1:80 (/parameters/camera): \"*\" stands for no camera: the scene \"yard\" has none");
}

TEST_F(FreezeTest, RefusesASceneWithTwoCamerasOfOneName) {
  facts_["yard"].cameras = {"gate", "gate"};
  EXPECT_EQ(problem(R"({"experiment": "staged", "parameters": {"count": 1, "scene": "yard"}})"),
            "c.json: two points of the sweep are the same; has a scene two cameras of one name?");
}

TEST_F(FreezeTest, DoesNotTakeAMisspeltOptionalSceneForAMissingOne) {
  EXPECT_EQ(
      problem(
          R"({"experiment": "staged", "parameters": {"count": 1, "scene": "nowhere"}, "optional_scenes": ["nowhere"]})"),
      "c.json:1:62 (/parameters/scene): nowhere: there is no such scene");
}

TEST_F(FreezeTest, RefusesAPointThatNeedsMoreMemoryBeforeAnySceneIsLoaded) {
  const std::string text = R"({"experiment": "staged", "parameters": {"scene": "hall", "count": 1},
 "sweep": {"resolution": ["8x8", "1000x1000"]}})";
  EXPECT_EQ(problem(text, {{}, 1e9}),
            "c.json:2:34 (/sweep/resolution/1): the resolution \"1000x1000\" needs about 9.1 TiB of "
            "memory; 954 MiB are available");
  EXPECT_EQ(loads_, 0);
  EXPECT_EQ(labels(text, {{"resolution=8x8"}, 1e9}).size(), 2u)
      << "a point that is filtered out needs no memory";
}

TEST(Memory, IsThereAndReadsWell) {
  EXPECT_GT(available_memory_bytes(), 1e6);
  EXPECT_LT(available_memory_bytes(), 1e15);
  EXPECT_EQ(format_bytes(0), "0 B");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
  EXPECT_EQ(format_bytes(23.0 * 1024 * 1024 * 1024), "23 GiB");
}

}  // namespace
}  // namespace hybray
