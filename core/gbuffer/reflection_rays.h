// One perfect mirror reflection for each covered pixel of a view: the rays that the SSRM paper traces.
#pragma once

#include "core/base/ray_stream.h"
#include "core/gbuffer/gbuffer.h"

namespace hybray {

struct ReflectionRays {
  RayStream rays;  // covered pixels only, tiles of 8x8 pixels row by row, each along a Morton curve
  // Rays whose shading normal would have sent them into the surface (or was turned away from the viewer);
  // they are mirrored about the geometric normal instead.
  size_t mirrored_about_geometric_normal = 0;
};

// Needs the primitive and shading-normal buffers. Surfaces are two-sided: normals are turned to the viewer's
// side by the geometric normal. Origins lie on the triangle's plane at the pixel centre, moved off it along
// the geometric normal by 2^-19 of the largest of the point's coordinates and its distances to the triangle's
// vertices (of the size of an analytic surface), which is a few times the rounding of the intersection
// itself.
ReflectionRays make_reflection_rays(const GBuffer& gbuffer, const Scene& scene);

}  // namespace hybray
