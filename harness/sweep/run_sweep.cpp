#include "harness/sweep/run_sweep.h"

#include "harness/table/growing_table.h"

#include <utility>

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

RunResult run_sweep(const RunRequest& request, Workspace& workspace, const RunObserver& observer) {
  const Experiment& experiment = *request.config.experiment;
  RunRecord record(request, workspace.settings().output);
  const std::vector<const Point*> to_do = record.to_do();
  observer.run_starts(to_do, record);
  RunResult result;
  for (size_t i = 0; i < to_do.size(); ++i) {
    result.stopped = observer.stop_wanted();
    if (result.stopped) break;
    const Point& point = *to_do[i];
    observer.point_starts(i, point);
    std::string line;
    try {
      line = table_line(experiment.columns, point.id, run_point(experiment, point, workspace));
    } catch (const std::exception& error) {
      record.failed(point, error.what());
      observer.point_failed(i, point, error.what());
      continue;
    }
    record.done(point, std::move(line));  // a row that cannot be written ends the run: so would all others
    observer.point_done(i, point);
  }
  record.count_references(workspace.references());
  result.table = record.close(result.stopped);
  const RunState& state = record.state();
  result.done = state.done, result.reused = state.reused, result.failed = state.failures.size();
  result.wall_seconds = state.sessions.back().wall_time_s.value_or(0);
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
  for (const Parameter* parameter : varied_parameters(config)) add(parameter->name);
  return label.empty() ? point_label(config, point, true) : label;
}

}  // namespace hybray
