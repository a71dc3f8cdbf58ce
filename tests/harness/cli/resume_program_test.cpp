// The built program over the toy experiments: interrupted, refused, out of space, and run again.
#include "harness/cli/commands.h"
#include "harness/table/csv.h"
#include "harness/table/folder_lock.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class ResumeProgramTest : public ::testing::Test {
 protected:
  ResumeProgramTest() {
    folder_.write("root/scenes/none", "");
    folder_.write("root/configs/none", "");
    folder_.write(
        "slow.json",
        R"({"experiment": "toy", "parameters": {"behaviour": "sleep"}, "sweep": {"count": [1, 2, 3, 4, 5, 6, 7, 8, 9]}})");
  }

  test::Outcome hybray(std::vector<std::string> arguments, test::ProcessOptions options = {}) {
    arguments.insert(arguments.begin(), HYBRAY_TOY_PROGRAM);
    options.folder = folder_.path().string();
    options.environment = {{"HYBRAY_ROOT", (folder_ / "root").string()}, {"HYBRAY_SCENE_PATH", ""}};
    return test::run_process(arguments, options);
  }

  std::string content(const std::string& file) const { return test::content_of(folder_ / file); }

  const test::TemporaryFolder folder_;
};

TEST_F(ResumeProgramTest, EndsWith130OnSigintAndSigtermAndGoesOnFromThere) {
  ASSERT_EQ(hybray({"run", "slow.json", "-o", "whole"}).exit_code, kOk);
  for (const int signal : {SIGINT, SIGTERM}) {
    test::ProcessOptions interrupted;
    interrupted.interrupt_when = "slow 1/9";
    interrupted.signal = signal;
    const std::string out = signal == SIGINT ? "int" : "term";
    const test::Outcome first = hybray({"run", "slow.json", "-o", out}, interrupted);
    EXPECT_EQ(first.exit_code, kInterrupted) << first.err;
    EXPECT_NE(first.err.find("the same command goes on from there"), std::string::npos) << first.err;
    const size_t rows = read_csv(folder_ / out / "slow.csv.partial").rows.size();
    ASSERT_GE(rows, 1u);
    ASSERT_LT(rows, 9u);
    const test::Outcome second = hybray({"run", "slow.json", "-o", out});
    EXPECT_EQ(second.exit_code, kOk) << second.err;
    EXPECT_NE(second.err.find("slow: " + std::to_string(rows) + " of 9 points are there already"),
              std::string::npos)
        << second.err;
    EXPECT_NE(second.err.find("slow 1/" + std::to_string(9 - rows)), std::string::npos) << second.err;
    EXPECT_EQ(content(out + "/slow.csv"), content("whole/slow.csv"));
  }
}

TEST_F(ResumeProgramTest, RunsNoFurtherConfigAfterAnInterruption) {
  folder_.write("next.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  test::ProcessOptions interrupted;
  interrupted.interrupt_when = "slow 1/9";
  EXPECT_EQ(hybray({"run", "slow.json", "next.json", "-o", "out"}, interrupted).exit_code, kInterrupted);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/slow/slow.csv.partial"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out/next"));
}

TEST_F(ResumeProgramTest, StartsOverWithFresh) {
  folder_.write("c.json", R"({"experiment": "toy", "sweep": {"count": [1, 2]}})");
  ASSERT_EQ(hybray({"run", "c.json", "-o", "out"}).exit_code, kOk);
  const test::Outcome outcome = hybray({"run", "c.json", "-o", "out", "--fresh"});
  EXPECT_EQ(outcome.exit_code, kOk);
  EXPECT_NE(outcome.err.find("c 2/2"), std::string::npos) << outcome.err;
}

