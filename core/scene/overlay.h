// Scene overlays (scenes/NAME.json): a source, and what is added to it or changed. The format is described in
// scenes/README.md.
#pragma once

#include "core/scene/procedural/generators.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <functional>
#include <string>

namespace hybray {

// What an overlay stands on: one of the two names is set.
struct SceneSource {
  std::string gltf;       // a scene name, or a .gltf or .glb file beside the overlay
  std::string generator;  // a procedural generator
  procedural::Parameters parameters;

  bool is_file() const { return gltf.ends_with(".glb") || gltf.ends_with(".gltf"); }
};

// Finds and loads a glTF source by scene name; `where` is the place that asks, for messages.
using LoadNamedGltf = std::function<Scene(const std::string& name, const std::string& where)>;

// The source alone. Throws InputError for a malformed overlay.
SceneSource read_overlay_source(const std::filesystem::path& file);

// The generator of that name. Throws InputError(where, ...) with the nearest known name.
const procedural::Generator& find_generator(const std::string& name, const std::string& where);

// Loads the overlay's scene: source, without the removed materials; material overrides; lights; added
// objects; cameras. Throws InputError with the file and a JSON pointer (line and column for a syntax error)
// for anything malformed or unknown.
Scene load_overlay(const std::filesystem::path& file, const LoadNamedGltf& load_named_gltf);

}  // namespace hybray
