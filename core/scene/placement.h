// A scene in another place and at another size, in the float coordinates of which rounding is to be studied.
#pragma once

#include "core/scene/scene.h"

namespace hybray {

// x -> scale * x + offset, in double.
struct Placement {
  double scale = 1.0;  // > 0
  dvec3 offset{0.0};   // metres, after scaling

  dvec3 operator()(const dvec3& x) const { return scale * x + offset; }
};

// `scene` there: every position, length and camera moved and rounded to float once (analytic surfaces stay in
// double); normals, ids, materials and the intensities of lights as they are. Triangles may lose their area
// by the rounding; they stay, so that ids do.
Scene placed_scene(const Scene& scene, const Placement& placement);

// A camera there.
Camera placed_camera(const Camera& camera, const Placement& placement);

}  // namespace hybray
