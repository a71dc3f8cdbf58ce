// march_paper in as many lanes as the machine has, in waves of rays: the same verdicts, pixels and steps on
// every instruction set.
#pragma once

#include "core/ssrm/march_paper.h"

namespace hybray::ssrm {

void march_paper_lanes(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                       const MarchOptions& options, MarchResults& results);

// march_paper_some.
void march_paper_lanes_some(const DepthView& view, const ScreenRays& rays,
                            const std::vector<uint32_t>& pixels, std::span<const uint32_t> which,
                            const MarchOptions& options, MarchResults& results);

}  // namespace hybray::ssrm
