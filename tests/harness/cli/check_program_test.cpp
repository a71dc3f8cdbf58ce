// `hybray check` and `hybray accept` of the built program, over the toy experiments.
#include "harness/cli/commands.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

class CheckProgramTest : public ::testing::Test {
 protected:
  CheckProgramTest() {
    folder_.write("root/scenes/none", "");
    folder_.write("root/configs/none", "");
  }

  test::Outcome hybray(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), HYBRAY_TOY_PROGRAM);
    return test::run_process(arguments,
                             {folder_.path().string(),
                              {{"HYBRAY_ROOT", (folder_ / "root").string()}, {"HYBRAY_SCENE_PATH", ""}},
                              ""});
  }

  // A config of two points, count 1 and 2, whose metric doubled_m is 3 in both; with these gates; run into
  // out/.
  void run_with(const std::string& gates, const std::string& folder = "root/configs/") {
    folder_.write(
        folder + "toy.json",
        R"({"experiment": "toy", "parameters": {"length": 1.5}, "sweep": {"count": [1, 2]}, "gates": )" +
            gates + "}");
    const test::Outcome outcome =
        hybray({"run", (folder_ / (folder + "toy.json")).string(), "-q", "-o", "out"});
    ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  }

  void expect_usage_error(const std::vector<std::string>& arguments, const std::string& message) {
    const test::Outcome outcome = hybray(arguments);
    EXPECT_EQ(outcome.exit_code, kUsage);
    EXPECT_EQ(outcome.err, "hybray: error: " + message + "\n");
    EXPECT_EQ(outcome.out, "");
  }

  std::string in_root(const std::string& file) { return (folder_ / "root" / file).string(); }

  const test::TemporaryFolder folder_;
};

TEST_F(CheckProgramTest, PassesWithTheMarginsOfEveryGate) {
  run_with(
      R"([{"column": "doubled_m", "max": 3.5}, {"name": "two", "column": "doubled_m", "min": 3, "where": {"count": 2}}])");
  const test::Outcome outcome = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "out/toy.csv: 2 rows, gates of " + in_root("configs/toy.json") + R"(
result  gate              rows  value  limit   margin  where
passed  doubled_m <= 3.5  2     3      <= 3.5  0.5     count=1
passed  two               1     3      >= 3    0       count=2

2 gates: 2 passed
)");
}

