#include "harness/sweep/merge.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "harness/table/csv.h"
#include "tests/harness/support/toy_run.h"

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

const std::string kConfig = R"({"experiment": "toy", "sweep": {"count": [6, 1, 5, 2, 4, 3]}})";

class MergeTest : public test::ToyRunTest {
 protected:
  // Runs the config in three shards, in the folders 1, 2 and 3.
  void run_shards(const std::string& config = kConfig) {
    for (int i = 1; i <= 3; ++i) run(config, {.shard = Shard{i, 3}, .folder = std::to_string(i)});
  }

  MergeResult merge(const std::vector<std::string>& names, bool allow_missing = false) {
    std::vector<std::filesystem::path> folders;
    for (const std::string& name : names) folders.push_back(folder_ / name);
    return merge_tables(experiments_, folders, folder_ / "merged", allow_missing);
  }

  // What is said of a merge that must be refused, without the test's folder.
  std::string refusal(const std::vector<std::string>& names) {
    std::string message = test::message_of<InputError>([&] { merge(names); });
    EXPECT_FALSE(exists("merged/c.csv")) << message;
    for (size_t at = 0; (at = message.find(folder_.path().string() + "/")) != std::string::npos;)
      message.erase(at, folder_.path().string().size() + 1);
    return message;
  }

  void edit_manifest(const std::string& folder, const std::function<void(Json&)>& edit) {
    Json json = Json::parse(content(folder + "/manifest.json"));
    edit(json);
    folder_.write(folder + "/manifest.json", json.dump());
  }

  // Changes a table and what its manifest says of it.
  void edit_table(const std::string& folder, const std::string& from, const std::string& to) {
    std::string table = content(folder + "/c.csv");
    table.replace(table.find(from), from.size(), to);
    folder_.write(folder + "/c.csv", table);
    edit_manifest(folder, [&](Json& m) { m["table"]["content_hash"] = hex(hash_text(table)); });
  }
};

TEST_F(MergeTest, MakesTheTableOfASingleRunOfShardsInAnyOrder) {
  run(kConfig, {.folder = "whole"});
  run_shards();
  const MergeResult result = merge({"3", "1", "2"});
  EXPECT_EQ(result.points, 6u);
  EXPECT_EQ(result.missing, 0u);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(content("merged/c.csv"), content("whole/c.csv"));
}

TEST_F(MergeTest, HoldsTheManifestsOfItsShards) {
  run_shards();
  merge({"1", "2", "3"});
  const Json manifest = Json::parse(content("merged/manifest.json"));
  EXPECT_FALSE(manifest.contains("shard"));
  EXPECT_EQ(manifest["run"]["points"], 6);
  EXPECT_EQ(manifest["run"]["points_done"], 6);
  EXPECT_EQ(manifest["run"]["complete"], true);
  EXPECT_EQ(manifest["run"]["sessions"].size(), 3u);
  EXPECT_EQ(manifest["points"].size(), 6u);
  ASSERT_EQ(manifest["shards"].size(), 3u);
  EXPECT_EQ(manifest["shards"][1]["shard"]["index"], 2);
  double sum = 0;
  for (const Json& shard : manifest["shards"]) sum += shard["run"]["wall_time_s"].get<double>();
  EXPECT_DOUBLE_EQ(manifest["run"]["wall_time_s"].get<double>(), sum);
}

TEST_F(MergeTest, CountsTheReferencesOfAllShards) {
  run_shards();
  for (const char* folder : {"1", "2", "3"}) {
    edit_manifest(folder, [&](Json& m) {
      m["references"]["computed"] = folder[0] - '0';
      m["references"]["cache_enabled"] = true;
    });
  }
  merge({"1", "2", "3"});
  const Json manifest = Json::parse(content("merged/manifest.json"));
  EXPECT_EQ(manifest["references"]["computed"], 6);
  EXPECT_EQ(manifest["references"]["batches_reused"], 0);
  EXPECT_EQ(manifest["references"]["cache_enabled"], true);
  EXPECT_EQ(manifest["shards"][1]["references"]["computed"], 2);
}

TEST_F(MergeTest, CanBeResumedLikeASingleRun) {
  run_shards();
  merge({"1", "2", "3"});
  EXPECT_EQ(run(kConfig, {.folder = "merged"}).reused, 6u);
}

TEST_F(MergeTest, TakesAShardWithoutPoints) {
  run_shards(R"({"experiment": "toy", "sweep": {"count": [1, 2]}})");
  EXPECT_FALSE(exists("3/c.csv"));
  EXPECT_EQ(merge({"1", "2", "3"}).missing, 0u);
}

TEST_F(MergeTest, BringsThePicturesTogether) {
  run_shards();
  folder_.write("1/pictures/a.png", "A");
  folder_.write("3/pictures/b.png", "B");
  folder_.write("3/pictures/c.png.partial", "half");
  merge({"1", "2", "3"});
  EXPECT_EQ(content("merged/pictures/a.png"), "A");
  EXPECT_EQ(content("merged/pictures/b.png"), "B");
  EXPECT_EQ(files("merged/pictures").size(), 2u);
}

TEST_F(MergeTest, RefusesMissingPointsUnlessTold) {
  run_shards();
  EXPECT_EQ(refusal({"1", "3"}), "merge: 2 points have no row, the first of them " + sweep_.points[2].id +
                                     " (--allow-missing merges the others)");
  EXPECT_EQ(merge({"1", "3"}, true).missing, 2u);
  EXPECT_EQ(read_csv(folder_ / "merged/c.csv").rows.size(), 4u);
  EXPECT_EQ(Json::parse(content("merged/manifest.json"))["run"]["complete"], false);
}

