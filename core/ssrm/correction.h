// Result correction: a pixel as a slanted plane (SSRM paper, third stage; DESIGN of the verdicts in
// docs/metrics.md).
#pragma once

#include "core/base/image2d.h"
#include "core/gbuffer/depth_pyramid.h"
#include "core/gbuffer/slanted_pyramid.h"
#include "core/ssrm/screen_rays.h"

namespace hybray::ssrm {

// What a marcher sees of the main view. The references must outlive it.
struct DepthView {
  const DepthPyramid& pyramid;
  const Image2D<vec2>& derivatives;         // device depth a pixel, as in GBuffer
  int depth_sign;                           // View::depth_sign()
  const SlantedPyramid* slanted = nullptr;  // for march_plane only
  int width() const { return pyramid.width(); }
  int height() const { return pyramid.height(); }
};

// A pixel as a plane: march depth at its centre and what it gains by one pixel to the right and down.
struct PixelPlane {
  double center, slope_x, slope_y;
};
inline PixelPlane pixel_plane(const DepthView& view, int x, int y) {
  const vec2 d = view.derivatives(x, y);
  return {view.pyramid.at(0, x, y), view.depth_sign * static_cast<double>(d.x),
          view.depth_sign * static_cast<double>(d.y)};
}

// The part of a ray inside pixel (x, y), as parameters L; it may end there.
struct PixelSpan {
  double enter, leave;
};
PixelSpan pixel_span(const DepthView& view, const ScreenRay<double>& ray, int x, int y);

// Signed distance, in march depth, of a ray behind the plane of one pixel, as an affine function of L: at(l)
// < 0 in front of it, > 0 behind it.
struct PlaneGap {
  double offset, slope;
  double at(double l) const { return offset + l * slope; }
  double crossing() const { return -offset / slope; }
};
inline PlaneGap plane_gap(const PixelPlane& p, const ScreenRay<double>& ray, int x, int y) {
  return {ray.oz - p.center - p.slope_x * (ray.ox - (x + 0.5)) - p.slope_y * (ray.oy - (y + 0.5)),
          ray.dz - p.slope_x * ray.dx - p.slope_y * ray.dy};
}
inline PlaneGap plane_gap(const DepthView& view, const ScreenRay<double>& ray, int x, int y) {
  return plane_gap(pixel_plane(view, x, y), ray, x, y);
}

// The slanted test. Evaluated in double from the float ray: once a ray, and free of the rounding that would
// open cracks between neighbours' planes.
struct SlantedTest {
  bool enters_in_front;  // not behind the plane where the ray enters the pixel
  bool leaves_behind;    // not in front of it where the ray leaves the pixel, or ends
  bool passes() const { return enters_in_front && leaves_behind; }
};
SlantedTest slanted_test(const DepthView& view, const ScreenRay<double>& ray, int x, int y);

// Distance, metres, at which ray `i` meets a plane in `pixel`, or that pixel's own, kept inside its stay
// there.
double plane_distance(const PixelPlane& plane, const DepthView& depth, const ScreenRays& screen_rays,
                      const RayStream& rays, const View& view, size_t i, uint32_t pixel);
double plane_distance(const DepthView& depth, const ScreenRays& screen_rays, const RayStream& rays,
                      const View& view, size_t i, uint32_t pixel);

// Verdict and accepted pixel of a ray whose march stopped at `pixel`, entered from `previous`. `origin` is
// the ray's own pixel, which is never accepted.
struct Correction {
  Verdict verdict;  // hit, behind or correction
  uint32_t pixel;
  float l = 0.0f;  // of a march: MarchResults::proved
};
Correction correct(const DepthView& view, const ScreenRay<double>& ray, ivec2 pixel, ivec2 previous,
                   ivec2 origin);

}  // namespace hybray::ssrm
