// Experiment `ssrm_accuracy`: strict and heuristic screen-space marchers on the same rays and buffers, with
// checks after the march, judged against traced truth. Definitions: docs/accuracy.md.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& ssrm_accuracy_experiment();

namespace ssrm_accuracy_parts {

Row run(const Point& point, Workspace& workspace);

}  // namespace ssrm_accuracy_parts
}  // namespace hybray
