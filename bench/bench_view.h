// One view of a scene with everything that the benchmarked kernels take and give.
#pragma once

#include "core/gbuffer/reflection_rays.h"
#include "core/ssrm/hybrid.h"
#include "core/tracer/tracer.h"

#include <memory>
#include <string>
#include <vector>

namespace hybray::bench {

struct BenchView {
  Scene scene;
  Tracer tracer;
  View view;
  GBuffer gbuffer;
  DepthPyramid pyramid;
  SlantedPyramid slanted;
  RayStream rays;
  ssrm::ScreenRays screen_rays;
  ssrm::HybridBuffers buffers;
  HitStream hits;

  BenchView(const std::string& scene_name, int width, int height);
  ssrm::DepthView depth() const { return {pyramid, gbuffer.depth_derivatives, view.depth_sign(), &slanted}; }
};

// The scenes to measure that can be loaded here: atrium, street and, where they are found, sponza and bistro.
std::vector<std::string> bench_scenes();

// The view of the scene's first camera at 1920x1080; the last one asked for stays in memory.
BenchView& bench_view(const std::string& scene_name);

}  // namespace hybray::bench
