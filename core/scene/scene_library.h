// Scenes by name: where they are looked for, and how one is loaded.
#pragma once

#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace hybray {

// Folders of scene overlays (NAME.json) and of large sources (NAME.glb, NAME.gltf, NAME/NAME.glb,
// NAME/NAME.gltf).
struct ScenePaths {
  std::vector<std::filesystem::path> overlays;  // searched first for NAME.json
  std::vector<std::filesystem::path>
      sources;  // searched in order for glTF files: scenes/external, then HYBRAY_SCENE_PATH
};

// The project's own folders under `project_root`, then the colon-separated folders of the environment
// variable HYBRAY_SCENE_PATH.
ScenePaths default_scene_paths(const std::filesystem::path& project_root);

enum class SceneState {
  available,       // can be loaded
  source_missing,  // an overlay is there, its glTF source is not
  unknown          // nothing of that name
};

struct SceneEntry {
  std::string name;
  SceneState state = SceneState::unknown;
  std::string source;  // "generator NAME", the path of the glTF file, or what is wrong with the overlay
};

// All scenes that have an overlay or a generator, by name, and glTF files of the source folders that have
// neither. A malformed overlay is listed as `unknown`, with the message as its source.
std::vector<SceneEntry> list_scenes(const ScenePaths& paths);

// State of one scene, without loading it.
SceneEntry find_scene(const ScenePaths& paths, const std::string& name);

// Loads a scene by name. Throws InputError: unknown name (with the nearest known one), missing source (with
// the folders searched and how to fetch it), malformed overlay or glTF (with the place).
Scene load_scene(const ScenePaths& paths, const std::string& name);

}  // namespace hybray
