#include "core/ssrm/correction.h"

#include "core/ssrm/cell_walk.h"

#include <algorithm>

namespace hybray::ssrm {

PixelSpan pixel_span(const DepthView& view, const ScreenRay<double>& ray, int x, int y) {
  const Axis<double> ax{ray.ox, ray.dx, view.width()}, ay{ray.oy, ray.dy, view.height()};
  return {std::max(ax.crossing(ax.entry_border(x)), ay.crossing(ay.entry_border(y))),
          std::min({ax.crossing(ax.exit_border(x, 0)), ay.crossing(ay.exit_border(y, 0)), ray.l_end})};
}

SlantedTest slanted_test(const DepthView& view, const ScreenRay<double>& ray, int x, int y) {
  const PixelSpan span = pixel_span(view, ray, x, y);
  const PlaneGap gap = plane_gap(view, ray, x, y);
  return {gap.at(span.enter) <= 0.0, gap.at(span.leave) >= 0.0};
}

double plane_distance(const PixelPlane& plane, const DepthView& depth, const ScreenRays& screen_rays,
                      const RayStream& rays, const View& view, size_t i, uint32_t pixel) {
  const int x = static_cast<int>(pixel) % depth.width(), y = static_cast<int>(pixel) / depth.width();
  const auto ray = screen_rays.get<double>(i);
  const auto [enter, leave] = pixel_span(depth, ray, x, y);
  const PlaneGap gap = plane_gap(plane, ray, x, y);
  // A ray inside the plane has no crossing of its own; it touches where it enters.
  const double l = gap.slope == 0.0 ? enter : std::clamp(gap.crossing(), std::min(enter, leave), leave);
  return distance_of(rays, i, view, l);
}

double plane_distance(const DepthView& depth, const ScreenRays& screen_rays, const RayStream& rays,
                      const View& view, size_t i, uint32_t pixel) {
  const int x = static_cast<int>(pixel) % depth.width(), y = static_cast<int>(pixel) / depth.width();
  return plane_distance(pixel_plane(depth, x, y), depth, screen_rays, rays, view, i, pixel);
}

Correction correct(const DepthView& view, const ScreenRay<double>& ray, ivec2 pixel, ivec2 previous,
                   ivec2 origin) {
  const auto index = [&](ivec2 p) {
    return static_cast<uint32_t>(p.y) * static_cast<uint32_t>(view.width()) + static_cast<uint32_t>(p.x);
  };
  const SlantedTest here = slanted_test(view, ray, pixel.x, pixel.y);
  if (here.passes()) return {Verdict::hit, index(pixel)};
  // A ray that does not start in its own pixel may have been beside the screen.
  const bool inside =
      previous.x >= 0 && previous.y >= 0 && previous.x < view.width() && previous.y < view.height();
  if (inside && previous != origin && slanted_test(view, ray, previous.x, previous.y).passes())
    return {Verdict::hit, index(previous)};
  return {here.enters_in_front ? Verdict::correction : Verdict::behind, kNoPixel};
}

}  // namespace hybray::ssrm
