#include "bench/bench_view.h"

#include "core/scene/scene_library.h"

namespace hybray::bench {

BenchView::BenchView(const std::string& scene_name, int width, int height)
    : scene(load_scene(default_scene_paths(HYBRAY_PROJECT_DIR), scene_name)),
      tracer(scene, {}),
      view(scene.cameras.at(0), {.width = width, .height = height}, scene.bounds),
      gbuffer(make_gbuffer(tracer, view, kDepth | kDepthDerivatives | kShadingNormal | kPrimitive)),
      pyramid(width, height),
      slanted(width, height),
      rays((pyramid.build(gbuffer.depth, view.depth_sign(), view.background_depth()),
            make_reflection_rays(gbuffer, scene).rays)),
      screen_rays(ssrm::project_rays(rays, view, scene.bounds)),
      buffers(rays.size()) {
  slanted.build(gbuffer.depth, gbuffer.depth_derivatives, view.depth_sign(), view.background_depth());
  hits.resize(rays.size());
  ssrm::march(depth(), screen_rays, rays.pixel, {}, buffers.results);
  ssrm::compact_unresolved(buffers.results, buffers.unresolved);
}

std::vector<std::string> bench_scenes() {
  std::vector<std::string> names;
  for (const char* name : {"atrium", "street", "sponza", "bistro"})
    if (find_scene(default_scene_paths(HYBRAY_PROJECT_DIR), name).state == SceneState::available)
      names.push_back(name);
  return names;
}

BenchView& bench_view(const std::string& scene_name) {
  static std::unique_ptr<BenchView> view;
  if (!view || view->scene.name != scene_name) {
    view.reset();
    view = std::make_unique<BenchView>(scene_name, 1920, 1080);
  }
  return *view;
}

}  // namespace hybray::bench
