#include "core/gbuffer/depth_storage.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/gbuffer/triangle_plane.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace {

// Steps between 0 and 1; 0: not a fixed-point format.
double steps_of(DepthFormat format) {
  switch (format) {
    case DepthFormat::float32:
      break;
    case DepthFormat::unorm24:
      return 0xffffff;
    case DepthFormat::unorm16:
      return 0xffff;
  }
  return 0.0;
}

// The float next to `value`, but not beyond it on the far side.
float rounded(double value, DepthConvention convention, DepthRounding rounding) {
  const float nearest = static_cast<float>(value);
  if (rounding == DepthRounding::nearest) return nearest;
  const bool near_is_low = convention == DepthConvention::standard;
  const double error = static_cast<double>(nearest) - value;
  if (near_is_low ? error <= 0.0 : error >= 0.0) return nearest;
  return std::nextafter(nearest, near_is_low ? 0.0f : 1.0f);
}

}  // namespace

float stored_depth(double device_depth, DepthConvention convention, const DepthStorage& storage) {
  const double steps = steps_of(storage.format);
  if (steps == 0.0) return rounded(device_depth, convention, storage.rounding);
  const double scaled = device_depth * steps;
  const double step = storage.rounding == DepthRounding::nearest ? std::nearbyint(scaled)
                      : convention == DepthConvention::standard  ? std::floor(scaled)
                                                                 : std::ceil(scaled);
  return rounded(step / steps, convention, storage.rounding);
}

void store_depths(GBuffer& g, const Scene& scene, const DepthStorage& storage) {
  HYBRAY_CHECK(!g.depth.empty() && !g.primitive.empty());
  const View& view = g.view;
  parallel_blocks(static_cast<size_t>(view.height()), 8, [&](size_t first, size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
      for (int x = 0; x < view.width(); ++x) {
        if (g.primitive(x, y) == kNoPrimitive) continue;
        const double inverse_w = tangent_plane(view, scene, g.primitive(x, y), x + 0.5, y + 0.5).inverse_w;
        if (!(inverse_w > 0.0) || !std::isfinite(inverse_w)) continue;
        const double depth = std::clamp(view.depth_a() + view.depth_b() * inverse_w, 0.0, 1.0);
        g.depth(x, y) = stored_depth(depth, view.convention(), storage);
      }
  });
}

}  // namespace hybray
