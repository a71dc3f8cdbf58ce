#include "harness/sweep/run_sweep.h"

#include "harness/table/growing_table.h"

#include <chrono>

namespace hybray {
namespace {

// The row of one point. Without timing, no time leaves the experiment.
Row run_point(const Experiment& experiment, const Point& point, Workspace& workspace) {
  Row row = experiment.run(point, workspace);
  if (workspace.settings().timing) return row;
  for (const Column& column : experiment.columns) {
    if (column.kind == ColumnKind::time) row.erase(column.name);
  }
  return row;
}

}  // namespace

RunResult run_sweep(const Config& config, const FrozenSweep& sweep, Workspace& workspace,
                    const RunObserver& observer) {
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path folder = workspace.settings().output;
  GrowingTable table(folder, config.name, config.experiment->columns);
  RunResult result;
  for (size_t i = 0; i < sweep.points.size() && !result.stopped; ++i) {
    const Point& point = sweep.points[i];
    observer.point_starts(i, point);
    try {
      table.append(point.id, run_point(*config.experiment, point, workspace));
      ++result.done;
      observer.point_done(i, point);
    } catch (const std::exception& error) {
      ++result.failed;
      observer.point_failed(i, point, error.what());
    }
    result.stopped = observer.stop_wanted() && i + 1 < sweep.points.size();
  }
  if (result.done > 0) {
    result.table = result.stopped ? table.partial_file() : table.file();
    std::vector<std::string> ids;
    for (const Point& point : sweep.points) ids.push_back(point.id);
    if (!result.stopped) table.finish(ids);
  }
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string point_label(const Config& config, const Point& point, bool all) {
  std::string label;
  const auto add = [&](const std::string& name) {
    label += (label.empty() ? "" : " ") + name + "=" + to_text(point.parameters.at(name));
  };
  if (all) {
    for (const Parameter& parameter : config.experiment->parameters) add(parameter.name);
    return label;
  }
  for (const Setting& setting : config.sweep) add(setting.parameter->name);
  for (const Setting& setting : config.fixed) {
    if (setting.parameter->type == ParameterType::camera && setting.values.front() == Value("*"))
      add(setting.parameter->name);
  }
  return label.empty() ? point_label(config, point, true) : label;
}

}  // namespace hybray
