// Resuming: what a run takes over, and that no moment at which a run may be killed loses or invents a row.
#include "harness/sweep/run_record.h"

#include "core/base/error.h"
#include "harness/table/csv.h"
#include "tests/harness/support/toy_run.h"

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Names = std::vector<std::string>;

const std::string kSix = R"({"experiment": "toy", "sweep": {"count": [6, 1, 5, 2, 4, 3]}})";
const Names kComplete = {"c.csv", "manifest.json"};

class RunRecordTest : public test::ToyRunTest {
 protected:
  nlohmann::json manifest(const std::string& file = "out/manifest.json") const {
    return nlohmann::json::parse(content(file));
  }

  // The table of a run that nothing interrupts.
  std::string whole_table(const std::string& config) {
    run(config, {.folder = "whole"});
    return content("whole/c.csv");
  }
};

TEST_F(RunRecordTest, ComputesOnlyWhatAStoppedRunLeftUndone) {
  const std::string expected = whole_table(kSix);
  run(kSix, {.stop_after = 4});
  EXPECT_EQ(files(), (Names{"c.csv.partial", "manifest.json.partial"}));
  const RunResult result = run(kSix);
  EXPECT_EQ(computed_, (Names{sweep_.points[4].id, sweep_.points[5].id}));
  EXPECT_EQ(result.reused, 4u);
  EXPECT_EQ(result.done, 6u);
  EXPECT_EQ(content("out/c.csv"), expected);
  EXPECT_EQ(files(), kComplete);
}

TEST_F(RunRecordTest, ComputesNothingWhenEveryRowIsThere) {
  run(kSix);
  const std::string table = content("out/c.csv");
  EXPECT_EQ(run(kSix).reused, 6u);
  EXPECT_EQ(computed_, Names{});
  EXPECT_EQ(content("out/c.csv"), table);
  EXPECT_EQ(remarks_, Names{});
}

TEST_F(RunRecordTest, TakesOverTheCompleteTableWhenTheConfigGrew) {
  run(R"({"experiment": "toy", "sweep": {"count": [6, 5, 4]}})");
  EXPECT_EQ(run(kSix).reused, 3u);
  EXPECT_EQ(computed_.size(), 3u);
  EXPECT_EQ(content("out/c.csv"), whole_table(kSix));
}

TEST_F(RunRecordTest, KeepsTheRowsOfPointsThatThisRunDoesNotHave) {
  run(kSix);
  run(R"({"experiment": "toy", "parameters": {"count": 5}})");
  EXPECT_EQ(read_csv(folder_ / "out/c.csv").rows.size(), 1u) << "the table has the run's points only";
  EXPECT_EQ(files(), (Names{"c.csv", "c.csv.partial", "manifest.json", "manifest.json.partial"}));
  EXPECT_EQ(run(kSix).reused, 6u);
  EXPECT_EQ(files(), kComplete);
  EXPECT_EQ(content("out/c.csv"), whole_table(kSix));
}

TEST_F(RunRecordTest, DropsATornLastLineWhereverItWasTorn) {
  const std::string expected = whole_table(kSix);
  run(kSix, {.stop_after = 3});
  const std::string partial = content("out/c.csv.partial"),
                    manifest_text = content("out/manifest.json.partial");
  const size_t last_row = partial.rfind('\n', partial.size() - 2) + 1;
  for (size_t length = 0; length < partial.size(); ++length) {
    folder_.write("torn/c.csv.partial", partial.substr(0, length));
    folder_.write("torn/manifest.json.partial", manifest_text);
    const size_t whole = static_cast<size_t>(std::max<std::ptrdiff_t>(
        std::count(partial.begin(), partial.begin() + static_cast<ptrdiff_t>(length), '\n') - 1, 0));
    EXPECT_EQ(run(kSix, {.folder = "torn"}).reused, whole) << length;
    EXPECT_EQ(content("torn/c.csv"), expected) << length;
    std::filesystem::remove_all(folder_ / "torn");
  }
  EXPECT_EQ(std::count(partial.begin() + static_cast<ptrdiff_t>(last_row), partial.end(), '\n'), 1);
}

