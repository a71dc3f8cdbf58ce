// The exhaustive marcher: every pixel along the ray at level 0, no hierarchy. In double it is the truth that
// any marching order is held against; in float it has the arithmetic of the hierarchical marcher and must
// give the same labels, ray for ray.
#pragma once

#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"

#include <vector>

namespace hybray::truth {

// One comparison that steered a march: which border comes first, whether the ray ends, whether it is behind
// the stored depth.
struct Decision {
  int outcome;       // -1, 0, 1: sign of a - b
  double a, b;       // the two sides
  double magnitude;  // of the largest operand that went into them: rounding is relative to it
};

// One ray by the rules of `marcher`. `Real` is float or double. Each decision is appended to `log` if there
// is one.
template <class Real>
ssrm::Correction march_level0_ray(const ssrm::DepthView& view, const ssrm::ScreenRay<Real>& ray,
                                  uint32_t pixel, uint64_t& steps, std::vector<Decision>* log = nullptr,
                                  ssrm::Marcher marcher = ssrm::Marcher::paper);

// Every `stride`-th ray (1 = all), all threads; results has one entry for each ray marched.
template <class Real>
ssrm::MarchResults march_level0(const ssrm::DepthView& view, const ssrm::ScreenRays& rays,
                                const std::vector<uint32_t>& pixels, size_t stride = 1,
                                ssrm::Marcher marcher = ssrm::Marcher::paper);

// How close the first decision was on which the float and the double march of one ray part ways, in float
// ulps of its largest operand. Infinity if no decision differs.
double first_difference_margin(const ssrm::DepthView& view, const ssrm::ScreenRays& rays, size_t ray,
                               uint32_t pixel, ssrm::Marcher marcher = ssrm::Marcher::paper);

}  // namespace hybray::truth
