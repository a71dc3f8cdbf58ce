// The point where a ray met a surface: what shading needs to know of it, for triangles, analytic surfaces and
// curves alike.
#pragma once

#include "core/scene/scene.h"

#include <cstdint>

namespace hybray {

// Offset off a surface relative to the largest coordinate involved: a few times the rounding of a float
// intersection.
constexpr double kSurfaceOffset = 0x1p-19;

// What decides how far off a surface a path goes on.
enum class LeavingOffset : uint8_t {
  largest,       // the largest of all coordinates and edges: clears rounding in any direction
  along_normal,  // their parts along the normal, which is where rounding can bring a point through the
                 // surface (after Pharr, Jakob and Humphreys, Physically Based Rendering, 4th ed., 6.8.6)
};
// The offset of `along_normal` relative to that: eight times the rounding of a float, which is what a
// triangle test of a few operations can add to the point's own.
constexpr double kNormalOffset = 0x1p-21;
// It is no less than these shares of it of the largest edge and coordinate: beside an edge, the test of the
// neighbouring face errs by the rounding of edges across the normal; and a plane through the origin, which
// has no rounding of its own, must be left all the same.
constexpr double kLeastOfEdge = 0x1p-2, kLeastOfPosition = 0x1p-12;

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
SurfacePoint surface_point(const Scene& scene, uint32_t primitive, float u, float v, const dvec3& hit,
                           LeavingOffset leaving = LeavingOffset::largest);

// The offset along unit `normal` at `position` of a triangle whose two edges from a vertex reach as far as
// `reach` (the largest magnitude of each coordinate).
double leaving_offset(const dvec3& position, const dvec3& normal, const dvec3& reach, LeavingOffset leaving);

// Unit geometric normal, on the front side, of any primitive at a `point` on it (within rounding).
dvec3 geometric_normal(const Scene& scene, uint32_t primitive, const dvec3& point);

}  // namespace hybray
