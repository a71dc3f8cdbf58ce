#include "core/ssrm/march_wave.h"

#include "core/base/parallel.h"

#include <atomic>
#include <memory>

#include <tbb/enumerable_thread_specific.h>

namespace hybray::ssrm {
namespace {

// By WaveEnd; kAtEnd has its own, and kCleared none yet.
constexpr Verdict kVerdictOf[] = {Verdict::miss,   Verdict::budget,     Verdict::correction, Verdict::hit,
                                  Verdict::behind, Verdict::correction, Verdict::behind};

}  // namespace

size_t write_results(const ScreenRays& rays, int width, const MarchWave::Ended& ended,
                     MarchResults& results) {
  size_t cleared = 0;
  const bool proves = !results.proved.empty();
  // Without branches: how a ray ended is hard to predict.
  for (size_t i = 0; i < ended.count; ++i) {
    const uint32_t ray = ended.ray[i];
    const int32_t how = ended.how[i], pixel = ended.y[i] * width + ended.x[i];
    const Verdict at_end = rays.l_end[ray] <= ended.l[i] ? rays.end[ray] : Verdict::offscreen;
    results.verdict[ray] = how == kAtEnd ? at_end : kVerdictOf[how];
    results.pixel[ray] = how == kHit || how == kStopped ? static_cast<uint32_t>(pixel) : kNoPixel;
    cleared += how == kCleared;
    if (proves) results.proved[ray] = ended.l[i];
  }
  return cleared;
}

uint64_t march_in_blocks(const WaveJob& job,
                         const std::function<uint64_t(size_t, size_t, MarchWave&)>& block) {
  std::atomic<uint64_t> steps{0};
  tbb::enumerable_thread_specific<std::unique_ptr<MarchWave>> waves(std::make_unique<MarchWave>);
  const size_t parts = MarchWave::kSize / job.choice.rays_a_part();
  parallel_blocks(job.choice.parts(job.rays.size()), parts,
                  [&](size_t begin, size_t end) { steps += block(begin, end, *waves.local()); });
  return steps;
}

}  // namespace hybray::ssrm