TEST_F(MergeTest, SaysWhereMissingPointsFailedAndKeepsTheFailures) {
  const std::string config =
      R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"behaviour": ["plain", "wordy", "fragile"], "length": [1, 2]}})";
  folder_.write("3/hammer", "");
  run_shards(config);
  EXPECT_FALSE(exists("3/manifest.json")) << "all of its points failed";
  EXPECT_EQ(refusal({"1", "2", "3"}), "3: there is no manifest.json");
  run(config, {.shard = Shard{1, 1}, .folder = "4"});
  folder_.write("5/hammer", "");
  run(config, {.shard = Shard{1, 1}, .folder = "5"});
  EXPECT_EQ(refusal({"5"}), "merge: 2 points have no row, the first of them " + sweep_.points[4].id +
                                "; 2 failed in 5 (--allow-missing merges the others)");
  merge({"5"}, true);
  EXPECT_EQ(Json::parse(content("merged/manifest.json"))["run"]["failures"].size(), 2u);
  merge({"5", "4"});
  EXPECT_EQ(Json::parse(content("merged/manifest.json"))["run"]["failures"].size(), 0u) << "4 has their rows";
}

TEST_F(MergeTest, RefusesOverlappingRowsThatDisagreeInAMetric) {
  run_shards();
  run(kConfig, {.folder = "all"});
  EXPECT_EQ(merge({"1", "all"}).missing, 0u) << "those that agree may overlap";
  std::filesystem::remove_all(folder_ / "merged");
  const std::string id = sweep_.points[1].id;
  edit_table("all", id + ",1,1,", id + ",1,1.0000000000000002,");
  EXPECT_EQ(refusal({"1", "all"}),
            "all: point " + id +
                " has another doubled_m there than in the folders before: 1.0000000000000002 and 1");
}

TEST_F(MergeTest, LetsOverlappingRowsDifferInTheirTimes) {
  run_shards();
  run(kConfig, {.folder = "all"});
  edit_table("all", ",1.5\n", ",1.75\n");
  merge({"1", "all"});
  EXPECT_EQ(content("merged/c.csv").find("1.75"), std::string::npos) << "the first folder's row stands";
}

TEST_F(MergeTest, RefusesFoldersOfDifferentRuns) {
  run_shards();
  run(R"({"experiment": "toy", "sweep": {"count": [6, 1, 5, 2, 4]}})", {.folder = "config"});
  EXPECT_EQ(refusal({"1", "config"}), "config: it is of another run than 1: another config");
  run(kConfig, {.timing = false, .folder = "timing"});
  EXPECT_EQ(refusal({"1", "timing"}), "timing: it is of another run than 1: another choice of timing");
  edit_manifest("2", [](Json& m) { m["row_origin"]["program"] = "0123456789abcdef"; });
  EXPECT_EQ(refusal({"1", "2", "3"}), "2: it is of another run than 1: another program");
  edit_manifest("3", [](Json& m) { m["points"][0] = "0123456789abcdef"; });
  EXPECT_EQ(refusal({"1", "3"}),
            "3: it is of another run than 1: another points (is a scene another one there, or missing?)");
}

TEST_F(MergeTest, WarnsWhereRowsOfDifferentMachinesStandBesideOneAnother) {
  run_shards();
  edit_manifest("2", [](Json& m) { m["row_origin"]["cpu"] = "another"; });
  const MergeResult result = merge({"1", "2", "3"});
  EXPECT_EQ(result.warnings,
            std::vector<std::string>{(folder_ / "2").string() + " has rows of another cpu: \"another\""});
  EXPECT_EQ(run(kConfig, {.folder = "merged"}).reused, 0u) << "no single run makes such a table";
}

TEST_F(MergeTest, TellsOriginsApartOfWhichOneIsPartOfTheOther) {
  run_shards();
  edit_manifest("1", [](Json& m) { m["row_origin"]["threads"] = "12"; });
  edit_manifest("2", [](Json& m) { m["row_origin"]["threads"] = "2"; });
  edit_manifest("3", [](Json& m) { m["row_origin"]["threads"] = "12"; });
  EXPECT_EQ(merge({"1", "2", "3"}).warnings,
            std::vector<std::string>{(folder_ / "2").string() + " has rows of another threads: \"2\""});
  EXPECT_EQ(Json::parse(content("merged/manifest.json"))["row_origin"]["threads"], "12 | 2");
}

TEST_F(MergeTest, RefusesWhatIsNotAFinishedShard) {
  run_shards();
  EXPECT_EQ(refusal({"1", "absent"}), "absent: there is no manifest.json");
  run(kConfig, {.stop_after = 2, .folder = "stopped"});
  EXPECT_EQ(refusal({"stopped"}),
            "stopped: the run there has not come to its end; run it again to resume it");
  folder_.write("odd/manifest.json", "{}");
  EXPECT_EQ(refusal({"odd"}), "odd/manifest.json: it is not a manifest of this program");
  folder_.write("3/c.csv", content("3/c.csv") + "\n");
  EXPECT_EQ(refusal({"1", "2", "3"}), "3/c.csv: it is not the table that manifest.json describes");
  EXPECT_EQ(test::message_of<InputError>(
                [&] { merge_tables(experiments_, std::vector{folder_ / "1"}, folder_ / "1", true); }),
            (folder_ / "1").string() + ": the output folder is one of those to merge");
}

}  // namespace
}  // namespace hybray
