// The program `hybray` with its own experiments, from config to table.
#include "harness/cli/commands.h"
#include "harness/config/schema.h"
#include "harness/table/csv.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class SsrmProgramTest : public ::testing::Test {
 protected:
  test::Outcome hybray(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), HYBRAY_PROGRAM);
    return test::run_process(arguments, {folder_.path().string(), {{"HYBRAY_ROOT", HYBRAY_PROJECT_DIR}}, ""});
  }

  const test::TemporaryFolder folder_;
};

TEST_F(SsrmProgramTest, PrintsTheSchemaThatConfigsAreCheckedAgainst) {
  const Experiment* ssrm = find_experiment("ssrm");
  ASSERT_NE(ssrm, nullptr);
  EXPECT_EQ(hybray({"describe", "ssrm", "--schema"}).out, config_schema_text(*ssrm));
}

TEST_F(SsrmProgramTest, RunsASmallSweepToATableWithARowForEveryCamera) {
  folder_.write(
      "small.json",
      R"({"experiment": "ssrm", "parameters": {"scene": "sphere", "resolution": "64x48", "repeats": 1}})");
  const test::Outcome outcome = hybray({"run", "small.json", "-o", "out"});
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  const CsvTable table = read_csv(folder_ / "out/small.csv");
  const test::Outcome points = hybray({"points", "small.json"});
  EXPECT_EQ(static_cast<size_t>(std::count(points.out.begin(), points.out.end(), '\n')), table.rows.size());
  EXPECT_GE(table.rows.size(), 3u);
  for (size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_NE(points.out.find(table.rows[i][0] +
                              "  camera=" + table.rows[i][static_cast<size_t>(table.column("camera"))]),
              std::string::npos);
  }
}

TEST_F(SsrmProgramTest, RepeatsItsMetricsBitForBitAtAnyThreadCount) {
  folder_.write("small.json",
                R"({"experiment": "ssrm", "parameters": {"scene": "sphere", "resolution": "61x47"}})");
  ASSERT_EQ(hybray({"run", "small.json", "-o", "one", "--no-timing", "--threads", "1"}).exit_code, kOk);
  ASSERT_EQ(hybray({"run", "small.json", "-o", "two", "--no-timing", "--threads", "2"}).exit_code, kOk);
  CsvTable one = read_csv(folder_ / "one/small.csv"), two = read_csv(folder_ / "two/small.csv");
  ASSERT_EQ(one.rows.size(), two.rows.size());
  for (const Column& column : find_experiment("ssrm")->columns) {
    if (column.name == "threads") continue;
    const auto c = static_cast<size_t>(one.column(column.name));
    for (size_t r = 0; r < one.rows.size(); ++r) EXPECT_EQ(one.rows[r][c], two.rows[r][c]) << column.name;
  }
}

TEST_F(SsrmProgramTest, MakesTheTablesOfThePaperFromItsCsv) {
  folder_.write(
      "small.json",
      R"({"experiment": "ssrm", "parameters": {"scene": "sphere", "resolution": "1280x720", "repeats": 1, "level0_every": 0},
          "sweep": {"camera": ["front"]}})");
  ASSERT_EQ(hybray({"run", "small.json", "-o", "out"}).exit_code, kOk);
  const CsvTable table = read_csv(folder_ / "out/small.csv");
  const test::Outcome tables = test::run_process(
      {"/usr/bin/python3", HYBRAY_PROJECT_DIR "/scripts/tables.py", (folder_ / "out/small.csv").string()});
  ASSERT_EQ(tables.exit_code, 0) << tables.err;
  for (const char* text : {"Table 1.", "Table 2.", "Table 3.", "1280x720", "0.212", "0.91", "1.083"})
    EXPECT_NE(tables.out.find(text), std::string::npos) << text << "\n" << tables.out;
  const double alpha = std::stod(table.rows.at(0).at(static_cast<size_t>(table.column("alpha"))));
  char shown[16];
  std::snprintf(shown, sizeof shown, "%.3f", alpha);
  EXPECT_NE(tables.out.find(shown), std::string::npos) << tables.out;
}

TEST_F(SsrmProgramTest, RefusesASceneThatIsNotThere) {
  folder_.write("bad.json", "{\"experiment\": \"ssrm\",\n \"parameters\": {\"scene\": \"shpere\"}}");
  const test::Outcome outcome = hybray({"run", "bad.json", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_TRUE(outcome.err.starts_with("hybray: error: bad.json:2:26 (/parameters/scene): ")) << outcome.err;
  EXPECT_NE(outcome.err.find("did you mean 'sphere'?"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(SsrmProgramTest, ShowsWhatScenesThereAreAndWhatIsInThem) {
  const test::Outcome list = hybray({"scene", "list"});
  EXPECT_EQ(list.exit_code, kOk) << list.err;
  for (const char* scene : {"sphere", "atrium", "street"})
    EXPECT_NE(list.out.find(scene), std::string::npos) << scene;
  const test::Outcome info = hybray({"scene", "info", "sphere"});
  EXPECT_EQ(info.exit_code, kOk) << info.err;
  EXPECT_NE(info.out.find("triangles  "), std::string::npos);
}

TEST_F(SsrmProgramTest, ShowsTheAnalyticSurfacesOfAScene) {
  const std::string ball = hybray({"scene", "info", "closed_ball_lens"}).out;
  EXPECT_NE(ball.find("\nsurface    "), std::string::npos) << ball;
  EXPECT_NE(ball.find(": sphere of radius "), std::string::npos) << ball;
  EXPECT_NE(hybray({"scene", "info", "closed_cylinder"}).out.find(": upright cylinder of radius "),
            std::string::npos);
  EXPECT_NE(hybray({"scene", "info", "closed_paraboloid"}).out.find(": upright paraboloid of focal length "),
            std::string::npos);
  EXPECT_EQ(hybray({"scene", "info", "sphere"}).out.find("\nsurface"), std::string::npos);
}

TEST_F(SsrmProgramTest, ExportsASceneThatItCanReadAgain) {
  ASSERT_EQ(hybray({"scene", "export", "sphere", "-o", "copy.glb"}).exit_code, kOk);
  test::ProcessOptions options;
  options.environment = {{"HYBRAY_ROOT", HYBRAY_PROJECT_DIR}, {"HYBRAY_SCENE_PATH", folder_.path().string()}};
  const test::Outcome info = test::run_process({HYBRAY_PROGRAM, "scene", "info", "copy"}, options);
  EXPECT_EQ(info.exit_code, kOk) << info.err;
  const auto line = [](const std::string& text) {
    return text.substr(text.find("triangles"), text.find("vertices") - text.find("triangles"));
  };
  EXPECT_EQ(line(info.out), line(hybray({"scene", "info", "sphere"}).out));
}

TEST_F(SsrmProgramTest, RendersASceneToAPicture) {
  const test::Outcome outcome = hybray({"scene", "render", "sphere", "--resolution", "32x24", "-o", "p.png"});
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_TRUE(test::content_of(folder_ / "p.png").starts_with("\x89PNG"));
  EXPECT_EQ(hybray({"scene", "render", "sphere", "--resolution", "32"}).exit_code, kUsage);
  EXPECT_EQ(hybray({"scene", "render", "sphere", "--camera", "nowhere"}).exit_code, kUsage);
}

}  // namespace
}  // namespace hybray