TEST_F(RunRecordTest, EndsWellFromEveryStateThatAKillAtTheEndLeaves) {
  const std::string expected = whole_table(kSix);
  // An older complete table of other points stands there; the new run has stopped just before its end.
  const auto prepare = [&](const std::string& folder) {
    run(R"({"experiment": "toy", "sweep": {"count": [7, 8]}})", {.folder = folder});
    run(kSix, {.stop_after = 5, .folder = folder});
    // As the last point has its row, and nothing else has happened yet:
    const std::string line = expected.substr(expected.rfind('\n', expected.size() - 2) + 1);
    std::ofstream(folder_ / folder / "c.csv.partial", std::ios::app) << line;
  };
  prepare("a");
  EXPECT_EQ(run(kSix, {.folder = "a"}).reused, 6u);

  prepare("b");  // the table is renamed into place, its manifest is not
  folder_.write("b/c.csv", expected);
  EXPECT_EQ(run(kSix, {.folder = "b"}).reused, 6u);

  prepare("c");  // both are, the growing files still stand
  folder_.write("c/c.csv", expected);
  folder_.write("c/manifest.json", content("a/manifest.json"));
  EXPECT_EQ(run(kSix, {.folder = "c"}).reused, 6u);

  prepare("d");  // only the growing manifest is gone
  folder_.write("d/c.csv", expected);
  folder_.write("d/manifest.json", content("a/manifest.json"));
  std::filesystem::remove(folder_ / "d/manifest.json.partial");
  EXPECT_EQ(run(kSix, {.folder = "d"}).reused, 6u);

  for (const char* folder : {"a", "b", "c", "d"})
    EXPECT_EQ(test::content_of(folder_ / folder / "c.csv"), expected) << folder;
}

TEST_F(RunRecordTest, EndsWellFromEveryStateThatAKillAtTheStartLeaves) {
  const std::string expected = whole_table(kSix);
  // The growing manifest is written, the growing table not yet; with and without a complete table.
  run(kSix, {.stop_after = 2});
  std::filesystem::remove(folder_ / "out/c.csv.partial");
  EXPECT_EQ(run(kSix).reused, 0u);
  EXPECT_EQ(content("out/c.csv"), expected);
  folder_.write("out/manifest.json.partial", content("out/manifest.json"));
  EXPECT_EQ(run(kSix).reused, 6u);
  EXPECT_EQ(content("out/c.csv"), expected);
  EXPECT_EQ(files(), kComplete);
}

TEST_F(RunRecordTest, StartsOverWhenToldSoAndGoesOnSoWhenInterrupted) {
  run(kSix);
  const std::string table = content("out/c.csv");
  run(kSix, {.stop_after = 2, .fresh = true});
  EXPECT_EQ(computed_.size(), 2u);
  EXPECT_EQ(content("out/c.csv"), table) << "the earlier table stays until the new one is complete";
  EXPECT_EQ(run(kSix).reused, 2u) << "the old table's rows are not wanted";
  EXPECT_EQ(computed_.size(), 4u);
  EXPECT_EQ(content("out/c.csv"), table);
  EXPECT_EQ(run(kSix).reused, 6u);
}

TEST_F(RunRecordTest, TakesOverNoRowThatThisRunWouldHaveMadeOtherwise) {
  run(kSix);
  EXPECT_EQ(run(kSix, {.timing = false}).reused, 0u);
  EXPECT_EQ(remarks_, Names{"the 6 rows of " + (folder_ / "out/c.csv").string() +
                            " are not taken over: it was made with another: timing"});
  EXPECT_EQ(run(kSix, {.timing = false, .threads = 2}).reused, 0u);
  EXPECT_EQ(remarks_.at(0).substr(remarks_.at(0).rfind(':')), ": threads");
  EXPECT_EQ(run(R"({"experiment": "toy", "seed": 2, "sweep": {"count": [6, 1]}})").reused, 0u);
  EXPECT_EQ(run(R"({"experiment": "toy", "parameters": {"length": 2}, "sweep": {"count": [6, 1]}})").reused,
            0u);
}

TEST_F(RunRecordTest, TakesOverNoRowOfAnotherProgramOrOfAChangedTable) {
  run(kSix);
  nlohmann::json other = manifest();
  other["row_origin"]["program"] = "0123456789abcdef";
  folder_.write("out/manifest.json", other.dump());
  EXPECT_EQ(run(kSix).reused, 0u);
  EXPECT_EQ(remarks_.at(0).substr(remarks_.at(0).rfind(':')), ": program");

  std::string table = content("out/c.csv");
  table[table.find(",6,") + 1] = '9';
  folder_.write("out/c.csv", table);
  EXPECT_EQ(run(kSix).reused, 0u);
  EXPECT_NE(remarks_.at(0).find("it is not as its manifest describes it"), std::string::npos);
  EXPECT_EQ(content("out/c.csv"), whole_table(kSix));
}

