// The same rays in the float pipeline, in the scene where a point puts it and with the depth that it stores.
#pragma once

#include "core/gbuffer/slanted_pyramid.h"
#include "core/ssrm/march.h"
#include "harness/experiments/stability_truth.h"

#include <optional>
#include <vector>

namespace hybray::stability_parts {

// Where mirror rays start.
enum class RayOffset {
  scaled,  // off the surface by a share of the coordinates, as in every experiment
  fixed,   // by kFixedOffset, whatever the coordinates
  none,    // on it, as well as float can say
  split,   // marched from the surface, traced from off it (scaled)
};
inline constexpr double kFixedOffset = 1e-4;  // metres

struct DisturbedFrame {
  GBuffer gbuffer;
  DepthPyramid pyramid;
  SlantedPyramid slanted;
  RayStream rays;                // as marched, of the pixels of StableRays, in order
  RayStream traced;              // as traced; empty: the same
  std::vector<uint8_t> usable;   // of each: whether it is finite and starts in front of the eye
  std::vector<uint32_t> listed;  // the usable ones
  ssrm::ScreenRays screen_rays;

  // `robust`: of the placed scene. `difference`: depth derivatives by differences of the stored depth.
  DisturbedFrame(const Tracer& robust, const View& view, const DepthStorage& storage, bool difference,
                 const StableRays& stable, RayOffset offset);

  ssrm::DepthView depth() const {
    return {pyramid, gbuffer.depth_derivatives, gbuffer.view.depth_sign(), &slanted};
  }
  const RayStream& traced_rays() const { return traced.size() ? traced : rays; }
  // Results of rays that are not usable are `rejected`.
  ssrm::MarchResults march(ssrm::Marcher marcher) const;
};

}  // namespace hybray::stability_parts
