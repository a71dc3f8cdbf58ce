#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/cli/progress.h"
#include "harness/sweep/memory.h"
#include "harness/sweep/run_sweep.h"

#include <fmt/format.h>

namespace hybray {

int points_command(const Environment& environment, const PointsOptions& options) {
  const Config config = load_config(options.config, environment.experiments, options.assignments);
  SceneCatalog scenes(environment.scene_paths);
  const FrozenSweep sweep = freeze(config, scenes, {options.filters});
  const Experiment& experiment = *config.experiment;
  double total = 0;
  for (const Point& point : sweep.points) {
    const double seconds = experiment.cost_seconds ? experiment.cost_seconds(point) : 0;
    const double bytes = experiment.memory_bytes ? experiment.memory_bytes(point) : 0;
    fmt::print("{}  {}  about {:.2g} s, {}\n", point.id, point_label(config, point), seconds,
               format_bytes(bytes));
    total += seconds;
  }
  log_info(fmt::format("{} points, about {} in all", sweep.points.size(), format_duration(total)));
  for (const SkippedScene& skipped : sweep.skipped) {
    log_warning(
        fmt::format("the optional scene \"{}\" is left out, since its source is missing", skipped.scene));
  }
  return kOk;
}

}  // namespace hybray
