// march_paper_ray in as many lanes as the machine has, in waves of rays: the same verdicts, pixels and steps
// on every instruction set.
#pragma once

#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"
#include "core/ssrm/ray_choice.h"

#include <vector>

namespace hybray::ssrm {

// The chosen rays, all threads; see march.h. Returns the depth samples read.
uint64_t march_paper_lanes(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                           const RayChoice& choice, const MarchOptions& options, MarchResults& results);

}  // namespace hybray::ssrm