TEST_F(RunRecordTest, SetsGrowingRowsOfAnotherOriginAsideInsteadOfDeletingThem) {
  run(kSix, {.stop_after = 4});
  const std::string partial = content("out/c.csv.partial");
  run(kSix, {.timing = false});
  EXPECT_EQ(computed_.size(), 6u);
  EXPECT_EQ(remarks_.size(), 2u);
  EXPECT_EQ(files(), (Names{"c.csv", "c.csv.partial.old", "manifest.json", "manifest.json.partial.old"}));
  EXPECT_EQ(content("out/c.csv.partial.old"), partial);
  // Put back, they serve again.
  rename("out/c.csv.partial.old", "out/c.csv.partial");
  rename("out/manifest.json.partial.old", "out/manifest.json.partial");
  EXPECT_EQ(run(kSix).reused, 4u);
}

TEST_F(RunRecordTest, SumsTheTimeOfAllSessionsInTheManifest) {
  const std::string slow =
      R"({"experiment": "toy", "parameters": {"behaviour": "sleep"}, "sweep": {"count": [1, 2, 3]}})";  // 0.3
                                                                                                        // s
                                                                                                        // each
  run(slow, {.stop_after = 1});
  EXPECT_EQ(manifest("out/manifest.json.partial")["run"]["complete"], false);
  EXPECT_EQ(manifest("out/manifest.json.partial")["run"]["points_done"], 1);
  run(slow, {.stop_after = 1});
  // As if this session had been killed after its row: it did not say how long it took.
  nlohmann::json killed = manifest("out/manifest.json.partial");
  killed["run"]["sessions"][1]["wall_time_s"] = nullptr;
  folder_.write("out/manifest.json.partial", killed.dump());
  run(slow);
  const auto done = manifest()["run"];
  EXPECT_EQ(done["points_done"], 3);
  EXPECT_EQ(done["points_reused"], 2);
  EXPECT_EQ(done["points_failed"], 0);
  EXPECT_EQ(done["complete"], true);
  ASSERT_EQ(done["sessions"].size(), 3u);
  double sum = 0;
  for (const auto& session : done["sessions"]) {
    EXPECT_GE(session["wall_time_s"], 0.29);
    sum += session["wall_time_s"].get<double>();
  }
  EXPECT_DOUBLE_EQ(done["wall_time_s"], sum);
}

TEST_F(RunRecordTest, RecordsFailuresWithTheirParametersUntilTheyAreMended) {
  const std::string config =
      R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"behaviour": ["plain", "fragile"]}})";
  folder_.write("out/hammer", "");
  run(config);
  auto failures = manifest()["run"]["failures"];
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0]["id"], sweep_.points[1].id);
  EXPECT_EQ(failures[0]["message"], "the toy met a hammer");
  EXPECT_EQ(failures[0]["parameters"]["behaviour"], "fragile");
  EXPECT_EQ(manifest()["run"]["complete"], false);
  std::filesystem::remove(folder_ / "out/hammer");
  run(config);
  EXPECT_EQ(manifest()["run"]["failures"].size(), 0u);
  EXPECT_EQ(manifest()["run"]["complete"], true);
}

TEST_F(RunRecordTest, GivesAShardWithoutPointsAManifestAndNoTable) {
  run(R"({"experiment": "toy", "parameters": {"count": 1}})", {.shard = Shard{2, 2}});
  EXPECT_EQ(files(), Names{"manifest.json"});
  EXPECT_EQ(manifest()["table"]["file"], "");
  EXPECT_EQ(manifest()["shard"]["index"], 2);
  EXPECT_EQ(manifest()["run"]["points"], 0);
  EXPECT_EQ(manifest()["points"].size(), 1u);
}

TEST_F(RunRecordTest, RefusesAFolderThatHoldsAnotherTable) {
  run(kSix);
  check_folder_is_free_for(folder_ / "out", "c");
  EXPECT_EQ(test::message_of<InputError>([&] { check_folder_is_free_for(folder_ / "out", "d"); }),
            (folder_ / "out").string() +
                ": it holds c.csv, whose manifest a run of d would replace; choose another folder");
  rename("out/manifest.json", "out/manifest.json.partial");
  EXPECT_THROW(check_folder_is_free_for(folder_ / "out", "d"), InputError);
}

}  // namespace
}  // namespace hybray
