// The point where a ray met a surface: what shading needs to know of it, for triangles, analytic surfaces and
// curves alike.
#pragma once

#include "core/scene/scene.h"

namespace hybray {

// Offset off a surface relative to the largest coordinate involved: a few times the rounding of a float
// intersection.
constexpr double kSurfaceOffset = 0x1p-19;

struct SurfacePoint {
  dvec3 position{0.0};          // world space, metres
  dvec3 geometric_normal{0.0};  // unit, on the front side
  dvec3 shading_normal{0.0};    // unit, interpolated; not turned to any side
  uint32_t material = 0;
  uint32_t primitive = 0;
  double offset = 0.0;  // metres along the geometric normal that clear the rounding of the intersection
};

// The point of `primitive` that a ray met at `hit`. For a triangle, (u, v) are the barycentric weights of its
// second and third vertex and place the point; for any other primitive `hit`, moved onto its surface, does.
SurfacePoint surface_point(const Scene& scene, uint32_t primitive, float u, float v, const dvec3& hit);

// Unit geometric normal, on the front side, of any primitive at a `point` on it (within rounding).
dvec3 geometric_normal(const Scene& scene, uint32_t primitive, const dvec3& point);

}  // namespace hybray
