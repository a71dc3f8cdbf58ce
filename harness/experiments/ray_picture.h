// Pictures of the verdicts of a RayFrame, for people.
#pragma once

#include "harness/experiments/ray_frame.h"

namespace hybray {

// One a bounce, NAME_bounceN.png in the run's folder of pictures: at each pixel the last of the rays that
// start there.
void write_ray_pictures(const Point& point, const Workspace& workspace, const RayFrame& frame);

}  // namespace hybray
