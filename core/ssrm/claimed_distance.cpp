#include "core/ssrm/claimed_distance.h"

#include "core/ssrm/cell_walk.h"

#include <algorithm>

namespace hybray::ssrm {

double claimed_distance(const DepthView& depth, const ScreenRays& screen_rays, const RayStream& rays,
                        const View& view, size_t i, uint32_t pixel) {
  const auto ray = screen_rays.get<double>(i);
  const int x = static_cast<int>(pixel) % depth.width(), y = static_cast<int>(pixel) / depth.width();
  const Axis<double> ax{ray.ox, ray.dx, depth.width()}, ay{ray.oy, ray.dy, depth.height()};
  const double enter = std::max(ax.crossing(ax.entry_border(x)), ay.crossing(ay.entry_border(y)));
  const double leave =
      std::min({ax.crossing(ax.exit_border(x, 0)), ay.crossing(ay.exit_border(y, 0)), ray.l_end});
  const PlaneGap gap = plane_gap(depth, ray, x, y);
  // A ray inside the plane has no crossing of its own; it touches where it enters.
  const double l = gap.slope == 0.0 ? enter : std::clamp(gap.crossing(), std::min(enter, leave), leave);
  return distance_of(rays, i, view, l);
}

}  // namespace hybray::ssrm
