#include "harness/experiments/workspace.h"

#include <utility>

namespace hybray {

Workspace::Workspace(Settings settings) : settings_(std::move(settings)) {}

Workspace::~Workspace() = default;

const Scene& Workspace::scene(const std::string& name) {
  if (scene_ && scene_name_ == name) {
    ++reused_;
    return *scene_;
  }
  // The old scene goes first, so that no two are in memory at once.
  shared_.clear();
  newest_.clear();
  tracer_.reset();
  robust_tracer_.reset();
  layered_tracer_.reset();
  scene_.reset();
  scene_ = std::make_unique<Scene>(load_scene(settings_.scene_paths, name));
  scene_name_ = name;
  return *scene_;
}

// What is timed gets the best structure; truth needs the same answers, not the fastest.
const Tracer& Workspace::tracer(const std::string& scene_name) {
  return built(tracer_, scene_name, {.robust = false, .high_quality = true});
}

const Tracer& Workspace::robust_tracer(const std::string& scene_name) {
  return built(robust_tracer_, scene_name, {.robust = true, .high_quality = false});
}

const Tracer& Workspace::layered_tracer(const std::string& scene_name) {
  return built(layered_tracer_, scene_name, {.robust = true, .layers = true, .high_quality = false});
}

const Tracer& Workspace::built(std::unique_ptr<Tracer>& tracer, const std::string& scene_name,
                               const Tracer::Config& config) {
  const Scene& traced = scene(scene_name);
  if (tracer)
    ++reused_;
  else
    tracer = std::make_unique<Tracer>(traced, config);
  return *tracer;
}

}  // namespace hybray
