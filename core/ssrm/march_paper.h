// The SSRM paper's marcher: strict, hierarchical, no heuristics. As scalar code, the reference that faster
// versions are held against, or in vector lanes (march_lanes.h), which give the same results.
#pragma once

#include "core/base/ray_stream.h"
#include "core/ssrm/correction.h"

#include <span>

namespace hybray::ssrm {

// Depth samples in one iteration, between changes of level: the paper's balance of arithmetic against memory.
inline constexpr int kSamplesPerIteration = 4;

enum class MarchCode : uint8_t { scalar, lanes };

struct MarchOptions {
  uint64_t step_budget = 0;  // depth samples a ray may read; 0 = as many as it needs (it always ends)
  MarchCode code = MarchCode::scalar;
  bool correct = true;  // false: a ray that stops is UNKNOWN (correction), for callers that ask only how far
                        // it is in front of all depth
};

// The paper's three stages for every ray, all threads. `pixels` holds each ray's own pixel
// (RayStream::pixel). The march starts at the exit of that pixel. `results` is resized by the caller to
// rays.size().
void march_paper(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                 const MarchOptions& options, MarchResults& results);

// The same for the rays listed in `which` (indices into `rays`, each at most once): each result is written to
// its ray's own place, other places stay as they were. `results.steps` counts the samples of the listed rays.
void march_paper_some(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                      std::span<const uint32_t> which, const MarchOptions& options, MarchResults& results);

// One ray. Adds the depth samples read to `steps`; `proved`, if given, receives MarchResults::proved.
Correction march_paper_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                           const MarchOptions& options, uint64_t& steps, float* proved = nullptr);

}  // namespace hybray::ssrm
