// Experiments that measure nothing, so that the harness can be tested by itself.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray::test {

// `toy`, without a scene: its row repeats its parameters, or it fails in the way that `behaviour` names.
// `staged`, with a scene and a camera.
std::vector<Experiment> toy_experiments();

}  // namespace hybray::test
