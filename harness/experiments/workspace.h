// What a run lends to its experiments.
#pragma once

#include "core/scene/scene_library.h"
#include "core/tracer/tracer.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace hybray {

class ReferenceCache;

// Where the converged references of a run came from.
struct ReferenceCounts {
  uint64_t computed = 0;   // nothing of them was in the cache
  uint64_t continued = 0;  // some of their batches were
  uint64_t reused = 0;     // all
  uint64_t batches_computed = 0, batches_reused = 0;
};

// The most recently used scene with its acceleration structures, built when first asked for and shared by the
// points that follow.
class Workspace {
 public:
  struct Settings {
    ScenePaths scene_paths;
    std::filesystem::path output;     // folder of the run; pictures go below it
    uint64_t seed = 1;                // of the whole run
    bool timing = true;               // false: time columns stay empty, nothing is repeated
    ReferenceCache* cache = nullptr;  // of converged references; none: they are made in every run
  };

  explicit Workspace(Settings settings);
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const Settings& settings() const { return settings_; }

  // The scene of that name; throws what load_scene throws. References stay good until another scene is asked
  // for.
  const Scene& scene(const std::string& name);
  const Tracer& tracer(const std::string& scene_name);          // the fast one, which is timed
  const Tracer& robust_tracer(const std::string& scene_name);   // for buffers and for truth
  const Tracer& layered_tracer(const std::string& scene_name);  // robust, for depth layers beyond the first

  // What `make` returns, made once for each key and scene and shared by the points that follow: prepared
  // scenes, references. `key` must say all that the result depends on besides the scene. Good until another
  // scene is asked for.
  template <class T>
  const T& shared(const std::string& scene_name, const std::string& key,
                  const std::function<std::shared_ptr<T>()>& make) {
    scene(scene_name);
    if (const auto found = shared_.find(key); found != shared_.end()) {
      ++reused_;
      return *static_cast<const T*>(found->second.get());
    }
    std::shared_ptr<T> made = make();
    shared_[key] = made;
    return *made;
  }

  // The same, but only the newest result of each `kind` is kept: large things that neighbouring points share.
  template <class T>
  const T& newest(const std::string& scene_name, const std::string& kind, const std::string& key,
                  const std::function<std::shared_ptr<T>()>& make) {
    scene(scene_name);
    auto& [held_key, held] = newest_[kind];
    if (held && held_key == key) {
      ++reused_;
      return *static_cast<const T*>(held.get());
    }
    held.reset();  // before the next one is made, so that no two are in memory at once
    held = make();
    held_key = key;
    return *static_cast<const T*>(held.get());
  }

  // Work that a point did not need to do again: number of times a scene, an acceleration structure or
  // something shared was there already.
  uint64_t reused() const { return reused_; }

  // Written by the experiments.
  ReferenceCounts& references() { return references_; }
  const ReferenceCounts& references() const { return references_; }

 private:
  const Tracer& built(std::unique_ptr<Tracer>& tracer, const std::string& scene_name,
                      const Tracer::Config& config);

  Settings settings_;
  std::string scene_name_;  // of scene_
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Tracer> tracer_, robust_tracer_, layered_tracer_;
  std::map<std::string, std::shared_ptr<void>> shared_;                          // by key
  std::map<std::string, std::pair<std::string, std::shared_ptr<void>>> newest_;  // key and result by kind
  uint64_t reused_ = 0;
  ReferenceCounts references_;
};

}  // namespace hybray
