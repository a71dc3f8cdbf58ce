// march_plane_ray in as many lanes as the machine has, in waves of rays: the same verdicts, pixels and steps
// on every instruction set.
#pragma once

#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"
#include "core/ssrm/ray_choice.h"

#include <vector>

namespace hybray::ssrm {

// view.slanted must be built. The chosen rays, all threads; see march.h. Returns the depth
// samples read.
uint64_t march_plane_lanes(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                           const RayChoice& choice, const MarchOptions& options, MarchResults& results);

}  // namespace hybray::ssrm
