// A strict marcher whose pixels are slanted planes all the way: a pixel stops a ray where, somewhere inside
// the pixel, the ray is behind the pixel's plane. Where it enters in front and leaves behind, that is a HIT;
// where it enters behind already, UNKNOWN (`behind`). Rays along a surface, which the paper's flat test
// stops, go on. Slanted bounds (core/gbuffer/slanted_pyramid.h) keep whole cells clear of such surfaces, and
// the march goes a level up where it leaves the cell of that level. Labels are those of a walk through every
// pixel.
#pragma once

#include "core/gbuffer/slanted_pyramid.h"
#include "core/ssrm/correction.h"
#include "core/ssrm/march_options.h"

#include <algorithm>
#include <cmath>

namespace hybray::ssrm {

// The march depth of a ray's origin, moved away from the viewer by what float code may err in comparing the
// ray with a slanted bound: a few roundings of that depth. (Bounds make up for their own part.)
inline constexpr float kOriginSlack = 0x1p-21f;
inline float origin_with_slack(float oz) {
  return oz + kOriginSlack * std::abs(oz);
}

// Neighbouring pixels of one plane, whose depths and slopes are rounded to float, meet within that share of
// their sum. By less than that a ray is not known to be behind a plane; nor is it known in which pixel it met
// a plane that it was behind by less where it came in: then it is UNKNOWN (`behind`), not a HIT.
inline constexpr double kBufferRounding = 0x1p-22;

// Whether the ray may be behind the texel's bound somewhere between `enter` and `leave`; center: of the
// texel's square, pixels.
inline bool may_be_behind(const SlantedTexel& texel, const ScreenRay<float>& ray, float center_x,
                          float center_y, float enter, float leave) {
  const float across = texel.slope_x() * (center_x - ray.ox) + texel.slope_y() * (center_y - ray.oy);
  const float bound = (texel.depth - origin_with_slack(ray.oz)) - across;  // minus the ray's, at l = 0
  const float slope = ray.dz - (texel.slope_x() * ray.dx + texel.slope_y() * ray.dy);
  return std::max(enter * slope, leave * slope) > bound;
}
// The same for the texel of `level` that holds pixel (x, y).
inline bool may_be_behind(const SlantedPyramid& bounds, int level, int x, int y, const ScreenRay<float>& ray,
                          float enter, float leave) {
  const int cell_x = x >> level, cell_y = y >> level;
  const float half = 0.5f * static_cast<float>(1 << level);
  return may_be_behind(bounds.at(level, cell_x, cell_y), ray, static_cast<float>(2 * cell_x + 1) * half,
                       static_cast<float>(2 * cell_y + 1) * half, enter, leave);
}

// Where a ray is with respect to the plane of one pixel while it is inside that pixel. In double, from the
// float ray and buffers.
enum class PixelCrossing : uint8_t { in_front, hit, behind };
PixelCrossing pixel_crossing(const DepthView& view, const ScreenRay<double>& ray, int x, int y);

// A march under way, at level 0, where the ray entered pixel (x, y).
struct PlaneMarch {
  int x, y;
  float l;             // of the entry
  uint64_t taken = 0;  // depth samples read so far, of a budget
  int samples = 0;     // of this iteration (Ascent::iteration)
  bool clear = false;  // whether the ray is known to be in front of this pixel's plane
};
Correction continue_plane_ray(const DepthView& view, const ScreenRay<float>& ray, const PlaneMarch& from,
                              const MarchOptions& options, uint64_t& steps);

// One ray. Adds the depth samples read to `steps`.
Correction march_plane_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                           const MarchOptions& options, uint64_t& steps);

}  // namespace hybray::ssrm
