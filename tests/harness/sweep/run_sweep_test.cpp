#include "harness/sweep/run_sweep.h"

#include "harness/table/csv.h"
#include "tests/harness/support/toy_run.h"

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class RunSweepTest : public test::ToyRunTest {};

TEST_F(RunSweepTest, WritesARowForEveryPointInFrozenOrder) {
  const RunResult result = run(R"({"experiment": "toy", "sweep": {"count": [3, 1, 2]}})");
  EXPECT_EQ(result.done, 3u);
  EXPECT_EQ(result.reused, 0u);
  const CsvTable table = read_csv(folder_ / "out/c.csv");
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
  const CsvTable table = read_csv(folder_ / "out/c.csv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][0], sweep_.points[0].id);
  EXPECT_EQ(table.rows[1][0], sweep_.points[3].id);
}

TEST_F(RunSweepTest, LeavesTimeColumnsEmptyWithoutTiming) {
  run(R"({"experiment": "toy", "parameters": {"count": 1}})", {.timing = false});
  EXPECT_EQ(read_csv(folder_ / "out/c.csv").rows.at(0).at(5), "");
}

TEST_F(RunSweepTest, KeepsTheRowsOfAStoppedRunAndTheTableOfAnEarlierOne) {
  folder_.write("out/c.csv", "old\n");
  const RunResult result = run(R"({"experiment": "toy", "sweep": {"count": [1, 2, 3]}})", {.stop_after = 2});
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.table, folder_ / "out/c.csv.partial");
  EXPECT_EQ(read_csv(folder_ / "out/c.csv.partial").rows.size(), 2u);
  EXPECT_EQ(content("out/c.csv"), "old\n");
}

TEST_F(RunSweepTest, IsNotStoppedByAWishThatComesAfterTheLastPoint) {
  EXPECT_FALSE(run(R"({"experiment": "toy", "sweep": {"count": [1, 2]}})", {.stop_after = 2}).stopped);
  EXPECT_EQ(read_csv(folder_ / "out/c.csv").rows.size(), 2u);
}

TEST_F(RunSweepTest, IsStoppedBeforeItsFirstPointByAWishThatCameEarlier) {
  EXPECT_TRUE(run(R"({"experiment": "toy", "sweep": {"count": [1, 2]}})", {.stop_after = 0}).stopped);
  EXPECT_EQ(computed_.size(), 0u);
  EXPECT_EQ(files(), std::vector<std::string>{}) << "nothing was done, nothing is left";
}

TEST_F(RunSweepTest, TriesOnlyTheFailedPointsAgain) {
  const std::string config =
      R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"behaviour": ["plain", "fragile", "sleep"]}})";
  folder_.write("out/hammer", "");
  EXPECT_EQ(run(config).failed, 1u);
  EXPECT_EQ(run(config).failed, 1u) << "a failed point does not count as done";
  EXPECT_EQ(computed_.size(), 0u);
  std::filesystem::remove(folder_ / "out/hammer");
  const RunResult result = run(config);
  EXPECT_EQ(result.failed, 0u);
  EXPECT_EQ(result.done, 3u);
  EXPECT_EQ(result.reused, 2u);
  EXPECT_EQ(computed_, std::vector<std::string>{sweep_.points[1].id});
  EXPECT_EQ(read_csv(folder_ / "out/c.csv").rows.at(1).at(0), sweep_.points[1].id) << "in frozen order";
}

TEST_F(RunSweepTest, LeavesNothingBehindWhenEveryPointFails) {
  const std::string config = R"({"experiment": "toy", "parameters": {"count": 1, "behaviour": "throw"}})";
  EXPECT_EQ(run(config).failed, 1u);
  EXPECT_EQ(files(), std::vector<std::string>{});
  folder_.write("out/c.csv", "old\n");
  EXPECT_EQ(run(config).failed, 1u);
  EXPECT_EQ(files(), std::vector<std::string>{"c.csv"});
  EXPECT_EQ(content("out/c.csv"), "old\n");
}

TEST_F(RunSweepTest, PutsPointsRangesAndOverridesIntoTheManifest) {
  const RunResult result = run(R"({"experiment": "toy", "points": [{"count": 1}, {"count": 2, "loud": true}],
    "sweep": {"length": {"from": 1, "to": 2, "step": 0.5}}})");
  EXPECT_EQ(result.done, 6u);
  const auto config = nlohmann::json::parse(content("out/manifest.json"))["config"];
  EXPECT_EQ(config["points"], nlohmann::json::parse(R"([{"count": 1}, {"count": 2, "loud": true}])"));
  EXPECT_EQ(config["sweep"]["length"], (nlohmann::json{1.0, 1.5, 2.0})) << "as the values that it came to";
  EXPECT_FALSE(config["parameters"].contains("count")) << "every point gives it";
  EXPECT_EQ(config["parameters"]["loud"], false) << "what the first point leaves out";
}

}  // namespace
}  // namespace hybray
