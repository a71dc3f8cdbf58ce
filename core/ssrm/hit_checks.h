// Checks of HITs after the march, of any marcher: evidence that the pixel-centre depths alone do not give. A
// HIT that fails becomes UNKNOWN, with the verdict `rejected`. Definitions: docs/accuracy.md.
#pragma once

#include "core/ssrm/path_check.h"

namespace hybray::ssrm {

enum class HitCheck : uint8_t {
  none,
  triangle,    // the ray meets the primitive that the accepted pixel, or else one of its 8 neighbours, stores
  continuity,  // no neighbour of the accepted pixel shows a surface in front that does not join its own
  conservative,  // the ray is in front of all surfaces beside its path, continued by half a pixel
  strict,        // triangle, the primitives beside the path, and what of `conservative` they do not explain
};
const char* label(HitCheck check);

// Whether `check` looks at paths.
constexpr bool checks_path(HitCheck check) {
  return check >= HitCheck::conservative;
}

struct CheckCounts {
  uint64_t checked = 0, rejected = 0;
  uint64_t steps = 0;  // texels read of the neighbourhood's bounds
};

// What checks of the path need besides their input, kept between runs.
struct PathCheck {
  SlantedBounds neighbourhood;  // bound_neighbourhood()
  std::vector<uint32_t> which;  // rays whose path is looked at
  MarchResults marched;         // of those, against the bounds
  std::vector<double> claimed;  // metres, where `triangle` puts their HITs

  PathCheck(const DepthView& depth, size_t rays)
      : neighbourhood(depth.width(), depth.height()), claimed(rays) {
    marched.resize(rays);
    marched.ask_proved();
  }
};

// Checks every HIT of `results`, all threads. `triangle` and `strict` also set the distance of the HITs that
// pass to that of the primitive met, and their pixel to the one that stores it. `path` may be null where it
// is not needed.
CheckCounts check_hits(const SurfaceView& surfaces, PathCheck* path, const RayStream& rays,
                       const ScreenRays& screen_rays, HitCheck check, MarchResults& results);

// The nearest of the primitives in the 3x3 block around `pixel` that ray i meets inside that block, the one
// stored in the pixel itself before all others.
std::optional<SurfaceCrossing> block_hit(const SurfaceView& surfaces, const RayStream& rays, size_t i,
                                         uint32_t pixel);

}  // namespace hybray::ssrm
