// What freezing a sweep must know about its scenes, looked up once each.
#pragma once

#include "core/scene/scene_library.h"
#include "harness/experiments/experiment.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hybray {

class SceneCatalog {
 public:
  using State = std::function<SceneState(const std::string&)>;
  using Load = std::function<SceneFacts(const std::string&)>;  // throws InputError

  // Over the scene library: a scene is loaded when its facts are first asked for, and let go again.
  explicit SceneCatalog(ScenePaths paths);
  SceneCatalog(State state, Load load) : state_(std::move(state)), load_(std::move(load)) {}

  SceneState state(const std::string& name) const { return state_(name); }

  // Throws InputError, with the place `asked_at` before the library's own message, where the scene cannot be
  // loaded.
  const SceneFacts& facts(const std::string& name, const std::string& asked_at);

 private:
  State state_;
  Load load_;
  std::map<std::string, SceneFacts> known_;
};

}  // namespace hybray
