// The built program over the toy experiments, run as a user runs it.
#include "harness/cli/commands.h"
#include "harness/table/csv.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class ProgramTest : public ::testing::Test {
 protected:
  ProgramTest() {
    folder_.write("root/scenes/none", "");
    folder_.write("root/configs/none", "");
  }

  test::Outcome hybray(std::vector<std::string> arguments, const std::string& interrupt_when = "") {
    arguments.insert(arguments.begin(), HYBRAY_TOY_PROGRAM);
    test::ProcessOptions options;
    options.folder = folder_.path().string();
    options.environment = {{"HYBRAY_ROOT", (folder_ / "root").string()}, {"HYBRAY_SCENE_PATH", ""}};
    options.interrupt_when = interrupt_when;
    return test::run_process(arguments, options);
  }

  // Runs a config that must be refused: exit code 2, this one message, no output.
  void expect_refused(const std::string& config, const std::string& message) {
    folder_.write("bad.json", config);
    folder_.write("out/bad.csv", "old\n");
    const test::Outcome outcome = hybray({"run", "bad.json", "-o", "out"});
    EXPECT_EQ(outcome.exit_code, kUsage);
    EXPECT_EQ(outcome.err, "hybray: error: " + message + "\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(test::content_of(folder_ / "out/bad.csv"), "old\n");
    const auto files = std::filesystem::directory_iterator(folder_ / "out");
    EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "something was written";
  }

  const test::TemporaryFolder folder_;
};

TEST_F(ProgramTest, RunsAConfigIntoTheProjectsResultsFolder) {
  folder_.write("good.json", R"({"experiment": "toy", "sweep": {"count": [1, 2]}})");
  const test::Outcome outcome = hybray({"run", "good.json"});
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(read_csv(folder_ / "root/results/out/good/good.csv").rows.size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "root/results/out/good/manifest.json"));
  EXPECT_NE(outcome.err.find("good 1/2 count=1"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos) << "no terminal, no escape codes";
}

TEST_F(ProgramTest, GivesEachOfSeveralConfigsAFolderOfItsOwn) {
  folder_.write("a.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  folder_.write("b.json", R"({"experiment": "toy", "parameters": {"count": 2}})");
  const test::Outcome outcome = hybray({"run", "a.json", "b.json", "-o", "out", "-q", "--set", "length=2"});
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read_csv(folder_ / "out/a/a.csv").rows.at(0).at(2), "4");
  EXPECT_EQ(read_csv(folder_ / "out/b/b.csv").rows.at(0).at(1), "2");
}

