// A surface as a ray meets it, with its normals turned to the side that the ray comes from, and the mirror
// direction there.
#pragma once

#include "core/gbuffer/gbuffer.h"

namespace hybray {

struct FacingSurface {
  dvec3 point{0.0};
  dvec3 incoming{0.0};   // unit direction of the ray that met it
  dvec3 geometric{0.0};  // unit, against the incoming ray
  dvec3 shading{0.0};    // unit, turned with it; may still face away from the ray
  vec3 origin{0.0f};     // of rays that leave on that side: off the surface by 2^-19 of the largest of the
                         // point's coordinates and its distances to the triangle's vertices (of the size of
                         // an analytic surface), a few times the rounding of the intersection itself
};

// Of `primitive` at `point` (within rounding), with its interpolated normal there.
FacingSurface facing_surface(const Scene& scene, uint32_t primitive, const dvec3& point,
                             const dvec3& shading_normal, const dvec3& incoming);

// What pixel (x, y) sees at its centre. Needs the primitive and shading-normal buffers.
FacingSurface seen_surface(const GBuffer& g, const Scene& scene, int x, int y);

struct MirrorDirection {
  dvec3 direction{0.0};         // unit
  bool about_geometric{false};  // the shading normal faced away or would have sent the ray into the surface
};
MirrorDirection mirror_direction(const FacingSurface& surface);

}  // namespace hybray
