// Where a HIT says that its ray meets the surface.
#pragma once

#include "core/ssrm/correction.h"

namespace hybray::ssrm {

// Distance along the ray at which a HIT claims to lie: the ray's intersection with the accepted pixel's
// plane, metres.
double claimed_distance(const DepthView& depth, const ScreenRays& screen_rays, const RayStream& rays,
                        const View& view, size_t ray, uint32_t pixel);

}  // namespace hybray::ssrm