TEST_F(CheckProgramTest, EndsWithOneWhereAGateIsMissed) {
  run_with(R"([{"name": "n", "column": "doubled_m", "max": 2, "reason": "r"}])");
  const test::Outcome outcome = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(outcome.exit_code, kGateFailed);
  EXPECT_NE(outcome.out.find("MISSED  n     2     3      <= 2   -1      count=1\n"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find(
                "MISSED: n\n  asks for: doubled_m <= 2\n  because: r\n"
                "  count=1: 3 is above the greatest 2 by 1\n  count=2: 3 is above the greatest 2 by 1\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("1 gate: 0 passed, 1 missed\n"), std::string::npos);
}

TEST_F(CheckProgramTest, FailsOnWhatIsNotThere) {
  for (const char* gate :
       {R"({"column": "doubled_m", "max": 9, "where": {"count": 5}})", R"({"column": "absent", "max": 9})",
        R"({"column": "doubled_m", "baseline": {"worse_by_at_most": 9}})"}) {
    run_with("[" + std::string(gate) + "]");
    EXPECT_EQ(hybray({"check", "out/toy.csv"}).exit_code, kGateFailed) << gate;
  }
}

TEST_F(CheckProgramTest, DoesNotFailOnAnExpectedFailureAndTellsWhenItPasses) {
  run_with(R"([{"column": "doubled_m", "max": 2, "expected_failure": "known"}])");
  const test::Outcome failing = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(failing.exit_code, kOk);
  EXPECT_NE(failing.out.find("1 gate: 0 passed, 1 expected failure\n"), std::string::npos) << failing.out;
  EXPECT_EQ(failing.err, "");
  run_with(R"([{"column": "doubled_m", "max": 4, "expected_failure": "known"}])");
  const test::Outcome passing = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(passing.exit_code, kOk);
  EXPECT_NE(passing.out.find("1 unexpected pass\n"), std::string::npos) << passing.out;
  EXPECT_EQ(passing.err,
            "hybray: warning: a gate that was expected to fail passes: take out its \"expected_failure\"\n");
}

TEST_F(CheckProgramTest, ComparesWithTheAcceptedTableWhereThereAreNoGates) {
  run_with("[]");
  const test::Outcome none = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(none.exit_code, kGateFailed);
  EXPECT_NE(none.out.find("is not there: nothing was accepted yet"), std::string::npos) << none.out;

  const test::Outcome accepted = hybray({"accept", "out/toy.csv"});
  EXPECT_EQ(accepted.exit_code, kOk) << accepted.err;
  EXPECT_EQ(accepted.out,
            "out/toy.csv -> " + in_root("results/baseline/toy.csv") + ": nothing was accepted before\n");
  EXPECT_EQ(test::content_of(in_root("results/baseline/toy.csv")),
            "count,doubled_m,note\n1,3,\"a \"\"quoted\"\", word\"\n2,3,\"a \"\"quoted\"\", word\"\n");
  EXPECT_EQ(hybray({"check", "out/toy.csv"}).exit_code, kOk);

  ASSERT_EQ(hybray({"run", in_root("configs/toy.json"), "-q", "-o", "out", "--set", "length=2"}).exit_code,
            kOk);
  const test::Outcome changed = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(changed.exit_code, kGateFailed);
  EXPECT_NE(changed.out.find("count=1: doubled_m was 3, is 4 (+1; tolerance 0)\n"), std::string::npos)
      << changed.out;

  const test::Outcome again = hybray({"accept", "out/toy.csv"});
  EXPECT_EQ(again.out,
            "count=1: doubled_m was 3, is 4 (+1; tolerance 0)\n"
            "count=2: doubled_m was 3, is 4 (+1; tolerance 0)\n"
            "out/toy.csv -> " +
                in_root("results/baseline/toy.csv") +
                ": 2 differences, 0 cells moved within their tolerance\n");
  EXPECT_EQ(hybray({"check", "out/toy.csv"}).exit_code, kOk);
}

TEST_F(CheckProgramTest, TakesGatesAndAcceptedTablesFromElsewhere) {
  run_with(R"([{"column": "doubled_m", "max": 2}])");
  folder_.write("strict.json",
                R"({"gates": [{"column": "doubled_m", "baseline": {"differs_by_at_most": 0.5}}]})");
  folder_.write("other/toy.csv",
                "count,doubled_m,note\n1,2.5,\"a \"\"quoted\"\", word\"\n2,3.5,\"a \"\"quoted\"\", word\"\n");
  EXPECT_EQ(hybray({"check", "out/toy.csv", "--gates", "strict.json", "--baseline", "other"}).exit_code, kOk);
  folder_.write("other/toy.csv", "count,doubled_m,note\n1,2.5,\"a \"\"quoted\"\", word\"\n");
  EXPECT_EQ(hybray({"check", "out/toy.csv", "--gates", "strict.json", "--baseline", "other"}).exit_code,
            kGateFailed);
}

TEST_F(CheckProgramTest, FindsAConfigInThePresentFolderAndTakesOneByName) {
  run_with(R"([{"column": "doubled_m", "max": 4}])", "");
  EXPECT_EQ(hybray({"check", "out/toy.csv"}).exit_code, kOk);
  std::filesystem::remove(folder_ / "out/manifest.json");
  expect_usage_error(
      {"check", "out/toy.csv"},
      "out/toy.csv: which config it is of is not known, since no manifest.json of it is beside it; name "
      "the config with --gates");
  const test::Outcome named = hybray({"check", "out/toy.csv", "--gates", "toy.json"});
  EXPECT_EQ(named.exit_code, kOk);
  EXPECT_EQ(named.err,
            "hybray: warning: out/toy.csv: no manifest.json of it says how many rows it should have\n");
}

TEST_F(CheckProgramTest, MissesPointsWithoutARow) {
  run_with(R"([{"column": "doubled_m", "max": 4}])");
  const std::string table = test::content_of(folder_ / "out/toy.csv");
  folder_.write("out/toy.csv", table.substr(0, table.rfind('\n', table.size() - 2) + 1));
  const test::Outcome outcome = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(outcome.exit_code, kGateFailed);
  EXPECT_NE(outcome.out.find("the run had 2 points, the table has 1 rows"), std::string::npos) << outcome.out;
  expect_usage_error({"accept", "out/toy.csv"}, "out/toy.csv: the run had 2 points, the table has 1 rows");
  EXPECT_FALSE(std::filesystem::exists(in_root("results/baseline/toy.csv")));
}

// Of runs in parts, whose tables have rows of some points only.
TEST_F(CheckProgramTest, MissesPointsWithoutARowOfShardsAndOfWhatWasMerged) {
  run_with(R"([{"column": "doubled_m", "max": 4}])");
  const std::string config = in_root("configs/toy.json");
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(hybray({"run", config, "-q", "-o", "shards", "--shard", shard}).exit_code, kOk);
  const std::string first = "shards/shard-1-of-2", second = "shards/shard-2-of-2";
  EXPECT_EQ(hybray({"check", first + "/toy.csv"}).exit_code, kOk)
      << "a shard is complete with its own points";

  ASSERT_EQ(hybray({"merge", first, second, "-o", "merged"}).exit_code, kOk);
  EXPECT_EQ(hybray({"check", "merged/toy.csv"}).exit_code, kOk);
  ASSERT_EQ(hybray({"merge", first, "-o", "half", "--allow-missing"}).exit_code, kOk);
  const test::Outcome half = hybray({"check", "half/toy.csv"});
  EXPECT_EQ(half.exit_code, kGateFailed);
  EXPECT_NE(half.out.find("the run had 2 points, the table has 1 rows"), std::string::npos) << half.out;

  const std::string table = test::content_of(folder_ / (second + "/toy.csv"));
  folder_.write(second + "/toy.csv", table.substr(0, table.find('\n') + 1));
  const test::Outcome empty = hybray({"check", second + "/toy.csv"});
  EXPECT_EQ(empty.exit_code, kGateFailed);
  EXPECT_NE(empty.out.find("the run had 1 points, the table has 0 rows"), std::string::npos) << empty.out;
}

TEST_F(CheckProgramTest, MissesPointsWithoutARowUntilAResumedRunHasThem) {
  folder_.write("root/configs/toy.json",
                R"({"experiment": "toy", "parameters": {"behaviour": "fragile"}, "sweep": {"count": [1, 2]},
                    "gates": [{"column": "doubled_m", "max": 4}]})");
  const std::string config = in_root("configs/toy.json");
  ASSERT_EQ(hybray({"run", config, "-q", "-o", "out", "--filter", "count=1"}).exit_code, kOk);
  EXPECT_EQ(hybray({"check", "out/toy.csv"}).exit_code, kOk) << "all that the filter left";

  folder_.write("out/hammer", "");
  ASSERT_EQ(hybray({"run", config, "-q", "-o", "out"}).exit_code, kSomeFailed);
  const test::Outcome failed = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(failed.exit_code, kGateFailed);
  EXPECT_NE(failed.out.find("the run had 2 points, the table has 1 rows"), std::string::npos) << failed.out;

  std::filesystem::remove(folder_ / "out/hammer");
  ASSERT_EQ(hybray({"run", config, "-q", "-o", "out"}).exit_code, kOk);
  EXPECT_EQ(hybray({"check", "out/toy.csv"}).exit_code, kOk);
}

TEST_F(CheckProgramTest, WritesReportsForMachinesAndPages) {
  run_with(R"([{"name": "<n> & \"q\"\u0001", "column": "doubled_m", "max": 2}])");
  EXPECT_EQ(hybray({"check", "out/toy.csv", "--junit", "r/j.xml", "--markdown", "r/m.md"}).exit_code,
            kGateFailed);
  const char* script =
      "import sys, xml.etree.ElementTree as e\nprint([c.get('name') for c in "
      "e.parse(sys.argv[1]).iter('testcase')], "
      "len(list(e.parse(sys.argv[1]).iter('failure'))))";
  const test::Outcome parsed =
      test::run_process({"/usr/bin/python3", "-c", script, (folder_ / "r/j.xml").string()});
  EXPECT_EQ(parsed.out, "['<n> & \"q\"\xef\xbf\xbd'] 1\n") << parsed.err;
  EXPECT_NE(test::content_of(folder_ / "r/m.md").find("❌ **missed**"), std::string::npos);
  EXPECT_NE(hybray({"check", "out/toy.csv", "--markdown", "/dev/stdout"}).out.find("## hybray check"),
            std::string::npos)
      << "a device is written to, not replaced";
}

