// What may stand in a ray's way although no pixel centre on its path shows it: the surfaces that the pixels
// beside the path see, continued past their own pixels. A march tests one depth a pixel; a silhouette that
// reaches into a pixel without covering its centre is not there for it.
#pragma once

#include "core/gbuffer/gbuffer.h"
#include "core/scene/scene.h"
#include "core/ssrm/slanted_bounds.h"

#include <optional>

namespace hybray::ssrm {

// What checks see besides the marcher's buffers. The references must outlive it; the G-buffer must hold
// primitives.
struct SurfaceView {
  const DepthView& depth;
  const GBuffer& gbuffer;
  const Scene& scene;
};

// Whether the planes of pixel a and of its neighbour n (march depth) can be of one surface that is creased at
// most between the two centres, or if not, whether n lies behind: where neither centre has the other's plane
// behind it on the same side. Half of the change of slope is allowed on top, as a curved surface needs.
bool continuous_or_behind(const DepthView& depth, ivec2 a, ivec2 n);

// Bounds over the neighbourhood depth: nothing that the surfaces seen in a pixel's 3x3 neighbours, as planes,
// have over the area of the pixel itself is nearer. All threads; `bounds` has the view's size.
void bound_neighbourhood(const DepthView& depth, SlantedBounds& bounds);

// A place where the ray meets a primitive.
struct SurfaceCrossing {
  double distance;  // metres
  uint32_t pixel;   // row-major; it stores the primitive
};

struct PathFindings {
  // The first primitive stored beside the path that the ray truly meets. Only where primitives are asked for.
  std::optional<SurfaceCrossing> met;
  // Metres; the first place before that where the ray passes behind the plane of a pixel within one pixel of
  // that pixel's centre, although it does not meet its primitive (or that was not asked), and the surface
  // there does not join the one that the ray's pixel shows.
  std::optional<double> doubtful;
  uint64_t steps = 0;  // texels read of the bounds
};

// The pixel at which a ray is next not in front of the bounds, after its own, and L where it enters it.
struct PathStop {
  uint32_t pixel;
  float l;
};

// Ray `i` from its own pixel up to screen parameter `l_end`. `with_primitives` tests the primitive behind
// each plane that the ray passes; without, every plane so passed is doubtful. `stop`: where a march against
// the bounds stopped it; none if it did not.
PathFindings search_path(const SurfaceView& surfaces, const SlantedBounds& neighbourhood,
                         const RayStream& rays, const ScreenRays& screen_rays, size_t i, double l_end,
                         const std::optional<PathStop>& stop, bool with_primitives);

}  // namespace hybray::ssrm
