// manifest.json: what made a table, beside it.
#pragma once

#include "harness/config/config.h"
#include "harness/sweep/freeze.h"
#include "harness/sweep/run_sweep.h"

#include <string>
#include <vector>

namespace hybray {

// What the command line changed in this run.
struct RunChoices {
  std::vector<std::string> assignments, filters;
  bool timing = true;
  int threads = 0;  // that parallel loops could use
};

// The manifest as JSON text: the config as it was resolved, the program, its libraries, the machine, the
// scenes, and how the run went. Names no folder and no host.
std::string manifest_text(const Config& config, const FrozenSweep& sweep, const RunResult& result,
                          const RunChoices& choices);

}  // namespace hybray