TEST_F(CheckProgramTest, RefusesWrongUsageInOneMessage) {
  run_with(R"([{"column": "doubled_m", "max": 2}])");
  expect_usage_error({"check", "none.csv", "--gates", in_root("configs/toy.json")},
                     "none.csv: cannot be read: No such file or directory");
  expect_usage_error({"check", "out/toy.csv.partial"},
                     "out/toy.csv.partial: expected a complete table, NAME.csv");
  expect_usage_error(
      {"check", "out/toy.csv", "./out/toy.csv"},
      "./out/toy.csv: another table of this name is to be checked, which has the same accepted table");
  EXPECT_EQ(hybray({"check"}).exit_code, kUsage);
  folder_.write("g.json", "{\"gates\": [\n{\"column\": \"toy_ms\", \"max\": 1}]}");
  expect_usage_error(
      {"check", "out/toy.csv", "--gates", "g.json"},
      "g.json:2:12 (/gates/0/column): the column \"toy_ms\" is an absolute time or rate (ms), which "
      "depends on the machine and on what else runs on it; gate a ratio of times, a count or a metric");
  const std::string table = test::content_of(folder_ / "out/toy.csv");
  folder_.write("out/toy.csv", table + table.substr(table.find('\n') + 1));
  const test::Outcome twice = hybray({"check", "out/toy.csv"});
  EXPECT_EQ(twice.exit_code, kUsage);
  EXPECT_TRUE(twice.err.starts_with("hybray: error: out/toy.csv:4: the id ")) << twice.err;
  std::filesystem::remove(in_root("configs/toy.json"));
  expect_usage_error({"check", "out/toy.csv"}, "out/toy.csv: its config toy.json is neither here nor in " +
                                                   in_root("configs") + "; name it with --gates");
}

TEST_F(CheckProgramTest, RefusesAConfigWithAWrongGateBeforeItRuns) {
  folder_.write("bad.json",
                "{\"experiment\": \"toy\", \"parameters\": {\"count\": 1},\n \"gates\": [{\"column\": "
                "\"doubled\", \"max\": 1}]}");
  expect_usage_error(
      {"run", "bad.json", "-o", "bad"},
      "bad.json:2:23 (/gates/0/column): unknown column \"doubled\"; did you mean \"doubled_m\"?");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bad"));
}

}  // namespace
}  // namespace hybray
