#include "harness/sweep/scene_catalog.h"

#include "core/base/error.h"
#include "harness/sweep/specular_share.h"

namespace hybray {
namespace {

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts{
      scene.content_hash, scene.triangle_count(), {}, scene.lights.size(), specular_share(scene)};
  for (const Camera& camera : scene.cameras) facts.cameras.push_back(camera.name);
  return facts;
}

}  // namespace

SceneCatalog::SceneCatalog(ScenePaths paths)
    : state_([paths](const std::string& name) { return find_scene(paths, name).state; }),
      load_([paths](const std::string& name) { return facts_of(load_scene(paths, name)); }) {}

const SceneFacts& SceneCatalog::facts(const std::string& name, const std::string& asked_at) {
  const auto known = known_.find(name);
  if (known != known_.end()) return known->second;
  try {
    return known_.emplace(name, load_(name)).first->second;
  } catch (const InputError& error) {
    throw InputError(asked_at, error.what());
  }
}

}  // namespace hybray
