// The buffers and rays of one view, as every marching test needs them.
#pragma once

#include "core/gbuffer/reflection_rays.h"
#include "core/ssrm/march.h"
#include "core/tracer/tracer.h"

namespace hybray::test {

struct MainView {
  GBuffer gbuffer;
  DepthPyramid pyramid;
  SlantedPyramid slanted;
  RayStream rays;
  ssrm::ScreenRays screen_rays;

  MainView(const Tracer& tracer, const View& view)
      : gbuffer(make_gbuffer(tracer, view, kDepth | kDepthDerivatives | kShadingNormal | kPrimitive)),
        pyramid(view.width(), view.height()),
        slanted(view.width(), view.height()) {
    pyramid.build(gbuffer.depth, view.depth_sign(), view.background_depth());
    slanted.build(gbuffer.depth, gbuffer.depth_derivatives, view.depth_sign(), view.background_depth());
    rays = make_reflection_rays(gbuffer, tracer.scene()).rays;
    screen_rays = ssrm::project_rays(rays, view, tracer.scene().bounds);
  }
  ssrm::DepthView depth() const {
    return {pyramid, gbuffer.depth_derivatives, gbuffer.view.depth_sign(), &slanted};
  }
  ssrm::MarchResults march(const ssrm::MarchOptions& options = {}) const {
    ssrm::MarchResults results;
    results.resize(rays.size());
    ssrm::march(depth(), screen_rays, rays.pixel, options, results);
    return results;
  }
};

}  // namespace hybray::test
