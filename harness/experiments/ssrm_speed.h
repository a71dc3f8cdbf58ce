// Experiment `ssrm_speed`: what the hybrid costs and saves, every design in one interleaved run: the march as
// scalar code and in lanes, march all, predicted, oracle, free marcher, and the remaining segment.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& ssrm_speed_experiment();

namespace ssrm_speed_parts {

Row run(const Point& point, Workspace& workspace);

}  // namespace ssrm_speed_parts
}  // namespace hybray
