// The built program: shards of a real sweep, and their merge.
#include "harness/cli/commands.h"
#include "harness/table/csv.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class MergeProgramTest : public ::testing::Test {
 protected:
  test::Outcome hybray(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), HYBRAY_PROGRAM);
    return test::run_process(arguments, {folder_.path().string(), {{"HYBRAY_ROOT", HYBRAY_PROJECT_DIR}}, ""});
  }

  const test::TemporaryFolder folder_;
};

TEST_F(MergeProgramTest, MakesOfThreeShardsTheMetricsOfTheSingleRunByteForByte) {
  folder_.write("s.json", R"({"experiment": "ssrm",
    "parameters": {"scene": "sphere", "repeats": 1, "picture": true},
    "sweep": {"resolution": ["24x18", "33x25"], "derivatives": ["plane", "difference"]}})");
  ASSERT_EQ(hybray({"run", "s.json", "-o", "whole"}).exit_code, kOk);
  std::vector<std::string> merge = {"merge", "-o", "merged"};
  size_t listed = 0;
  for (const char* i : {"1", "2", "3"}) {
    const std::string shard = std::string(i) + "/3";
    const test::Outcome outcome = hybray({"run", "s.json", "-o", "out", "--shard", shard});
    ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
    merge.push_back(std::string("out/shard-") + i + "-of-3");
    const std::string points = hybray({"points", "s.json", "--shard", shard}).out;
    const CsvTable table = read_csv(folder_ / merge.back() / "s.csv");
    EXPECT_EQ(static_cast<size_t>(std::count(points.begin(), points.end(), '\n')), table.rows.size());
    for (const auto& row : table.rows) EXPECT_NE(points.find(row[0]), std::string::npos);
    listed += table.rows.size();
  }
  const test::Outcome outcome = hybray(merge);
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;

  const CsvTable whole = read_csv(folder_ / "whole/s.csv"), merged = read_csv(folder_ / "merged/s.csv");
  EXPECT_EQ(merged.header, whole.header);
  ASSERT_EQ(merged.rows.size(), whole.rows.size());
  EXPECT_EQ(listed, whole.rows.size());
  EXPECT_GE(whole.rows.size(), 12u);
  for (size_t r = 0; r < whole.rows.size(); ++r) {
    EXPECT_EQ(merged.rows[r][0], whole.rows[r][0]);
    for (const Column& column : find_experiment("ssrm")->columns) {
      if (column.kind != ColumnKind::metric && column.kind != ColumnKind::count) continue;
      const auto c = static_cast<size_t>(whole.column(column.name));
      EXPECT_EQ(merged.rows[r][c], whole.rows[r][c]) << column.name;
    }
  }
  size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "whole/pictures")) {
    ++pictures;
    EXPECT_EQ(test::content_of(folder_ / "merged/pictures" / entry.path().filename()),
              test::content_of(entry.path()));
  }
  EXPECT_EQ(pictures, 2 * whole.rows.size()) << "verdicts and main view";
}

TEST_F(MergeProgramTest, RefusesWithOneMessageAndExitCode2) {
  const test::Outcome outcome = hybray({"merge", "absent", "-o", "merged"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.err, "hybray: error: absent: there is no manifest.json\n");
  EXPECT_EQ(hybray({"merge", "absent"}).exit_code, kUsage) << "without -o";
  folder_.write("s.json", R"({"experiment": "ssrm", "parameters": {"scene": "sphere"}})");
  const test::Outcome shard = hybray({"run", "s.json", "-o", "out", "--shard", "4/3"});
  EXPECT_EQ(shard.exit_code, kUsage);
  EXPECT_EQ(shard.err, "hybray: error: --shard 4/3: expected I/N, such as 2/3, with I from 1 to N\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace hybray
