#include "core/ssrm/hybrid.h"

namespace hybray::ssrm {

void trace_hybrid(const Tracer& tracer, TraceMode mode, const DepthView& view, const RayStream& rays,
                  const ScreenRays& screen_rays, const MarchOptions& options, HybridBuffers& buffers) {
  march(view, screen_rays, rays.pixel, options, buffers.results);
  compact_unresolved(buffers.results, buffers.unresolved);
  tracer.trace_some(rays, buffers.unresolved, buffers.hits, mode);
}

HybridEstimate estimate_hybrid(double alpha, double t_ss, double t_hw) {
  return {t_ss + (1.0 - alpha) * t_hw, alpha * t_ss + (1.0 - alpha) * t_hw};
}

}  // namespace hybray::ssrm
