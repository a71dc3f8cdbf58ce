// A scene's curves as Embree's own round Bezier curves. Hits carry the scene's primitive id, as those of
// triangles do.
#pragma once

#include "core/scene/scene.h"
#include "core/tracer/embree_query.h"

namespace hybray::embree {

// Attaches the curves of `scene`, of which there is at least one, to `rtc`. Embree has copies of all it
// needs.
void attach_curves(RTCDevice device, RTCScene rtc, const Scene& scene);

}  // namespace hybray::embree
