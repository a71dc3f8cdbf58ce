// Which way of asking Embree is the fastest for a list of rays: found by measuring, never assumed.
#pragma once

#include "core/tracer/tracer.h"

#include <cstdint>
#include <functional>
#include <span>

namespace hybray {

// The mode with the smallest median time over blocks of neighbouring rays spread evenly over `which` (indices
// into `rays`). All modes are timed interleaved on the same rays. Results land in `scratch` (as many entries
// as rays).
TraceMode fastest_trace_mode(const Tracer& tracer, const RayStream& rays, std::span<const uint32_t> which,
                             HitStream& scratch, uint64_t seed);

// The same for any way of tracing a list of rays: `trace` handles the listed rays in a mode.
using ListTrace = std::function<void(std::span<const uint32_t>, TraceMode)>;
TraceMode fastest_trace_mode(std::span<const uint32_t> which, const ListTrace& trace, uint64_t seed);

}  // namespace hybray
