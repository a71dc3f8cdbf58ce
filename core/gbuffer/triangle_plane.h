// The plane of a triangle as the screen sees it: 1/w is affine in the pixel coordinates, so one value and two
// slopes say it all.
#pragma once

#include "core/gbuffer/view.h"
#include "core/scene/scene.h"

namespace hybray {

struct TrianglePlane {
  double inverse_w = 0.0;               // 1 / view depth at the screen point asked for, 1/m
  double slope_x = 0.0, slope_y = 0.0;  // change of inverse_w by one pixel to the right and down
};

// Plane of `triangle` at screen point (px, py). From n . (w d) = n . (a - eye): 1/w = (n . d) / (n . (a -
// eye)), d the ray direction of the point. Not finite, or not positive, where the plane is seen edge-on.
TrianglePlane triangle_plane(const View& view, const Scene& scene, uint32_t triangle, double px, double py);

}  // namespace hybray
