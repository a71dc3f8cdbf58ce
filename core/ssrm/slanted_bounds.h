// Bounds over each pixel's whole area, for a march of marcher `plane` that takes them in the place of what
// pixel centres see: a ray that stays in front of them has nothing of what they bound in its way.
#pragma once

#include "core/ssrm/correction.h"

namespace hybray::ssrm {

struct SlantedBounds {
  Image2D<float> depth;      // of each pixel's bound at its centre, march depth; +infinity: nothing
  Image2D<vec2> slopes;      // of the bound, march depth a pixel
  SlantedPyramid pyramid;    // over these
  DepthPyramid first_level;  // `depth` alone, as a march wants it

  SlantedBounds(int width, int height);

  // Bounds pixel i (row-major) by the better of a flat bound and of one with these slopes, both given at the
  // centre: that which is farther there.
  void set(size_t i, float flat, float slanted, const vec2& with_slopes) {
    const bool slants = slanted > flat;
    depth[i] = slants ? slanted : flat;
    slopes[i] = slants ? with_slopes : vec2(0.0f);
  }
  // The pyramids, once all pixels are set.
  void build();

  DepthView view() const { return {first_level, slopes, 1, &pyramid}; }
};

}  // namespace hybray::ssrm
