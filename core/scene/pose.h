// A scene in another place, size and attitude: what a formula says of the one, it says of the other.
// Positions stay floats, so that what is far from the origin or turned off the axes is there as well as
// floats can say.
#pragma once

#include "core/scene/scene.h"

namespace hybray {

// x -> turn (scale x) + offset.
struct Pose {
  double scale = 1.0;  // > 0
  dmat3 turn{1.0};     // a rotation
  dvec3 offset{0.0};   // metres

  dvec3 operator()(const dvec3& x) const { return turn * (scale * x) + offset; }
  dvec3 inverse(const dvec3& x) const { return (x - offset) * turn / scale; }
};

// The rotation by `angle` radians about `axis`, right-handed; the axis need not have unit length.
dmat3 rotation(const dvec3& axis, double angle);

// `scene` placed: geometry, lights, cameras; absorption falls as lengths grow. Intensities stay: from point
// and spot lights the flux is the same then, from directional ones it grows with scale^2. Primitive ids stay
// too, so triangles whose vertices have come to lie on one line are still there. Throws InputError for a turn
// of a scene with upright analytic surfaces (cylinders, paraboloids) or fields.
Scene posed(const Scene& scene, const Pose& pose);
Camera posed(const Camera& camera, const Pose& pose);

// Leaves those triangles out, and returns how many there were.
size_t leave_out_collapsed(Scene& scene);

// The middle of the scene's bounds: as the offset that is taken away, it brings the scene to the origin,
// where floats are densest. A scene that is small against its distance from the origin is moved exactly.
dvec3 rebasing_offset(const Scene& scene);

}  // namespace hybray
