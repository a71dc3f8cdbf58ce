// Experiment `ssrm_rays`: SSRM and the hybrid on other rays than one perfect reflection: rough reflections,
// ambient occlusion, shadows, several bounces.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& ssrm_rays_experiment();

}  // namespace hybray
