// A second look at HITs behind or after other surfaces: whether the ray really meets one of the triangles or
// curves that the accepted pixel or its neighbours hold, not only the plane that goes on beyond them.
#pragma once

#include "core/scene/scene.h"
#include "core/ssrm/march_layers.h"

namespace hybray::ssrm {

// How far from the claimed place the primitive may be met, relative to its distance.
inline constexpr double kConfirmed = 0.01;

// For each late HIT of `results`: where the world ray meets no triangle or curve of any layer of the accepted
// pixel and its four neighbours near the claimed place, the verdict becomes `correction`. HITs on analytic
// surfaces stay. All threads. Returns how many were taken back.
uint64_t confirm_late_hits(const LayeredView& view, const View& main, const Scene& scene,
                           const RayStream& rays, const ScreenRays& screen_rays, LayerResults& results);

}  // namespace hybray::ssrm
