// The program `hybray` with the experiment `caustics`, from config to table, and what it says of bad input.
#include "harness/cli/commands.h"
#include "harness/config/schema.h"
#include "harness/table/csv.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class CausticsProgramTest : public ::testing::Test {
 protected:
  test::Outcome hybray(std::vector<std::string> arguments, const std::string& root = HYBRAY_PROJECT_DIR) {
    arguments.insert(arguments.begin(), HYBRAY_PROGRAM);
    return test::run_process(
        arguments, {folder_.path().string(), {{"HYBRAY_ROOT", root}, {"HYBRAY_CACHE_BYTES", "0"}}, ""});
  }

  // Runs one small point; its scenes are those of the generators and the overlays in scenes/ of the folder.
  test::Outcome run_point(const std::string& parameters, const std::string& reference_paths = "0") {
    std::filesystem::remove_all(folder_ / "out");
    folder_.write("point.json",
                  "{\"experiment\": \"caustics\",\n \"parameters\": {\"camera\": \"front\", \"resolution\": "
                  "\"32x18\", \"reference_paths\": " +
                      reference_paths + ", \"repeats\": 1,\n  " + parameters + "}}");
    std::filesystem::create_directories(folder_ / "scenes");
    return hybray({"run", "point.json", "-o", "out", "-q"}, folder_.path().string());
  }
  // The config or the scene is refused before anything runs, in one message that begins so.
  void expect_refused(const std::string& parameters, const std::string& message) {
    const test::Outcome outcome = run_point(parameters);
    EXPECT_EQ(outcome.exit_code, kUsage);
    EXPECT_TRUE(outcome.err.starts_with("hybray: error: " + message)) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
  // The point starts and fails with one message that ends so; there is no table.
  void expect_failed(const std::string& parameters, const std::string& message) {
    const test::Outcome outcome = run_point(parameters);
    EXPECT_EQ(outcome.exit_code, kSomeFailed);
    EXPECT_NE(outcome.err.find(") failed: " + message + "\n"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/point.csv"));
  }

  static std::string cell(const CsvTable& table, size_t row, const std::string& column) {
    return table.rows.at(row).at(static_cast<size_t>(table.column(column)));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(CausticsProgramTest, DescribesEveryParameterAndColumn) {
  const Experiment* caustics = find_experiment("caustics");
  ASSERT_NE(caustics, nullptr);
  EXPECT_EQ(hybray({"describe", "caustics", "--schema"}).out, config_schema_text(*caustics));
  const std::string text = hybray({"describe", "caustics"}).out;
  for (const Parameter& p : caustics->parameters)
    EXPECT_NE(text.find("\n" + p.name + " "), std::string::npos) << p.name;
  for (const Column& c : caustics->columns)
    EXPECT_NE(text.find("\n" + c.name + " "), std::string::npos) << c.name;
}

TEST_F(CausticsProgramTest, EveryConfigOfTheProjectIsValid) {
  size_t configs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HYBRAY_PROJECT_DIR "/configs")) {
    if (!entry.path().filename().string().starts_with("caustics_")) continue;
    ++configs;
    const test::Outcome points = hybray({"points", entry.path().string()});
    EXPECT_EQ(points.exit_code, kOk) << points.err;
    EXPECT_GE(std::count(points.out.begin(), points.out.end(), '\n'), 8) << entry.path();
  }
  EXPECT_GE(configs, 5u);
}

TEST_F(CausticsProgramTest, RunsASmallSweepToATableWithAllColumnsAndAManifest) {
  folder_.write("small.json", R"({"experiment": "caustics",
      "parameters": {"scene": "glass_ball", "resolution": "48x27", "map_resolution": 64, "frames": 3,
                     "reference_paths": 20000, "reference_batches": 3, "repeats": 2},
      "sweep": {"camera": ["front", "through"], "rays_per_texel": [0.5, 2], "caustics": [true, false]}})");
  const test::Outcome outcome = hybray({"run", "small.json", "-o", "out", "--threads", "2"});
  ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
  const CsvTable table = read_csv(folder_ / "out/small.csv");
  ASSERT_EQ(table.rows.size(), 8u);
  std::vector<std::string> header{"id"};
  for (const Column& c : find_experiment("caustics")->columns) header.push_back(c.name);
  EXPECT_EQ(table.header, header);
  for (size_t r = 0; r < table.rows.size(); ++r) {
    const bool on = cell(table, r, "caustics") == "true";
    for (const char* name : {"relmse", "energy_ratio", "photons", "total_ms", "main_view_ratio"})
      EXPECT_EQ(cell(table, r, name).empty(), !on) << name;
    EXPECT_NE(cell(table, r, "gbuffer_ms"), "");
    for (const std::string& value : table.rows[r]) {
      EXPECT_EQ(value.find("nan"), std::string::npos);
      EXPECT_EQ(value.find("inf"), std::string::npos);
    }
  }
  const auto manifest = nlohmann::json::parse(test::content_of(folder_ / "out/manifest.json"));
  EXPECT_NE(manifest.dump().find("glass_ball"), std::string::npos);

  // The same point with its metrics alone, at another number of threads.
  ASSERT_EQ(hybray({"run", "small.json", "-o", "again", "--threads", "1", "--no-timing", "-q"}).exit_code,
            kOk);
  const CsvTable again = read_csv(folder_ / "again/small.csv");
  for (const Column& c : find_experiment("caustics")->columns) {
    if (c.kind == ColumnKind::time || c.name == "threads" || c.name == "repeats") continue;
    for (size_t r = 0; r < table.rows.size(); ++r)
      EXPECT_EQ(cell(table, r, c.name), cell(again, r, c.name)) << c.name;
  }
}

TEST_F(CausticsProgramTest, FitsTheCostOfLightsAndShowsErrorsFromItsCsv) {
  // Four lamps around a glass ball, two of them in view of the camera.
  folder_.write("scenes/lamps.json",
                R"({"source": {"generator": "glass_ball"}, "replace_lights": true, "lights": [
      {"name": "a", "kind": "point", "position": [-0.8, 1.0, -1], "intensity": 20},
      {"name": "b", "kind": "point", "position": [1, 0.6, -0.5], "intensity": 20},
      {"name": "c", "kind": "point", "position": [0, 2, 5], "intensity": 20},
      {"name": "d", "kind": "point", "position": [2, 2, 5], "intensity": 20}]})");
  const char* common = R"("scene": "lamps", "camera": "front", "resolution": "32x18", "map_resolution": 32,
      "frames": 2, "repeats": 2, "reference_batches": 2)";
  folder_.write("lights.json",
                std::string(R"({"experiment": "caustics", "parameters": {"reference_paths": 0, )") + common +
                    R"(}, "sweep": {"lights_visible": [0, 1, 2], "lights_invisible": [0, 1, 2]}})");
  folder_.write("rays.json",
                std::string(R"({"experiment": "caustics", "parameters": {"reference_paths": 20000, )") +
                    common + R"(}, "sweep": {"rays_per_texel": [0.5, 2], "mirror_depth": [2, 3]}})");
  const auto fitted = [&](const std::string& name) {
    const test::Outcome run = hybray({"run", name + ".json", "-o", name, "-q"}, folder_.path().string());
    EXPECT_EQ(run.exit_code, kOk) << run.err;
    const test::Outcome fit =
        test::run_process({"/usr/bin/python3", HYBRAY_PROJECT_DIR "/scripts/caustics_fit.py",
                           (folder_ / (name + "/" + name + ".csv")).string()});
    EXPECT_EQ(fit.exit_code, 0) << fit.err;
    EXPECT_EQ(fit.err, "");
    return fit.out;
  };
  const std::string lights = fitted("lights");
  for (const char* text : {"9 points.", "### Cost of lights\n", "| a: visible, ms | ", "| b / a | ",
                           "Residual of the linear model: ", "Quadratic terms ("})
    EXPECT_NE(lights.find(text), std::string::npos) << text << "\n" << lights;
  const std::string rays = fitted("rays");
  for (const char* text :
       {"### Rays per texel (the paper's Fig. 7) (mirror_depth=2)", "(mirror_depth=3)", "| 0.5 | ",
        "### Specular depth (the paper's Fig. 8) (rays_per_texel=0.5)", "No fit of the lights"})
    EXPECT_NE(rays.find(text), std::string::npos) << text << "\n" << rays;
}

