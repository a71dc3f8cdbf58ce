// Whatever in a scene is not a triangle, by its primitive id: analytic surfaces and curves. Each function
// does what the one of its name does in analytic_surface.h and round_curve.h.
#pragma once

#include "core/scene/scene.h"

#include <optional>

namespace hybray {

std::optional<double> nearest_hit(const Scene& scene, uint32_t primitive, const dvec3& o, const dvec3& d,
                                  double t_near, double t_far);
dvec3 outward_normal(const Scene& scene, uint32_t primitive, const dvec3& point);
dvec3 moved_onto(const Scene& scene, uint32_t primitive, const dvec3& point);
double extent(const Scene& scene, uint32_t primitive);

// A point of the primitive next to a line o + t d that passes it by no more than rounding.
dvec3 beside(const Scene& scene, uint32_t primitive, const dvec3& o, const dvec3& d);

}  // namespace hybray
