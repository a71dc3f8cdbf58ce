#include "harness/sweep/plan.h"

#include "core/base/error.h"
#include "harness/config/suite.h"
#include "tests/harness/support/toy_experiment.h"
#include "tests/temporary_folder.h"

#include <set>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class PlanTest : public ::testing::Test {
 protected:
  PlanTest()
      : catalog_([](const std::string&) { return SceneState::available; },
                 [](const std::string&) {
                   return SceneFacts{1, 10, {"door", "window"}};
                 }) {
    folder_.write("toy.json", R"({"experiment": "toy", "sweep": {"count": [1, 2], "length": [1, 2]}})");
    folder_.write(
        "staged.json",
        R"({"experiment": "staged", "parameters": {"scene": "hall", "count": 3, "camera": "door"}})");
    folder_.write("suite.json",
                  R"({"configs": ["toy.json", {"config": "staged.json", "set": {"count": [4, 5]}}]})");
  }

  Plan plan(const std::vector<std::string>& names, const std::vector<std::string>& assignments = {},
            const std::vector<std::string>& filters = {}) {
    PlanRequest request{{}, assignments, filters};
    for (const std::string& name : names) request.files.push_back((folder_ / name).string());
    return make_plan(request, experiments_, catalog_);
  }

  std::string problem(const std::vector<std::string>& names, const std::vector<std::string>& assignments = {},
                      const std::vector<std::string>& filters = {}) {
    std::string message = test::message_of<InputError>([&] { plan(names, assignments, filters); });
    const std::string folder = folder_.path().string() + "/";
    for (size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

  static std::vector<size_t> counts(const Plan& plan) {
    std::vector<size_t> counts;
    for (const PlannedConfig& planned : plan.configs) counts.push_back(planned.sweep.points.size());
    return counts;
  }

  const test::TemporaryFolder folder_;
  const std::vector<Experiment> experiments_ = test::toy_experiments();
  SceneCatalog catalog_;
};

using Counts = std::vector<size_t>;

TEST_F(PlanTest, PutsTheConfigsOfASuiteInItsPlace) {
  const Plan suite = plan({"suite.json"});
  EXPECT_FALSE(suite.is_single);
  EXPECT_EQ(counts(suite), (Counts{4, 2}));
  EXPECT_EQ(suite.configs[1].config.name, "staged");
  EXPECT_EQ(suite.configs[1].assignments, std::vector<std::string>{"count=[4,5]"});
  EXPECT_TRUE(plan({"toy.json"}).is_single);
  EXPECT_FALSE(plan({"toy.json", "staged.json"}).is_single);
  folder_.write("one.json", R"({"configs": ["toy.json"]})");
  EXPECT_FALSE(plan({"one.json"}).is_single) << "a suite has a folder for each config";
}

TEST_F(PlanTest, AppliesTheCommandLineAfterTheSuite) {
  EXPECT_EQ(counts(plan({"suite.json"}, {"count=7"})), (Counts{2, 1}));
  EXPECT_EQ(plan({"suite.json"}, {"seed=5"}).configs[1].config.seed, 5);
}

TEST_F(PlanTest, AppliesAnAssignmentToTheConfigsThatKnowTheParameter) {
  const Plan both = plan({"suite.json"}, {"camera=window"});
  EXPECT_EQ(both.configs[1].sweep.points.at(0).text("camera"), "window");
  EXPECT_TRUE(both.configs[0].assignments.empty());
  EXPECT_EQ(problem({"suite.json"}, {"cmaera=window"}),
            "--set cmaera=window: unknown parameter \"cmaera\"; did you mean \"camera\"?");
  EXPECT_EQ(problem({"toy.json"}, {"camera=window"}),
            "--set camera=window: unknown parameter \"camera\"; known are: count, length, loud, behaviour, "
            "resolution");
}

TEST_F(PlanTest, LeavesConfigsWithoutPointsThatNoFilterLetsPass) {
  EXPECT_EQ(counts(plan({"suite.json"}, {}, {"count=1"})), (Counts{2, 0}));
  EXPECT_EQ(counts(plan({"suite.json"}, {}, {"camera=door"})), (Counts{0, 2}));
  folder_.write("s.json", R"({"configs": [{"config": "toy.json", "filter": {"count": 1, "length": 2}}]})");
  EXPECT_EQ(counts(plan({"s.json"}, {}, {"length=2", "length=1"})), Counts{1})
      << "the command line narrows what the suite leaves";
  EXPECT_EQ(problem({"suite.json"}, {}, {"count=9"}),
            "--filter count=9: no point of any of the configs matches");
  EXPECT_EQ(problem({"toy.json"}, {}, {"count=9"}), "--filter count=9: no point of toy.json matches");
  EXPECT_EQ(problem({"suite.json"}, {}, {"cmaera=door"}),
            "--filter cmaera=door: unknown parameter \"cmaera\"; did you mean \"camera\"?");
}

TEST_F(PlanTest, NamesThePlaceInASuiteForWhatDoesNotFitItsConfig) {
  folder_.write("s.json", R"({"configs": [{"config": "toy.json", "set": {"cuont": 1}}]})");
  EXPECT_EQ(problem({"s.json"}),
            "s.json:1:54 (/configs/0/set/cuont): unknown parameter \"cuont\"; did you mean \"count\"?");
  folder_.write("s.json", R"({"configs": [{"config": "toy.json", "set": {"count": 0}}]})");
  EXPECT_EQ(problem({"s.json"}),
            "s.json:1:54 (/configs/0/set/count): found 0; expected an integer from 1 to 9");
  folder_.write("s.json", R"({"configs": ["staged.json", {"config": "toy.json", "filter": {"count": 9}}]})");
  EXPECT_EQ(problem({"s.json"}), "s.json:1:72 (/configs/1/filter/count): no point of toy.json matches");
}

TEST_F(PlanTest, RefusesASuiteInASuite) {
  folder_.write("s.json", R"({"configs": ["toy.json", "suite.json"]})");
  EXPECT_EQ(problem({"s.json"}),
            "s.json:1:26 (/configs/1): suite.json is a suite itself; a suite lists configs only");
}

TEST(CheckedInConfigs, AreGoodAndTheSuiteOfAllHasEveryTableAndFigure) {
  const std::filesystem::path folder = HYBRAY_PROJECT_DIR "/configs";
  const std::set<std::string> beyond_the_papers{
      "ssrm_breakeven", "ssrm_distribution", "ssrm_rays",  "ssrm_layers", "ssrm_accuracy",
      "ssrm_geometry",  "ssrm_scaling",      "ssrm_speed", "stability",   "stability_caustics"};
  std::set<std::string> reproductions, listed;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".json") continue;
    const JsonSource source = JsonSource::read(file.path());
    if (is_suite(source)) {
      for (const SuiteEntry& entry : read_suite(source, file.path()).entries) {
        EXPECT_NO_THROW(load_config(entry.config, experiments(), entry.assignments));
        if (file.path().stem() == "all") listed.insert(entry.config.stem().string());
      }
      continue;
    }
    const Config config = load_config(file.path(), experiments());
    if (!config.name.ends_with("quickstart") && !beyond_the_papers.contains(config.name))
      reproductions.insert(config.name);
  }
  EXPECT_EQ(listed, reproductions);
}

TEST(EstimatedSeconds, CountWhatPointsShareForTheFirstOfThem) {
  Experiment experiment = test::toy_experiments()[1];
  experiment.cost_seconds = [](const Point& point, const SceneFacts& facts) {
    return static_cast<double>(point.integer("count")) + static_cast<double>(facts.triangles);
  };
  experiment.shared_costs = [](const Point& point, const SceneFacts&) {
    return std::vector<SharedCost>{{"scene " + point.text("scene"), 100.0}, {"all", 1000.0}};
  };
  FrozenSweep sweep;
  for (const char* scene : {"a", "b"}) {
    sweep.scenes[scene] = {0, 10, {}};
    for (const int64_t count : {1, 2}) sweep.points.push_back({"", {{"scene", scene}, {"count", count}}});
  }
  EXPECT_EQ(estimated_seconds(experiment, sweep), (std::vector<double>{1111, 12, 111, 12}));
}

}  // namespace
}  // namespace hybray