TEST_F(CausticsProgramTest, RefusesParametersOutsideTheirRangeWithTheirPlace) {
  const std::string ball = "\"scene\": \"glass_ball\", ";
  expect_refused(
      ball + "\"map_resolution\": 0",
      "point.json:3:44 (/parameters/map_resolution): found 0; expected an integer from 1 to 16384");
  expect_refused(ball + "\"mirror_depth\": 0",
                 "point.json:3:42 (/parameters/mirror_depth): found 0; expected an integer from 1 to 64");
  expect_refused(
      ball + "\"rays_per_texel\": 0",
      "point.json:3:44 (/parameters/rays_per_texel): found 0; expected a number from 0.0001 to 1000000");
  expect_refused(
      ball + "\"rays_per_texel\": 1e9",
      "point.json:3:44 (/parameters/rays_per_texel): found 1000000000.0; expected a number from 0.0001 "
      "to 1000000");
  expect_refused(ball + "\"rays_per_texel\": 1e999", "point.json:3:");
  expect_refused(ball + "\"rays_per_texel\": NaN", "point.json:3:44: this is not JSON: ");
  expect_refused(ball + "\"emission\": \"uniformly\"",
                 "point.json:3:38 (/parameters/emission): found \"uniformly\"; expected one of ");
}

TEST_F(CausticsProgramTest, MorePathsThanOnePassCanHoldAreOneError) {
  for (const char* emission : {"map", "uniform"}) {
    const std::string start = "\"scene\": \"glass_ball\", \"emission\": \"" + std::string(emission) + "\", ";
    const test::Outcome outcome = run_point(start + "\"rays_per_texel\": 1e5, \"map_resolution\": 256");
    EXPECT_EQ(outcome.exit_code, kSomeFailed);
    EXPECT_NE(outcome.err.find(") failed: rays_per_texel: 100000 asks for "), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find(" light paths in one pass; at most 16777216 can be traced\n"),
              std::string::npos);
  }
}