TEST_F(ProgramTest, StartsNoConfigWhenAnotherOneIsWrong) {
  folder_.write("a.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  folder_.write("b.json", R"({"experiment": "toy"})");
  EXPECT_EQ(hybray({"run", "a.json", "b.json", "-o", "out"}).exit_code, kUsage);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(ProgramTest, RefusesTwoConfigsOfOneName) {
  folder_.write("x/a.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  folder_.write("y/a.json", R"({"experiment": "toy", "parameters": {"count": 2}})");
  const test::Outcome outcome = hybray({"run", "x/a.json", "y/a.json", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.err, "hybray: error: y/a.json: it would write to the same folder as x/a.json: out/a\n");
}

TEST_F(ProgramTest, SaysWhatIsWrongWithAConfigInOneMessage) {
  expect_refused("{\"experiment\": \"toy\",\n \"paramters\": {}}",
                 "bad.json:2:2 (/paramters): unknown key \"paramters\"; did you mean \"parameters\"?");
  expect_refused("{\"experiment\": \"toy\", \"parameters\": {\"count\": true}}",
                 "bad.json:1:47 (/parameters/count): found true; expected an integer from 1 to 9");
  expect_refused("{\"experiment\": \"toy\", \"parameters\": {\"cuont\": 1}}",
                 "bad.json:1:38 (/parameters/cuont): unknown parameter \"cuont\"; did you mean \"count\"?");
  expect_refused("{\"experiment\": \"tory\"}",
                 "bad.json:1:16 (/experiment): unknown experiment \"tory\"; did you mean \"toy\"?");
  expect_refused(
      "{\"experiment\": \"toy\",\n \"seed\": 1, \"seed\": 1}",
      "bad.json:2:13 (/seed): the key \"seed\" stands twice in this object; its first place is bad.json:2:2");
  expect_refused("{\"experiment\": \"toy\",\n}",
                 "bad.json:2:1: this is not JSON: syntax error while parsing object key - unexpected '}'; "
                 "expected string literal");
}

TEST_F(ProgramTest, RefusesAMissingConfig) {
  const test::Outcome outcome = hybray({"run", "none.json"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.err, "hybray: error: none.json: cannot be read: No such file or directory\n");
}

TEST_F(ProgramTest, RefusesMoreMemoryThanThereIsBeforeAnyOutput) {
  folder_.write(
      "big.json",
      "{\"experiment\": \"toy\", \"parameters\": {\"count\": 1},\n \"sweep\": {\"resolution\": [\"8x8\", "
      "\"16384x16384\"]}}");
  folder_.write("out/big.csv", "old\n");
  const test::Outcome outcome = hybray({"run", "big.json", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_TRUE(outcome.err.starts_with(
      "hybray: error: big.json:2:34 (/sweep/resolution/1): the resolution \"16384x16384\" needs "
      "about 2.4 PiB of memory; "))
      << outcome.err;
  EXPECT_EQ(test::content_of(folder_ / "out/big.csv"), "old\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/big.csv.partial"));
}

TEST_F(ProgramTest, RefusesAnOutputFolderThatCannotBeWrittenTo) {
  folder_.write("good.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  folder_.write("file", "old");
  const test::Outcome outcome = hybray({"run", "good.json", "-o", "file/out"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.err,
            "hybray: error: file/out: the output folder cannot be written to: Not a directory\n");
  EXPECT_EQ(test::content_of(folder_ / "file"), "old");
}

TEST_F(ProgramTest, ReportsAFailedPointWithItsParametersAndWritesTheRest) {
  folder_.write(
      "some.json",
      R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"behaviour": ["throw", "plain"]}})");
  const test::Outcome outcome = hybray({"run", "some.json", "-o", "out", "-q"});
  EXPECT_EQ(outcome.exit_code, kSomeFailed);
  EXPECT_NE(outcome.err.find(
                "(count=1 length=0.5 loud=false behaviour=throw resolution=8x8) failed: the toy broke"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(read_csv(folder_ / "out/some.csv").rows.size(), 1u);
}

TEST_F(ProgramTest, KeepsWhatIsDoneWhenInterrupted) {
  folder_.write(
      "slow.json",
      R"({"experiment": "toy", "parameters": {"behaviour": "sleep"}, "sweep": {"count": [1, 2, 3, 4, 5, 6, 7, 8, 9]}})");
  folder_.write("out/slow.csv", "old\n");
  folder_.write("out/manifest.json", "old\n");
  const test::Outcome outcome = hybray({"run", "slow.json", "-o", "out"}, "slow 1/9");
  EXPECT_EQ(outcome.exit_code, kInterrupted) << outcome.err;
  const size_t rows = read_csv(folder_ / "out/slow.csv.partial").rows.size();
  EXPECT_GE(rows, 1u);
  EXPECT_LT(rows, 9u);
  EXPECT_EQ(test::content_of(folder_ / "out/slow.csv"), "old\n");
  EXPECT_EQ(test::content_of(folder_ / "out/manifest.json"), "old\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/manifest.json.partial"));
  EXPECT_NE(outcome.err.find("interrupted; the rows so far are in out/slow.csv.partial"), std::string::npos)
      << outcome.err;
}

TEST_F(ProgramTest, ListsThePointsOfASweep) {
  folder_.write("good.json", R"({"experiment": "toy", "sweep": {"count": [1, 2], "length": [1, 2]}})");
  const test::Outcome outcome = hybray({"points", "good.json", "--filter", "count=2"});
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_EQ(outcome.out.find("count=1"), std::string::npos);
  EXPECT_EQ(outcome.out.substr(16), "  count=2 length=1  about 2 s, 610 MiB\n" + outcome.out.substr(55, 16) +
                                        "  count=2 length=2  about 2 s, 610 MiB\n");
}

TEST_F(ProgramTest, ListsThePointsForScripts) {
  folder_.write("toy.json",
                R"({"experiment": "toy", "parameters": {"count": 1}, "sweep": {"length": [1, 2.5]}})");
  folder_.write("other.json", R"({"experiment": "toy", "parameters": {"count": 2}})");
  folder_.write("suite.json", R"({"configs": ["toy.json", "other.json"]})");
  const test::Outcome csv = hybray({"points", "suite.json", "--csv"});
  EXPECT_EQ(csv.exit_code, kOk) << csv.err;
  const CsvTable table = parse_csv(csv.out, "points");
  EXPECT_EQ(table.header, (std::vector<std::string>{"config", "experiment", "id", "cost_s", "memory_bytes",
                                                    "count", "length", "loud", "behaviour", "resolution"}));
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[1][0], "toy");
  EXPECT_EQ(table.rows[1][3], "2");
  EXPECT_EQ(table.rows[1][6], "2.5");
  EXPECT_EQ(table.rows[2][0], "other");
  EXPECT_EQ(csv.err,
            "hybray: info: toy: 2 points, about 0:04\nhybray: info: other: 1 points, about 0:02\n"
            "hybray: info: 3 points, about 0:06 in all\n");

  const test::Outcome json = hybray({"points", "suite.json", "--json"});
  const auto root = nlohmann::json::parse(json.out);
  EXPECT_EQ(root["cost_s"], 6);
  EXPECT_EQ(root["configs"][0]["config"], "toy");
  EXPECT_EQ(root["configs"][0]["cost_s"], 4);
  EXPECT_EQ(root["configs"][0]["points"][1]["id"], table.rows[1][2]);
  EXPECT_EQ(root["configs"][0]["points"][1]["parameters"]["length"], 2.5);
  EXPECT_EQ(root["configs"][0]["points"][1]["memory_bytes"], 64e7);
  EXPECT_EQ(hybray({"points", "toy.json", "--json", "--csv"}).exit_code, kUsage);
}

TEST_F(ProgramTest, RunsTheConfigsOfASuiteIntoFoldersOfTheirOwn) {
  folder_.write("configs/a.json", R"({"experiment": "toy", "points": [{"count": 1}, {"count": 2}]})");
  folder_.write("configs/b.json",
                R"({"experiment": "toy", "sweep": {"count": {"from": 1, "to": 9, "step": 2}}})");
  folder_.write("configs/all.json",
                R"({"configs": ["a.json", {"config": "b.json", "filter": {"count": [3, 9]}}]})");
  const test::Outcome outcome = hybray({"run", "configs/all.json", "-q", "--set", "length=1,2"});
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_EQ(read_csv(folder_ / "root/results/out/a/a.csv").rows.size(), 4u);
  EXPECT_EQ(read_csv(folder_ / "root/results/out/b/b.csv").rows.size(), 4u);
  const auto manifest = nlohmann::json::parse(test::content_of(folder_ / "root/results/out/b/manifest.json"));
  EXPECT_EQ(manifest["config"]["filter"], nlohmann::json{"count=[3,9]"});
  EXPECT_EQ(manifest["config"]["set"], nlohmann::json{"length=1,2"});

  const test::Outcome filtered = hybray({"run", "configs/all.json", "-o", "out", "--filter", "count=9"});
  EXPECT_EQ(filtered.exit_code, kOk) << filtered.err;
  EXPECT_NE(filtered.err.find("a: no point matches the filters"), std::string::npos) << filtered.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/a"));
  EXPECT_EQ(read_csv(folder_ / "out/b/b.csv").rows.size(), 1u);
}

TEST_F(ProgramTest, RunsNothingOfASuiteWithAWrongConfig) {
  folder_.write("a.json", R"({"experiment": "toy", "parameters": {"count": 1}})");
  folder_.write("b.json", R"({"experiment": "toy", "points": [{"count": 10}]})");
  folder_.write("all.json", R"({"configs": ["a.json", "b.json"]})");
  const test::Outcome outcome = hybray({"run", "all.json", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.err,
            "hybray: error: b.json:1:44 (/points/0/count): found 10; expected an integer from 1 to 9\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(ProgramTest, DescribesExperimentsForPeopleDocsAndEditors) {
  EXPECT_EQ(hybray({"describe"}).out, "toy  Measures nothing.\nstaged  Measures nothing on a scene.\n");
  EXPECT_NE(hybray({"describe", "toy"}).out.find("an integer from 1 to 9"), std::string::npos);
  EXPECT_NE(hybray({"describe", "toy", "--markdown"})
                .out.find("| note |  | key |  | row | text with commas \\| bars |"),
            std::string::npos);
  EXPECT_EQ(hybray({"describe", "toy", "--schema"}).out.front(), '{');
  EXPECT_EQ(hybray({"describe", "suite", "--schema"}).out.front(), '{');
  const test::Outcome unknown = hybray({"describe", "tpy"});
  EXPECT_EQ(unknown.exit_code, kUsage);
  EXPECT_EQ(unknown.err, "hybray: error: describe: unknown experiment \"tpy\"; did you mean \"toy\"?\n");
}

TEST_F(ProgramTest, ExplainsItselfAndRefusesWhatItDoesNotKnow) {
  const test::Outcome help = hybray({"--help"});
  EXPECT_EQ(help.exit_code, kOk);
  for (const char* word : {"run", "points", "describe", "scene", "HYBRAY_ROOT", "Exit codes"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(help.err, "");
  const test::Outcome version = hybray({"--version"});
  EXPECT_EQ(version.exit_code, kOk);
  EXPECT_TRUE(version.out.starts_with("hybray 0.")) << version.out;
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                {"rnu"},
                                                {"run"},
                                                {"run", "x.json", "--fast"},
                                                {"scene"},
                                                {"run", "x.json", "--threads", "0"}}) {
    const test::Outcome outcome = hybray(wrong);
    EXPECT_EQ(outcome.exit_code, kUsage);
    EXPECT_NE(outcome.err, "");
    EXPECT_EQ(outcome.out, "");
  }
}

}  // namespace
}  // namespace hybray
