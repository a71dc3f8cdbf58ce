// The hierarchical marcher with a thickness and a confidence, in the style of stochastic screen-space
// reflections (AMD FidelityFX SSSR; Hi-Z tracing after Uludag, "Hi-Z Screen-Space Cone-Traced Reflections",
// GPU Pro 5, 2014). Own code from the descriptions: pixels face the viewer, the first one that the ray is
// behind is the only candidate, and a validation gives it a confidence.
#pragma once

#include "core/gbuffer/gbuffer.h"
#include "core/ssrm/correction.h"

#include <optional>

namespace hybray::ssrm {

struct HizOptions {
  double thickness = 0.1;   // metres between the hit and the surface at which confidence reaches 0, > 0
  double confidence = 0.1;  // least confidence of a HIT, in [0, 1]
  uint64_t max_steps = 0;   // cells a ray may read; 0: as many as it needs (it always ends)
};

// Where the traversal stopped: inside `pixel`, at screen parameter l, on or behind the stored depth.
struct HizCandidate {
  Verdict verdict;  // hit: a candidate; else as march_paper
  uint32_t pixel;
  double l;
};
HizCandidate hiz_traverse(const DepthView& view, const ScreenRay<float>& ray, uint32_t origin,
                          const HizOptions& options, uint64_t& steps);

// Confidence in [0, 1] of a candidate of ray i: 0 within two pixels of the ray's own pixel and on surfaces
// seen from behind; else the square of a smooth fall over the thickness, faded over the outer 5 % of the
// screen.
double hiz_confidence(const GBuffer& gbuffer, const RayStream& world, size_t i, const ScreenRay<float>& ray,
                      const HizCandidate& candidate, double thickness);

// The G-buffer must hold depth and geometric normals. Candidates below the confidence end as `rejected`. The
// distance of a HIT is that of the place where the traversal stopped.
void march_hiz(const DepthView& view, const GBuffer& gbuffer, const RayStream& world, const ScreenRays& rays,
               const HizOptions& options, MarchResults& results);

}  // namespace hybray::ssrm
