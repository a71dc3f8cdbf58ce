// Runs the points of one frozen sweep and writes their rows.
#pragma once

#include "harness/config/config.h"
#include "harness/experiments/workspace.h"
#include "harness/sweep/freeze.h"

#include <filesystem>
#include <functional>
#include <string>

namespace hybray {

// Who wants to know how a run goes. All members must be set.
struct RunObserver {
  std::function<void(size_t index, const Point&)> point_starts;
  std::function<void(size_t index, const Point&)> point_done;
  std::function<void(size_t index, const Point&, const std::string& message)> point_failed;
  std::function<bool()> stop_wanted;  // asked between points
};

struct RunResult {
  size_t done = 0, failed = 0;
  bool stopped = false;  // before the last point
  double wall_seconds = 0;
  std::filesystem::path
      table;  // the complete table, or the partial one of a stopped run; empty where no point has a row
};

// Runs every point in order. A point that throws is reported and has no row; the others go on. The table is
// FOLDER/NAME.csv; it appears when the run was not stopped and some point has a row, and until then an
// earlier table of that name stays. Throws what GrowingTable's constructor throws.
RunResult run_sweep(const Config& config, const FrozenSweep& sweep, Workspace& workspace,
                    const RunObserver& observer);

// "scene=sphere resolution=1280x720": the swept parameters of a point; all of its parameters where `all` is
// set or none is swept.
std::string point_label(const Config& config, const Point& point, bool all = false);

}  // namespace hybray
