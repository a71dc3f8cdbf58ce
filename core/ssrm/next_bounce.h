// Paths of several mirror reflections: where each ray of one bounce ended, the ray of the next one starts.
//
// A HIT launches the next reflection from its accepted pixel: from the ray's claimed point, moved onto the
// plane of the primitive that the pixel holds, about the pixel's shading normal. A ray that the general
// tracer answered is reflected at that tracer's hit, about the shading normal interpolated there. If the view
// shows that point (it projects into a pixel that holds the same primitive, at its depth) the next ray
// marches from that pixel; otherwise nothing is known of its surroundings, and it goes straight to the
// general tracer: its screen ray is one that ends where it starts, offscreen. A ray that hits nothing ends
// its path.
#pragma once

#include "core/gbuffer/gbuffer.h"
#include "core/ssrm/correction.h"

namespace hybray::ssrm {

struct NextBounce {
  RayStream rays;  // in the order of the rays before
  ScreenRays screen_rays;
  size_t about_geometric_normal = 0;  // reflected about it, because the shading normal would not do
  size_t unseen = 0;                  // rays that start at a point that the view does not show
};

// `hits` holds the general tracer's answer for every ray that is not a HIT in `results`. Needs the primitive
// and shading-normal buffers. All threads.
NextBounce next_bounce(const GBuffer& gbuffer, const Scene& scene, const DepthView& depth,
                       const RayStream& rays, const ScreenRays& screen_rays, const MarchResults& results,
                       const HitStream& hits);

}  // namespace hybray::ssrm