TEST_F(CausticsProgramTest, MoreLightsThanThereAreAreOneError) {
  expect_failed(R"("scene": "glass_ball", "lights_invisible": 2)",
                "lights_invisible: 2 lights are asked for; scene 'glass_ball' has 1 of that kind from camera "
                "'front'");
}

TEST_F(CausticsProgramTest, AnOpenBodyOfGlassFailsItsPointAndNamesObjectEdgesAndPlace) {
  folder_.write("scenes/open_pane.json", R"({"source": {"generator": "glass_ball"}, "objects": [
      {"name": "pane", "shape": "plane", "translate": [1, 1, 1],
       "material": {"base_color": [1, 1, 1], "roughness": 0, "transmission": 1, "ior": 1.5}}]})");
  const test::Outcome outcome = run_point(R"("scene": "open_pane")");
  EXPECT_EQ(outcome.exit_code, kSomeFailed);
  for (const char* part : {"failed: scene open_pane: object 'pane'", "is open at 4 edges", "thin_walled"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
  // A sheet is what the message says to make of it.
  folder_.write("scenes/sheet.json", R"({"source": {"generator": "glass_ball"}, "objects": [
      {"name": "pane", "shape": "plane", "translate": [1, 1, 1],
       "material": {"base_color": [1, 1, 1], "roughness": 0, "transmission": 1, "thin_walled": true}}]})");
  EXPECT_EQ(run_point(R"("scene": "sheet")").exit_code, kOk);
}

