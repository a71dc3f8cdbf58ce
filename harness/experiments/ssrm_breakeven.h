// Experiment `ssrm_breakeven`: whether the hybrid pays for a scene, kind of rays and mode of the general
// tracer, and which formula foretold it.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& ssrm_breakeven_experiment();

}  // namespace hybray
