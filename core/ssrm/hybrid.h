// The hybrid tracer: SSRM first, the general tracer for what it leaves unresolved. Each stage is a function
// of its own, so that each can be timed.
#pragma once

#include "core/ssrm/compaction.h"
#include "core/ssrm/march.h"
#include "core/tracer/tracer.h"

#include <vector>

namespace hybray::ssrm {

// Buffers that a hybrid run needs besides its input, kept between runs so that no run pays for allocation.
struct HybridBuffers {
  MarchResults results;  // verdict and pixel of every ray
  std::vector<uint32_t> unresolved;
  HitStream hits;  // of the unresolved rays, each at its own ray's place; other places are not written

  explicit HybridBuffers(size_t rays) {
    results.resize(rays);
    unresolved.reserve(rays);
    hits.resize(rays);
  }
};

// March, compaction, trace and write-back. After it every ray has its answer: HITs in `results`, all others
// in `hits`.
void trace_hybrid(const Tracer& tracer, TraceMode mode, const DepthView& view, const RayStream& rays,
                  const ScreenRays& screen_rays, const MarchOptions& options, HybridBuffers& buffers);

// The two estimates of a hybrid's run time from its parts; alpha = share of rays that SSRM resolves.
struct HybridEstimate {
  double sequential;   // T_SS + (1 - alpha) T_HW: every ray marches, the unresolved are traced (SSRM paper)
  double partitioned;  // alpha T_SS + (1 - alpha) T_HW: a perfect predictor sends each ray straight to the
                       // right tracer
};
HybridEstimate estimate_hybrid(double alpha, double t_ss, double t_hw);

}  // namespace hybray::ssrm
