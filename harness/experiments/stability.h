// Experiment `stability`: where the buffers, the march and the tracer stop being right, as the depth format,
// the size and place of the scene, the view's angle, resolution and sub-pixel position go to extremes.
// Definitions and findings: docs/stability.md.
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& stability_experiment();

namespace stability_parts {

Row run(const Point& point, Workspace& workspace);

}  // namespace stability_parts
}  // namespace hybray
