#include "core/gbuffer/reflection_rays.h"

#include "core/base/check.h"
#include "core/gbuffer/covered_pixels.h"
#include "core/gbuffer/facing_surface.h"

#include <atomic>

namespace hybray {

ReflectionRays make_reflection_rays(const GBuffer& g, const Scene& scene) {
  HYBRAY_CHECK(!g.primitive.empty() && !g.shading_normal.empty());
  const CoveredPixels covered(g);
  ReflectionRays result;
  result.rays.resize(covered.size());
  std::atomic<size_t> wrong_side{0};
  parallel_blocks(covered.tiles(), 64, [&](size_t begin, size_t end) {
    size_t mine = 0;
    for (size_t tile = begin; tile < end; ++tile) {
      size_t i = covered.first(tile);
      covered.visit(tile, [&](int x, int y) {
        const FacingSurface surface = seen_surface(g, scene, x, y);
        const MirrorDirection mirror = mirror_direction(surface);
        result.rays.set(i++, surface.origin, vec3(mirror.direction), g.view.pixel_index(x, y));
        mine += mirror.about_geometric;
      });
    }
    wrong_side += mine;
  });
  result.mirrored_about_geometric_normal = wrong_side;
  return result;
}

}  // namespace hybray
