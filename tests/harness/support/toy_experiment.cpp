#include "tests/harness/support/toy_experiment.h"

#include "harness/experiments/resolution.h"
#include "harness/experiments/workspace.h"

#include <chrono>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <thread>

namespace hybray::test {
namespace {

Row run_toy(const Point& point, Workspace& workspace) {
  const std::string& behaviour = point.text("behaviour");
  if (behaviour == "throw") throw std::runtime_error("the toy broke");
  if (behaviour == "sleep") std::this_thread::sleep_for(std::chrono::milliseconds(300));
  if (behaviour == "fragile" && std::filesystem::exists(workspace.settings().output / "hammer"))
    throw std::runtime_error("the toy met a hammer");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {{"count", point.integer("count")},
          {"doubled_m", behaviour == "nan" ? nan : 2 * point.number("length")},
          {"note", behaviour == "wordy" ? std::string(20000, 'w') : "a \"quoted\", word"},
          {"toy_ms", 1.5}};
}

double toy_memory(const Point& point) {
  const auto size = *parse_resolution(point.text("resolution"));
  return 1e7 * size.width * size.height;
}

}  // namespace

std::vector<Experiment> toy_experiments() {
  using enum ParameterType;
  const Value required;
  const std::vector<Parameter> own = {
      {"count", integer, "", required, 1, 9, {}, "How many."},
      {"length", number, "m", 0.5, 0, {}, {}, "How long."},
      {"loud", boolean, "", false, {}, {}, {}, "Whether it is loud."},
      {"behaviour",
       choice,
       "",
       std::string("plain"),
       {},
       {},
       {"plain", "throw", "nan", "sleep", "wordy", "fragile"},
       "What it does."},
      {"resolution", resolution, "px", std::string("8x8"), 1, 16384, {}, "Size of nothing."},
  };
  const std::vector<Column> columns = {
      {"count", "", ColumnKind::key, Better::none, "how many"},
      {"doubled_m", "m", ColumnKind::metric, Better::lower, "twice the length"},
      {"note", "", ColumnKind::key, Better::none, "text with commas | bars"},
      {"absent", "", ColumnKind::metric, Better::none, "never given"},
      {"toy_ms", "ms", ColumnKind::time, Better::lower, "time"},
  };
  std::vector<Parameter> staged = own;
  staged.insert(staged.begin(), {{"scene", scene, "", required, {}, {}, {}, "Scene."},
                                 {"camera", camera, "", std::string("*"), {}, {}, {}, "Camera."}});
  const auto cost = [](const Point&, const SceneFacts&) { return 2.0; };
  return {{"toy", "Measures nothing.", own, columns, run_toy, toy_memory, cost},
          {"staged", "Measures nothing on a scene.", staged, columns, run_toy, toy_memory, cost}};
}

}  // namespace hybray::test
