// What each ray really hits, and whether the main view sees that point: robust single-ray queries in the full
// scene, never a timed run.
#pragma once

#include "core/base/ray_stream.h"
#include "core/gbuffer/view.h"
#include "core/tracer/tracer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hybray::truth {

struct RayTruth {
  HitStream hits;  // nearest hit of each ray
  std::vector<uint8_t>
      visible;  // 1 where that hit lies inside the view volume and nothing stands between it and the eye

  size_t size() const { return visible.size(); }
};

// Relative tolerance of "nothing stands between": a blocker counts if it is nearer to the eye than the point
// by more than this share of their distance.
constexpr double kVisibilityTolerance = 1e-4;

// `robust` should have been built with Tracer::Config::robust. All threads.
// `lengths`, metres, end the rays; empty: they have no end.
RayTruth trace_truth(const Tracer& robust, const RayStream& rays, const View& view,
                     std::span<const float> lengths = {});

}  // namespace hybray::truth
