// Runs the points of one frozen sweep that have no row yet, and writes their rows.
#pragma once

#include "harness/experiments/workspace.h"
#include "harness/sweep/run_record.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hybray {

// Who wants to know how a run goes. All members must be set. `index` counts the points that are to do.
struct RunObserver {
  std::function<void(const std::vector<const Point*>& to_do, const RunRecord&)> run_starts;
  std::function<void(size_t index, const Point&)> point_starts;
  std::function<void(size_t index, const Point&)> point_done;
  std::function<void(size_t index, const Point&, const std::string& message)> point_failed;
  std::function<bool()> stop_wanted;  // asked before each point
};

struct RunResult {
  size_t done = 0, reused = 0, failed = 0;  // points with a row, those of them from earlier sessions; without
  bool stopped = false;                     // before the last point
  double wall_seconds = 0;                  // of this session
  std::filesystem::path table;  // the complete table, or the partial one of a stopped run; empty: no row
};

// Runs every point that has no row from an earlier session, in order. A point that throws is reported and has
// no row; the others go on. The table is FOLDER/NAME.csv; it appears when the run was not stopped and some
// point has a row, and until then an earlier table of that name stays. Throws RuntimeError where a row cannot
// be written: the rows before it are kept.
RunResult run_sweep(const RunRequest& request, Workspace& workspace, const RunObserver& observer);

// "scene=sphere resolution=1280x720": the varied parameters of a point; all of its parameters where `all` is
// set or none is varied.
std::string point_label(const Config& config, const Point& point, bool all = false);

}  // namespace hybray
