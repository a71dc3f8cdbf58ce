// From the configs and suites of a command to what is to run: everything loaded, checked and frozen, before
// any work begins.
#pragma once

#include "harness/sweep/freeze.h"

#include <span>
#include <string>
#include <vector>

namespace hybray {

struct PlanRequest {
  std::vector<std::string> files;                                 // configs and suites
  std::vector<std::string> assignments, filters;                  // KEY=VALUE, of the command line
  double memory_bytes = std::numeric_limits<double>::infinity();  // that a point may need
};

struct PlannedConfig {
  Config config;
  FrozenSweep sweep;  // neither points nor skipped scenes: the filters leave none
  std::vector<std::string> assignments,
      filters;  // KEY=VALUE, that apply to it: of its suite, then the command line
};

struct Plan {
  std::vector<PlannedConfig> configs;
  bool is_single = false;  // one config, and not by way of a suite
};

// Throws InputError for whatever is wrong with any of the files. Of several configs, an assignment applies to
// those whose experiment has the parameter, and a filter on it leaves the others without points; one that no
// config knows is an error, and so are filters that leave no point anywhere.
Plan make_plan(const PlanRequest& request, std::span<const Experiment> experiments, SceneCatalog& scenes);

// Estimated seconds of each point of a sweep on two cores: what several points share counts for the first of
// them.
std::vector<double> estimated_seconds(const Experiment& experiment, const FrozenSweep& sweep);

}  // namespace hybray
