// Times of the rays of a RayFrame: marched, traced in one mode or another, and both in the hybrid, all
// interleaved.
#pragma once

#include "core/tracer/tracer.h"
#include "harness/experiments/ray_frame.h"

#include <optional>
#include <string>
#include <vector>

namespace hybray {

// Milliseconds by repeat, of all bounces together. Making rays, further bounces included, is not in them:
// every tracer needs it.
struct RayTimes {
  std::vector<double> pyramid, ss, hw, unresolved, hybrid;
  std::vector<double> hw_single, hybrid_single;  // one ray at a time; empty where the mode was given
  std::string mode, mode_unresolved;  // of hw and of unresolved; several names where the bounces differ
};

// `mode`: that of all rays and of the unresolved ones; empty: for each list of rays the fastest, by
// measurement. The frame must have rays.
RayTimes time_rays(const Tracer& tracer, const RayFrame& frame, std::optional<TraceMode> mode, int repeats,
                   uint64_t seed);

// What the formulas make of them, by repeat. With the measured cost c of an unresolved ray relative to the
// mean ray, the conditional-cost estimate T_SS + (1 - alpha) c T_HW is T_SS plus the time of the unresolved.
struct RayEstimates {
  std::vector<double> sequential, partitioned, conditional;
  std::vector<double> cost_per_unresolved,
      cost_per_ray;  // ms a ray; the first is empty without unresolved rays
};
RayEstimates estimate(const RayFrame& frame, const RayTimes& times);

}  // namespace hybray
