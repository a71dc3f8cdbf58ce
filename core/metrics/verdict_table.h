// SSRM's verdicts held against traced truth. Exact definitions: docs/metrics.md.
#pragma once

#include "core/gbuffer/gbuffer.h"
#include "core/ssrm/correction.h"
#include "core/truth/ray_truth.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace hybray::metrics {

// What a HIT turned out to be.
enum class HitClass : uint8_t {
  none,     // the ray is not a HIT
  right,    // |t - t*| within the tolerance
  phantom,  // truth hits nothing
  early,    // claimed before the true hit
  through,  // claimed beyond the true hit
};

struct VerdictTable {
  uint64_t rays = 0;
  std::array<uint64_t, ssrm::kVerdicts> verdicts{};         // by Verdict
  uint64_t right = 0, phantom = 0, early = 0, through = 0;  // partition the HITs
  uint64_t right_loose = 0;                                 // HITs within the loose tolerance
  uint64_t visible_true_hits = 0;                           // rays whose true hit the main view sees
  uint64_t false_misses = 0;                                // MISS verdicts of rays that truly hit something

  uint64_t count(ssrm::Verdict v) const { return verdicts[static_cast<size_t>(v)]; }
  uint64_t hits() const { return count(ssrm::Verdict::hit); }
};

// The surface that a HIT names.
struct ClaimedSurface {
  ssrm::PixelPlane plane;  // of the accepted pixel
  uint32_t primitive;
};

struct Tolerance {
  double footprint_factor = 1.0;  // k of |t - t*| <= k footprint / max(0.1, |cos|)
};

// What a HIT is that claims `primitive` at distance `claimed` along a ray which truly hits at `true_t`;
// metres, infinity for no hit. `direction` has unit length.
HitClass classify_hit(const View& view, const Scene& scene, const dvec3& origin, const dvec3& direction,
                      uint32_t primitive, double claimed, double true_t, const Tolerance& tolerance);

// Classifies every ray; a HIT lies where `results` says, else where the ray meets the plane
// of the accepted pixel. The G-buffer must hold
// primitives, whose normals give the cosine. If `classes` is not null it receives one entry a ray.
VerdictTable judge(const ssrm::MarchResults& results, const ssrm::DepthView& depth,
                   const ssrm::ScreenRays& screen_rays, const RayStream& rays, const truth::RayTruth& truth,
                   const GBuffer& gbuffer, const Scene& scene, const Tolerance& tolerance,
                   std::vector<HitClass>* classes = nullptr);

// The same for HITs on surfaces that `surface_of` knows by their ray: a marcher of several depth layers.
VerdictTable judge(const ssrm::MarchResults& results,
                   const std::function<ClaimedSurface(size_t ray)>& surface_of, const ssrm::DepthView& depth,
                   const ssrm::ScreenRays& screen_rays, const RayStream& rays, const truth::RayTruth& truth,
                   const View& view, const Scene& scene, const Tolerance& tolerance,
                   std::vector<HitClass>* classes = nullptr);

}  // namespace hybray::metrics
