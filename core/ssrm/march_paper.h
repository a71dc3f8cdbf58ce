// The SSRM paper's marcher: strict, hierarchical, no heuristics, as scalar code. It is the reference that
// faster versions are held against.
#pragma once

#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"

namespace hybray::ssrm {

// The paper's three stages for one ray; the march starts at the exit of `pixel`, its own. Adds the depth
// samples read to `steps`.
Correction march_paper_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                           const MarchOptions& options, uint64_t& steps);

}  // namespace hybray::ssrm
