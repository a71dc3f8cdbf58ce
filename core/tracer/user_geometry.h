// A scene's analytic surfaces as Embree user geometry: exact intersection in double precision, for single
// rays and packets of any width. Hits carry the scene's primitive id, as triangles do.
#pragma once

#include "core/scene/scene.h"
#include "core/tracer/embree_query.h"

namespace hybray::embree {

// Attaches the analytic surfaces of `scene`, of which there is at least one, to `rtc`. `scene` must outlive
// it.
void attach_analytic_surfaces(RTCDevice device, RTCScene rtc, const Scene& scene);

}  // namespace hybray::embree
