#include "core/ssrm/hybrid.h"

#include "core/base/parallel.h"

namespace hybray::ssrm {

void compact_unresolved(const MarchResults& results, std::vector<uint32_t>& list) {
  constexpr size_t kBlock = 16384;
  const size_t n = results.size(), blocks = (n + kBlock - 1) / kBlock;
  std::vector<size_t> first(blocks + 1, 0);
  parallel_blocks(n, kBlock, [&](size_t begin, size_t end) {
    size_t count = 0;
    for (size_t i = begin; i < end; ++i) count += results.verdict[i] != Verdict::hit;
    first[begin / kBlock + 1] = count;
  });
  for (size_t b = 0; b < blocks; ++b) first[b + 1] += first[b];
  list.resize(first[blocks]);
  parallel_blocks(n, kBlock, [&](size_t begin, size_t end) {
    uint32_t* out = list.data() + first[begin / kBlock];
    for (size_t i = begin; i < end; ++i)
      if (results.verdict[i] != Verdict::hit) *out++ = static_cast<uint32_t>(i);
  });
}

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
