#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/gltf.h"
#include "core/tracer/tracer.h"
#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/cli/scene_preview.h"
#include "harness/experiments/resolution.h"

#include <algorithm>

#include <fmt/format.h>

namespace hybray {
namespace {

const char* label(SceneState state) {
  switch (state) {
    case SceneState::available:
      return "available";
    case SceneState::source_missing:
      return "source missing";
    case SceneState::unknown:
      return "unknown";
  }
  return "";
}

std::string numbers(const vec3& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x, v.y, v.z);
}

}  // namespace

int scene_list_command(const Environment& environment) {
  const std::vector<SceneEntry> scenes = list_scenes(environment.scene_paths);
  size_t width = 0;
  for (const SceneEntry& scene : scenes) width = std::max(width, scene.name.size());
  for (const SceneEntry& scene : scenes) {
    fmt::print("{:<{}}  {:<14}  {}\n", scene.name, width, label(scene.state), scene.source);
  }
  return kOk;
}

int scene_info_command(const Environment& environment, const std::string& name) {
  const Scene scene = load_scene(environment.scene_paths, name);
  fmt::print("scene      {}\n", name);
  fmt::print("triangles  {}\n", scene.triangle_count());
  fmt::print("vertices   {}\n", scene.positions.size());
  fmt::print("objects    {}\n", scene.objects.size());
  fmt::print("materials  {}\n", scene.materials.size());
  fmt::print("lights     {}\n", scene.lights.size());
  fmt::print("bounds     {} to {} m\n", numbers(scene.bounds.lower), numbers(scene.bounds.upper));
  fmt::print("hash       {}\n", hex(scene.content_hash));
  for (const Camera& camera : scene.cameras) {
    fmt::print("camera     {}: at {} looking at {}, {:.0f} degrees\n", camera.name, numbers(camera.eye),
               numbers(camera.target), camera.vertical_fov);
  }
  return kOk;
}

int scene_export_command(const Environment& environment, const std::string& name, const std::string& file) {
  save_gltf(load_scene(environment.scene_paths, name), file);
  log_info(fmt::format("{} -> {}", name, file));
  return kOk;
}

int scene_render_command(const Environment& environment, const SceneRenderOptions& options) {
  constexpr int kLargestSide = 16384;
  const auto resolution = parse_resolution(options.resolution);
  if (!resolution || std::max(resolution->width, resolution->height) > kLargestSide) {
    throw InputError("--resolution", fmt::format("found \"{}\"; expected WIDTHxHEIGHT with each side 1 to {}",
                                                 options.resolution, kLargestSide));
  }
  const Scene scene = load_scene(environment.scene_paths, options.scene);
  if (scene.cameras.empty()) throw InputError(options.scene, "the scene has no camera");
  const Camera& camera = options.camera.empty() ? scene.cameras.front() : find_camera(scene, options.camera);
  const std::string file =
      options.file.empty() ? fmt::format("{}-{}.png", options.scene, camera.name) : options.file;
  const Tracer tracer(scene, {});
  render_preview(tracer, camera, resolution->width, resolution->height, file);
  log_info(fmt::format("{} from {} -> {}", options.scene, camera.name, file));
  return kOk;
}

}  // namespace hybray
