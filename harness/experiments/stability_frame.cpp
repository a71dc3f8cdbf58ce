#include "harness/experiments/stability_frame.h"

#include "core/base/parallel.h"
#include "core/gbuffer/facing_surface.h"
#include "harness/experiments/ssrm_frame.h"

#include <cmath>

namespace hybray::stability_parts {
namespace {

GBuffer buffers(const Tracer& robust, const View& view, const DepthStorage& storage, bool difference) {
  GBuffer g = make_gbuffer(robust, view, kDepth | kDepthDerivatives | kShadingNormal | kPrimitive);
  if (storage.format != DepthFormat::float32 || storage.rounding != DepthRounding::nearest)
    store_depths(g, robust.scene(), storage);
  if (difference) g.depth_derivatives = difference_derivatives(g.depth);
  return g;
}

bool finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

vec3 start(const FacingSurface& surface, RayOffset offset) {
  if (offset == RayOffset::scaled) return surface.origin;
  return vec3(surface.point + (offset == RayOffset::fixed ? kFixedOffset : 0.0) * surface.geometric);
}

}  // namespace

DisturbedFrame::DisturbedFrame(const Tracer& robust, const View& view, const DepthStorage& storage,
                               bool difference, const StableRays& stable, RayOffset offset)
    : gbuffer(buffers(robust, view, storage, difference)),
      pyramid(pyramid_of(gbuffer)),
      slanted(view.width(), view.height()),
      usable(stable.size(), 0) {
  slanted.build(gbuffer.depth, gbuffer.depth_derivatives, view.depth_sign(), view.background_depth(),
                SlantedPyramid::Bounds::slanted);
  rays.resize(stable.size());
  if (offset == RayOffset::split) traced.resize(stable.size());
  parallel_blocks(stable.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t pixel = stable.rays[i].pixel;
      // A ray that cannot be used stands in the list as one from the middle of the view.
      rays.set(i, vec3(view.eye() + view.near() * view.forward()), vec3(view.forward()), pixel);
      if (gbuffer.primitive[pixel] == kNoPrimitive) continue;
      const int x = static_cast<int>(pixel) % view.width(), y = static_cast<int>(pixel) / view.width();
      const FacingSurface surface = seen_surface(gbuffer, robust.scene(), x, y);
      const vec3 origin = start(surface, offset), direction(mirror_direction(surface).direction);
      if (!finite(origin) || !finite(direction) || !(view.view_depth(dvec3(origin)) > 0.0)) continue;
      rays.set(i, origin, direction, pixel);
      if (offset == RayOffset::split) traced.set(i, surface.origin, direction, pixel);
      usable[i] = 1;
    }
  });
  screen_rays = ssrm::project_rays(rays, view, robust.scene().bounds);
  for (uint32_t i = 0; i < usable.size(); ++i) {
    const auto r = screen_rays.get<float>(i);
    usable[i] = usable[i] && std::isfinite(r.ox) && std::isfinite(r.oy) && std::isfinite(r.oz) &&
                std::isfinite(r.dx) && std::isfinite(r.dy) && std::isfinite(r.dz) && !std::isnan(r.l_end);
    if (usable[i]) listed.push_back(i);
  }
}

ssrm::MarchResults DisturbedFrame::march(ssrm::Marcher marcher) const {
  ssrm::MarchResults results;
  results.verdict.assign(rays.size(), ssrm::Verdict::rejected);
  results.pixel.assign(rays.size(), ssrm::kNoPixel);
  ssrm::march_some(depth(), screen_rays, rays.pixel, listed,
                   {.code = ssrm::MarchCode::lanes, .marcher = marcher}, results);
  return results;
}

}  // namespace hybray::stability_parts
