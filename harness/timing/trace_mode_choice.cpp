#include "harness/timing/trace_mode_choice.h"

#include "core/metrics/statistics.h"
#include "harness/timing/interleaved.h"

#include <algorithm>
#include <vector>

namespace hybray {
namespace {

constexpr size_t kBlock = 4096;  // neighbours stay together, or packets would look worse than they are
constexpr size_t kSampleRays = size_t{1}
                               << 17;  // about 10 ms a mode: long against the clock, short against the run
constexpr int kRepeats = 3;

std::vector<uint32_t> sample_blocks(std::span<const uint32_t> which) {
  const size_t blocks = (which.size() + kBlock - 1) / kBlock, wanted = kSampleRays / kBlock;
  const size_t stride = std::max<size_t>(1, blocks / wanted);
  std::vector<uint32_t> sample;
  for (size_t b = 0; b < blocks; b += stride)
    sample.insert(sample.end(), which.begin() + b * kBlock,
                  which.begin() + std::min(which.size(), (b + 1) * kBlock));
  return sample;
}

}  // namespace

TraceMode fastest_trace_mode(const Tracer& tracer, const RayStream& rays, std::span<const uint32_t> which,
                             HitStream& scratch, uint64_t seed) {
  const ListTrace trace = [&](std::span<const uint32_t> list, TraceMode mode) {
    tracer.trace_some(rays, list, scratch, mode);
  };
  return fastest_trace_mode(which, trace, seed);
}

TraceMode fastest_trace_mode(std::span<const uint32_t> which, const ListTrace& trace, uint64_t seed) {
  if (which.empty()) return TraceMode::single;
  const std::vector<uint32_t> sample = sample_blocks(which);
  std::vector<Variant> variants;
  for (TraceMode mode : kAllTraceModes) variants.push_back({label(mode), [&, mode] { trace(sample, mode); }});
  const InterleavedTimes times = time_interleaved(variants, kRepeats, seed);
  size_t best = 0;
  for (size_t v = 1; v < variants.size(); ++v)
    if (metrics::median(times.of(v)) < metrics::median(times.of(best))) best = v;
  return kAllTraceModes[best];
}

}  // namespace hybray
