// The plane of a triangle, or the tangent plane of a curved primitive, as the screen sees it: 1/w is affine
// in the pixel coordinates, so one value and two slopes say it all.
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

// The same of any primitive: of an analytic surface or a curve, its tangent plane at the point seen through
// (px, py), the first one beyond the near plane. Not finite where there is no such point.
TrianglePlane tangent_plane(const View& view, const Scene& scene, uint32_t primitive, double px, double py);

// The point of a primitive seen through (px, py). Where the primitive is seen edge-on, some point of it on
// (or next to) that line of sight stands in: a vertex of a triangle.
dvec3 seen_point(const View& view, const Scene& scene, uint32_t primitive, double px, double py);

}  // namespace hybray
