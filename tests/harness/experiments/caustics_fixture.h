// What the tests of the experiment `caustics` share: small points of it, run without the command line.
#pragma once

#include "harness/experiments/caustics.h"
#include "harness/experiments/workspace.h"
#include "tests/temporary_folder.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

namespace hybray::test {

class CausticsFixture : public testing::Test {
 protected:
  using Changes = std::map<std::string, Value>;

  // A row with the defaults of the declaration, but small, without reference and with `changes`; camera "*"
  // is the scene's first.
  Row run(const Changes& changes, bool timing = false) {
    Workspace workspace(settings(timing));
    return run_in(workspace, changes);
  }

  // The same in a workspace that keeps what it has.
  static Row run_in(Workspace& workspace, const Changes& changes) {
    return caustics_experiment().run(point_of(workspace, changes), workspace);
  }

  static Point point_of(Workspace& workspace, const Changes& changes) {
    Point point{"0123456789abcdef", {}};
    for (const Parameter& p : caustics_experiment().parameters) point.parameters[p.name] = p.default_value;
    for (const auto& [name, value] : Changes{{"scene", text("glass_ball")},
                                             {"resolution", text("64x36")},
                                             {"map_resolution", int64_t{64}},
                                             {"frames", int64_t{4}},
                                             {"repeats", int64_t{2}},
                                             {"reference_paths", 0.0},
                                             {"reference_batches", int64_t{4}}})
      point.parameters.at(name) = value;
    for (const auto& [name, value] : changes) point.parameters.at(name) = value;
    if (point.text("camera") == "*")
      point.parameters["camera"] = workspace.scene(point.text("scene")).cameras.at(0).name;
    return point;
  }

  // Scenes of the project, and before them the overlays that the test wrote.
  Workspace::Settings settings(bool timing = false) const {
    ScenePaths paths = default_scene_paths(HYBRAY_PROJECT_DIR);
    paths.overlays.insert(paths.overlays.begin(), folder_.path());
    return {paths, folder_ / "out", 1, timing};
  }

  // Writes an overlay and gives the scene's name.
  Value overlay(const std::string& name, const std::string& json) const {
    folder_.write(name + ".json", json);
    return name;
  }

  static Value text(const char* t) { return std::string(t); }
  static double number(const Row& row, const std::string& name) { return std::get<double>(row.at(name)); }
  static int64_t integer(const Row& row, const std::string& name) { return std::get<int64_t>(row.at(name)); }
  static std::string text_of(const Row& row, const std::string& name) {
    return std::get<std::string>(row.at(name));
  }
  static bool is_empty(const Row& row, const std::string& name) {
    const auto cell = row.find(name);
    return cell == row.end() || std::holds_alternative<std::monostate>(cell->second);
  }
  static bool is_time(const std::string& name) {
    for (const Column& column : caustics_experiment().columns)
      if (column.name == name)
        return column.kind == ColumnKind::time || name == "repeats" || name == "threads";
    ADD_FAILURE() << name << " is not declared";
    return false;
  }

  // Everything but times and `excepted` is the same to the last bit.
  static void expect_same_metrics(const Row& a, const Row& b, const std::string& excepted = "") {
    for (const Column& column : caustics_experiment().columns) {
      const std::string& name = column.name;
      if (is_time(name) || name == excepted) continue;
      ASSERT_EQ(is_empty(a, name), is_empty(b, name)) << name;
      if (!is_empty(a, name)) {
        EXPECT_EQ(a.at(name), b.at(name)) << name;
      }
    }
  }

  const TemporaryFolder folder_;
};

}  // namespace hybray::test
