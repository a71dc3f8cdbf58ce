// Experiment `ssrm_layers`: what depth layers and a guard band add to what SSRM resolves, and what they cost.
// Definitions and findings: docs/layers.md.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& ssrm_layers_experiment();

namespace ssrm_layers_parts {

Row run(const Point& point, Workspace& workspace);

}  // namespace ssrm_layers_parts
}  // namespace hybray