TEST_F(CausticsProgramTest, AnOpenAnalyticBodyOfGlassFailsItsPointLikeOneOfTriangles) {
  // The wall of a cylinder has two rims.
  folder_.write("scenes/tube.json", R"({"source": {"generator": "closed_cylinder"}, "cameras": [
      {"name": "front", "eye": [0, 3, 0.6], "target": [0, 0, 0]}],
      "materials": {"mirror": {"metallic": 0, "transmission": 1, "ior": 1.5}}})");
  const test::Outcome outcome = run_point(R"("scene": "tube")");
  EXPECT_EQ(outcome.exit_code, kSomeFailed);
  for (const char* part : {"failed: scene tube: object 'mirror'", "is open at 2 edges", "thin_walled"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << "\n" << outcome.err;
}

TEST_F(CausticsProgramTest, AnIndexOfRefractionBelowOneOrNanIsRefusedWithItsPlaceInTheScene) {
  folder_.write("scenes/low_index.json",
                R"({"source": {"generator": "glass_ball"}, "materials": {"glass": {"ior": 0.9}}})");
  folder_.write(
      "scenes/nan_index.json",
      "{\"source\": {\"generator\": \"glass_ball\"},\n \"materials\": {\"glass\": {\"ior\": NaN}}}");
  const std::string low = (folder_ / "scenes/low_index.json").string();
  expect_refused(R"("scene": "low_index")", "point.json:3:12 (/parameters/scene): " + low +
                                                ": /materials/glass/ior: 0.9 is not between 1 and 100");
  const test::Outcome nan = run_point(R"("scene": "nan_index")");
  EXPECT_EQ(nan.exit_code, kUsage);
  EXPECT_NE(nan.err.find("nan_index.json:2:"), std::string::npos) << nan.err;
  const std::pair<const char*, const char*> others[] = {
      {R"("ior": 0)", "/ior: 0 is not between 1 and 100"},
      {R"("ior": -1.5)", "/ior: -1.5 is not between 1 and 100"},
      {R"("ior": null)", "/ior: expected a number, found null"},
      {R"("outer_ior": 0.99)", "/outer_ior: 0.99 is not between 1 and 100"},
      {R"("absorption": [-1, 0, 0])", "/absorption: -1 is not between 0 and"}};
  for (const auto& [property, message] : others) {
    const std::filesystem::path file = folder_.write(
        "scenes/other_index.json", R"({"source": {"generator": "glass_ball"}, "materials": {"glass": {)" +
                                       std::string(property) + "}}}");
    expect_refused(R"("scene": "other_index")",
                   "point.json:3:12 (/parameters/scene): " + file.string() + ": /materials/glass" + message);
  }
}

TEST_F(CausticsProgramTest, AScenesOnlyLightMayBeDarkOrMissingAndMakesNoCaustic) {
  folder_.write("scenes/dark.json", R"({"source": {"generator": "glass_ball"}, "replace_lights": true,
      "lights": [{"name": "dark", "kind": "point", "position": [1, 2, 1], "intensity": 0}]})");
  folder_.write("scenes/no_light.json",
                R"({"source": {"generator": "glass_ball"}, "replace_lights": true, "lights": []})");
  for (const auto& [scene, skipped] : {std::pair("dark", "1"), {"no_light", "0"}})
    for (const char* emission : {"map", "uniform"}) {
      const test::Outcome outcome =
          run_point("\"scene\": \"" + std::string(scene) + "\", \"emission\": \"" + emission + "\"", "20000");
      EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
      EXPECT_EQ(outcome.err, "");
      const CsvTable table = read_csv(folder_ / "out/point.csv");
      EXPECT_EQ(cell(table, 0, "lights_skipped"), skipped);
      for (const char* name : {"paths", "photons", "rays_traced", "photon_pairs", "emitted_flux"})
        EXPECT_EQ(cell(table, 0, name), "0") << name;
      for (const char* name : {"relmse", "energy_ratio", "deposited_fraction", "missed_by_map_fraction"})
        EXPECT_EQ(cell(table, 0, name), "") << name;
    }
  folder_.write("scenes/negative.json", R"({"source": {"generator": "glass_ball"},
      "lights": [{"name": "sink", "kind": "point", "position": [1, 2, 1], "intensity": -5}]})");
  expect_refused(R"("scene": "negative")",
                 "point.json:3:12 (/parameters/scene): " + (folder_ / "scenes/negative.json").string() +
                     ": /lights/0/intensity: -5 is not between 0 and");
}

TEST_F(CausticsProgramTest, ALampThatTouchesTheGlassIsCountedNotLost) {
  // In the pole of the ball half of the directions start in glass and half in air: whichever medium the lamp
  // is said to lie in, other paths meet their interfaces from the wrong one. All flux stays in the account.
  folder_.write("scenes/touching.json", R"({"source": {"generator": "glass_ball"}, "replace_lights": true,
      "lights": [{"name": "touching", "kind": "point", "position": [0, 1.25, 0], "intensity": 5}]})");
  const test::Outcome outcome = run_point(R"("scene": "touching", "map_resolution": 64, "frames": 2)");
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  const CsvTable table = read_csv(folder_ / "out/point.csv");
  EXPECT_GT(std::stoll(cell(table, 0, "medium_mismatches")), 0);
  EXPECT_LE(std::stod(cell(table, 0, "ledger_residual_fraction")), 1e-9);
  EXPECT_EQ(cell(table, 0, "accumulator_overflows"), "0");
}

TEST_F(CausticsProgramTest, DarkLightsAndLightsAndCamerasInsideGlassAreNoErrors) {
  folder_.write("scenes/inside.json", R"({"source": {"generator": "glass_ball"}, "lights": [
      {"name": "dark", "kind": "point", "position": [1, 2, 1], "intensity": 0},
      {"name": "in the ball", "kind": "point", "position": [0.1, 0.8, 0], "intensity": 5}],
      "cameras": [{"name": "front", "eye": [0.2, 0.75, 0.1], "target": [1, 0, 0]}]})");
  const test::Outcome outcome = run_point(R"("scene": "inside", "map_resolution": 64, "frames": 2)");
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const CsvTable table = read_csv(folder_ / "out/point.csv");
  EXPECT_EQ(cell(table, 0, "lights_skipped"), "1");
  EXPECT_EQ(cell(table, 0, "mixed_pixels_skipped"), "0");
  EXPECT_GT(std::stoi(cell(table, 0, "photons")), 10000);
  EXPECT_LE(std::stod(cell(table, 0, "ledger_residual_fraction")), 1e-9);
}

}  // namespace
}  // namespace hybray