TEST_F(ResumeProgramTest, TriesOnlyTheFailedPointAgain) {
  folder_.write(
      "some.json",
      R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"behaviour": ["plain", "fragile"]}})");
  folder_.write("out/hammer", "");
  EXPECT_EQ(hybray({"run", "some.json", "-o", "out"}).exit_code, kSomeFailed);
  EXPECT_EQ(nlohmann::json::parse(content("out/manifest.json"))["run"]["failures"].size(), 1u);
  std::filesystem::remove(folder_ / "out/hammer");
  const test::Outcome again = hybray({"run", "some.json", "-o", "out"});
  EXPECT_EQ(again.exit_code, kOk);
  EXPECT_NE(again.err.find("some 1/1"), std::string::npos) << again.err;
  EXPECT_EQ(read_csv(folder_ / "out/some.csv").rows.size(), 2u);
}

TEST_F(ResumeProgramTest, LeavesNoFileWhenEveryPointFails) {
  folder_.write("all.json", R"({"experiment": "toy", "parameters": {"count": 1, "behaviour": "throw"}})");
  EXPECT_EQ(hybray({"run", "all.json", "-o", "out"}).exit_code, kSomeFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
}

TEST_F(ResumeProgramTest, RefusesAFolderThatAnotherRunIsWritingTo) {
  std::filesystem::create_directories(folder_ / "out");
  const FolderLock other(folder_ / "out");
  const test::Outcome outcome = hybray({"run", "slow.json", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.err, "hybray: error: out: another run (process " + std::to_string(getpid()) +
                             ") is writing to this folder\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/slow.csv.partial"));
}

TEST_F(ResumeProgramTest, RefusesAFolderThatHoldsAnotherTable) {
  folder_.write("one.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  folder_.write("two.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  ASSERT_EQ(hybray({"run", "one.json", "-o", "out"}).exit_code, kOk);
  EXPECT_EQ(hybray({"run", "two.json", "-o", "out"}).exit_code, kUsage);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/two.csv"));
}

TEST_F(ResumeProgramTest, ClearsAwayWhatAKilledRunHadNotYetRenamed) {
  folder_.write("out/slow.csv.4711.tmp", "id,co");
  folder_.write("out/manifest.json.4711.tmp", "{\"con");
  ASSERT_EQ(hybray({"run", "slow.json", "-o", "out", "--filter", "count=1"}).exit_code, kOk);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/slow.csv.4711.tmp"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/manifest.json.4711.tmp"));
}

TEST_F(ResumeProgramTest, RefusesBeforeWorkWhereTheTableWouldNotFit) {
  test::ProcessOptions little;
  little.file_size_limit = 4096;
  const test::Outcome outcome = hybray({"run", "slow.json", "-o", "out"}, little);
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_TRUE(outcome.err.starts_with(
      "hybray: error: out: the output folder cannot be written to: File too large (about "))
      << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
}

TEST_F(ResumeProgramTest, LosesNothingFinishedWhenTheSpaceRunsOut) {
  // The notes of 20,000 bytes are beyond any estimate: three of them fit.
  folder_.write(
      "wordy.json",
      R"({"experiment": "toy", "parameters": {"behaviour": "wordy"}, "sweep": {"count": [1, 2, 3, 4, 5, 6]}})");
  ASSERT_EQ(hybray({"run", "wordy.json", "-o", "whole"}).exit_code, kOk);
  test::ProcessOptions little;
  little.file_size_limit = 65000;
  const test::Outcome full = hybray({"run", "wordy.json", "-o", "out"}, little);
  EXPECT_EQ(full.exit_code, kSomeFailed);
  EXPECT_NE(full.err.find("wordy.csv.partial: cannot be written: File too large; its 3 rows are kept"),
            std::string::npos)
      << full.err;
  EXPECT_EQ(full.err.find("wordy 5/6"), std::string::npos) << "no work goes on whose row cannot be kept";
  EXPECT_EQ(read_csv(folder_ / "out/wordy.csv.partial").rows.size(), 3u);
  const test::Outcome resumed = hybray({"run", "wordy.json", "-o", "out"});
  EXPECT_EQ(resumed.exit_code, kOk) << resumed.err;
  EXPECT_NE(resumed.err.find("wordy: 3 of 6 points are there already"), std::string::npos) << resumed.err;
  EXPECT_EQ(content("out/wordy.csv"), content("whole/wordy.csv"));
}

}  // namespace
}  // namespace hybray
