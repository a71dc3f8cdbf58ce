// The linear marcher with a thickness: a perspective-correct DDA over the screen that takes every stored
// depth for a slab (McGuire and Mara, "Efficient GPU Screen-Space Ray Tracing", JCGT 3(4), 2014). Own code
// from the paper. A heuristic: a ray inside a slab is a hit, whether or not the surface is that thick.
#pragma once

#include "core/gbuffer/view.h"
#include "core/ssrm/correction.h"

namespace hybray::ssrm {

struct DdaOptions {
  double thickness = 0.1;  // metres of view depth behind each stored depth, > 0
  double stride = 1.0;     // pixels along the ray's longer screen axis between samples, >= 1
  uint64_t max_steps = 0;  // samples a ray may read; 0: as many as reach across the screen
};

// Samples at 1, 2, ... strides from the origin along the longer axis. Sample n stands for the ray from half a
// stride before it to half a stride after it; it hits where that stretch of view depth and the slab of the
// pixel under it overlap. A pixel is never hit from itself. Verdicts: hit; the ray's own end, or `offscreen`;
// `budget`. The distance of a HIT is that of the point of the stretch nearest to the stored depth.
void march_dda(const DepthView& view, const View& camera, const RayStream& world, const ScreenRays& rays,
               const DdaOptions& options, MarchResults& results);

}  // namespace hybray::ssrm
