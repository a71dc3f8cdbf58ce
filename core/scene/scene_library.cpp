#include "core/scene/scene_library.h"

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/scene/file_input.h"
#include "core/scene/gltf.h"
#include "core/scene/overlay.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray {
namespace fs = std::filesystem;
namespace {

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// A name may not climb out of the folders that are searched.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name[0] != '.' && name.find('/') == name.npos && name.find('\0') == name.npos;
}

std::optional<fs::path> find_overlay(const ScenePaths& paths, const std::string& name) {
  for (const fs::path& folder : paths.overlays)
    if (const fs::path file = folder / (name + ".json"); is_file(file)) return file;
  return std::nullopt;
}

std::optional<fs::path> find_gltf(const ScenePaths& paths, const std::string& name) {
  for (const fs::path& folder : paths.sources)
    for (const fs::path& file : {folder / (name + ".glb"), folder / (name + ".gltf"),
                                 folder / name / (name + ".glb"), folder / name / (name + ".gltf")})
      if (is_file(file)) return file;
  return std::nullopt;
}

const procedural::Generator* generator_called(const std::string& name) {
  for (const procedural::Generator& generator : procedural::generators())
    if (generator.name == name) return &generator;
  return nullptr;
}

std::string missing_source(const ScenePaths& paths, const std::string& name) {
  std::vector<std::string> folders;
  for (const fs::path& folder : paths.sources) folders.push_back(folder.string());
  return fmt::format(
      "its glTF source '{0}' ({0}.glb, {0}.gltf, {0}/{0}.glb or {0}/{0}.gltf) is in none of: {1}; run "
      "scripts/fetch_scenes.py, or set HYBRAY_SCENE_PATH to the folder that has it",
      name, folders.empty() ? "(no folders)" : fmt::format("{}", fmt::join(folders, ", ")));
}

SceneEntry overlay_entry(const ScenePaths& paths, const std::string& name, const fs::path& overlay) {
  const SceneSource source = read_overlay_source(overlay);
  if (!source.generator.empty()) return {name, SceneState::available, "generator " + source.generator};
  std::optional<fs::path> file;
  if (!source.is_file())
    file = is_plain_name(source.gltf) ? find_gltf(paths, source.gltf) : std::nullopt;
  else if (const fs::path beside = confined_path(overlay.parent_path(), source.gltf, overlay.string());
           is_file(beside))
    file = beside;
  if (file) return {name, SceneState::available, file->string()};
  return {name, SceneState::source_missing, source.gltf};
}

// Names of the overlays, generators and glTF files; the values are not used.
std::vector<std::string> all_names(const ScenePaths& paths) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::path& folder : paths.overlays)
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  for (const procedural::Generator& generator : procedural::generators()) names.emplace_back(generator.name);
  for (const fs::path& folder : paths.sources)
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      const std::string name = entry.path().stem().string();
      if (find_gltf({{}, {folder}}, name)) names.push_back(name);
    }
  std::erase_if(names, [](const std::string& name) { return !is_plain_name(name); });
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace

ScenePaths default_scene_paths(const fs::path& project_root) {
  ScenePaths paths;
  paths.overlays = {project_root / "scenes"};
  paths.sources = {project_root / "scenes" / "external"};
  if (const char* folders = std::getenv("HYBRAY_SCENE_PATH")) {
    std::istringstream list(folders);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) paths.sources.emplace_back(folder);
  }
  return paths;
}

SceneEntry find_scene(const ScenePaths& paths, const std::string& name) {
  if (!is_plain_name(name)) return {name, SceneState::unknown, ""};
  if (const auto overlay = find_overlay(paths, name)) return overlay_entry(paths, name, *overlay);
  if (generator_called(name)) return {name, SceneState::available, "generator " + name};
  if (const auto file = find_gltf(paths, name)) return {name, SceneState::available, file->string()};
  return {name, SceneState::unknown, ""};
}

std::vector<SceneEntry> list_scenes(const ScenePaths& paths) {
  std::vector<SceneEntry> entries;
  for (const std::string& name : all_names(paths)) {
    try {
      entries.push_back(find_scene(paths, name));
    } catch (const InputError& error) {
      entries.push_back({name, SceneState::unknown, error.what()});
    }
  }
  return entries;
}

Scene load_scene(const ScenePaths& paths, const std::string& name) {
  const LoadNamedGltf load_named = [&](const std::string& source, const std::string& where) {
    const auto file = is_plain_name(source) ? find_gltf(paths, source) : std::nullopt;
    if (!file) throw InputError(where, missing_source(paths, source));
    return load_gltf(*file);
  };
  Scene scene;
  if (const auto overlay = is_plain_name(name) ? find_overlay(paths, name) : std::nullopt) {
    scene = load_overlay(*overlay, load_named);
  } else if (const procedural::Generator* generator = generator_called(name)) {
    scene = generator->generate({});
    update_content_hash(scene);
  } else if (const SceneEntry entry = find_scene(paths, name); entry.state == SceneState::available) {
    scene = load_gltf(entry.source);
  } else {
    const std::vector<std::string> names = all_names(paths);
    const std::string nearest = nearest_name(name, names);
    throw InputError("scene " + name,
                     nearest.empty()
                         ? fmt::format("there is no such scene; there are: {}", fmt::join(names, ", "))
                         : fmt::format("there is no such scene; did you mean '{}'?", nearest));
  }
  scene.name = name;
  return scene;
}

}  // namespace hybray
