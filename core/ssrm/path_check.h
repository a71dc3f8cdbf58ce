// What may stand in a ray's way although no pixel centre on its path shows it: the surfaces that the pixels
// beside the path see, continued past their own pixels. A march tests one depth a pixel; a silhouette that
// reaches into a pixel without covering its centre is not there for it.
#pragma once

#include "core/gbuffer/gbuffer.h"
#include "core/scene/scene.h"
#include "core/ssrm/correction.h"

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

// Pyramid over the neighbourhood depth: at level 0 the nearest depth that the surface seen in any of a
// pixel's 3x3 neighbours, as a plane, has over the area of the pixel itself. Rounded toward the viewer.
DepthPyramid neighbourhood_pyramid(const DepthView& depth);

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
  uint64_t steps = 0;  // texels read of the neighbourhood pyramid
};

// Ray `i` from its own pixel up to screen parameter `l_end`. `with_primitives` tests the primitive behind
// each plane that the ray passes; without, every plane so passed is doubtful.
PathFindings search_path(const SurfaceView& surfaces, const DepthPyramid& neighbourhood,
                         const RayStream& rays, const ScreenRays& screen_rays, size_t i, double l_end,
                         bool with_primitives);

}  // namespace hybray::ssrm
