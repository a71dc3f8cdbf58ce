// Lists of rays by what a march made of them.
#pragma once

#include "core/ssrm/verdict.h"

#include <vector>

namespace hybray::ssrm {

// Indices of the rays that go on to the general tracer, in order: all but HIT. (The paper's marcher counts
// MISS, but its MISS holds at pixel centres only, so it is sent on.) `list` is reused from call to call.
void compact_unresolved(const MarchResults& results, std::vector<uint32_t>& list);

// The others.
void compact_hits(const MarchResults& results, std::vector<uint32_t>& list);

}  // namespace hybray::ssrm
