#include "harness/sweep/run_sweep.h"

#include "harness/sweep/manifest.h"
#include "harness/table/csv.h"
#include "tests/harness/support/toy_experiment.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class RunSweepTest : public ::testing::Test {
 protected:
  RunSweepTest() : catalog_([](const std::string&) { return SceneState::unknown; }, {}) {}

  RunResult run(const std::string& text, bool timing = true, size_t stop_after = 1000) {
    config_ = load_config(folder_.write("c.json", text), experiments_);
    sweep_ = freeze(config_, catalog_);
    Workspace workspace({{}, folder_.path(), 1, timing, 0});
    size_t finished = 0;
    failures_.clear();
    return run_sweep(config_, sweep_, workspace,
                     {[](size_t, const Point&) {}, [&](size_t, const Point&) { ++finished; },
                      [&](size_t, const Point&, const std::string& message) { failures_.push_back(message); },
                      [&] { return finished >= stop_after; }});
  }

  const test::TemporaryFolder folder_;
  const std::vector<Experiment> experiments_ = test::toy_experiments();
  SceneCatalog catalog_;
  Config config_;
  FrozenSweep sweep_;
  std::vector<std::string> failures_;
};

TEST_F(RunSweepTest, WritesARowForEveryPointInFrozenOrder) {
  const RunResult result = run(R"({"experiment": "toy", "sweep": {"count": [3, 1, 2]}})");
  EXPECT_EQ(result.done, 3u);
  const CsvTable table = read_csv(folder_ / "c.csv");
  EXPECT_EQ(table.header, (std::vector<std::string>{"id", "count", "doubled_m", "note", "absent", "toy_ms"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{sweep_.points[0].id, "3", "1", "a \"quoted\", word", "", "1.5"}));
  EXPECT_EQ(table.rows[1][1], "1");
  EXPECT_EQ(table.rows[2][1], "2");
}

TEST_F(RunSweepTest, GoesOnAfterAPointThatFails) {
  const RunResult result = run(
      R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"behaviour": ["plain", "throw", "nan", "sleep"]}})");
  EXPECT_EQ(result.done, 2u);
  EXPECT_EQ(result.failed, 2u);
  EXPECT_EQ(failures_, (std::vector<std::string>{
                           "the toy broke", "column \"doubled_m\" came out as a number that is not finite"}));
  const CsvTable table = read_csv(folder_ / "c.csv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][0], sweep_.points[0].id);
  EXPECT_EQ(table.rows[1][0], sweep_.points[3].id);
}

TEST_F(RunSweepTest, LeavesTimeColumnsEmptyWithoutTiming) {
  run(R"({"experiment": "toy", "parameters": {"count": 1}})", false);
  EXPECT_EQ(read_csv(folder_ / "c.csv").rows.at(0).at(5), "");
}

TEST_F(RunSweepTest, KeepsTheRowsOfAStoppedRunAndTheTableOfAnEarlierOne) {
  folder_.write("c.csv", "old\n");
  const RunResult result = run(R"({"experiment": "toy", "sweep": {"count": [1, 2, 3]}})", true, 2);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.table, folder_ / "c.csv.partial");
  EXPECT_EQ(read_csv(folder_ / "c.csv.partial").rows.size(), 2u);
  EXPECT_EQ(test::content_of(folder_ / "c.csv"), "old\n");
}

TEST_F(RunSweepTest, IsNotStoppedByAWishThatComesAfterTheLastPoint) {
  EXPECT_FALSE(run(R"({"experiment": "toy", "sweep": {"count": [1, 2]}})", true, 2).stopped);
  EXPECT_EQ(read_csv(folder_ / "c.csv").rows.size(), 2u);
}

TEST_F(RunSweepTest, KeepsTheTableOfAnEarlierRunWhenEveryPointFails) {
  folder_.write("c.csv", "old\n");
  const RunResult result = run(R"({"experiment": "toy", "parameters": {"count": 1, "behaviour": "throw"}})");
  EXPECT_EQ(result.failed, 1u);
  EXPECT_EQ(test::content_of(folder_ / "c.csv"), "old\n");
}

TEST_F(RunSweepTest, PutsIntoTheManifestWhatMadeTheTable) {
  const RunResult result = run(
      R"({"experiment": "toy", "title": "T", "seed": 4, "parameters": {"loud": true}, "sweep": {"count": [1, 2]}})");
  const auto manifest =
      nlohmann::json::parse(manifest_text(config_, sweep_, result, {{"loud=true"}, {}, true, 2}));
  EXPECT_EQ(manifest["config"]["file"], "c.json") << "without its folder";
  EXPECT_EQ(manifest["config"]["experiment"], "toy");
  EXPECT_EQ(manifest["config"]["seed"], 4);
  EXPECT_EQ(manifest["config"]["parameters"]["loud"], true);
  EXPECT_EQ(manifest["config"]["parameters"]["length"], 0.5) << "defaults are written out";
  EXPECT_EQ(manifest["config"]["sweep"]["count"], (nlohmann::json{1, 2}));
  EXPECT_EQ(manifest["config"]["set"], nlohmann::json{"loud=true"});
  EXPECT_EQ(manifest["run"]["points"], 2);
  EXPECT_EQ(manifest["run"]["points_done"], 2);
  EXPECT_EQ(manifest["run"]["complete"], true);
  EXPECT_EQ(manifest["run"]["threads"], 2);
  EXPECT_GE(manifest["run"]["wall_time_s"], 0.0);
  EXPECT_TRUE(manifest["program"]["git_commit"] == "unknown" ||
              manifest["program"]["git_commit"].get<std::string>().size() == 40);
  EXPECT_TRUE(manifest["program"]["libraries"]["Embree"].get<std::string>().find('.') != std::string::npos);
  EXPECT_NE(manifest["machine"]["cpu"], "");
}

}  // namespace
}  // namespace hybray
