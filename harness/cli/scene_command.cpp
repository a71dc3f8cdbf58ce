#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/gltf.h"
#include "core/tracer/seeded_camera.h"
#include "core/tracer/tracer.h"
#include "harness/cli/commands.h"
#include "harness/cli/log.h"
#include "harness/cli/scene_preview.h"
#include "harness/experiments/resolution.h"
#include "harness/table/text_table.h"

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

template <class Vector>
std::string numbers(const Vector& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v.x, v.y, v.z);
}

// "sphere of radius 0.5 m about (0.00, 0.50, 0.00)".
std::string shape_words(const AnalyticSurface& s) {
  switch (s.kind) {
    case AnalyticSurface::Kind::sphere:
      return fmt::format("sphere of radius {:.4g} m about {}", s.radius, numbers(s.center));
    case AnalyticSurface::Kind::cylinder:
      return fmt::format(
          "upright cylinder of radius {:.4g} m about x = {:.2f}, z = {:.2f}, from y = {:.2f} to {:.2f}",
          s.radius, s.center.x, s.center.z, s.y0, s.y1);
    case AnalyticSurface::Kind::paraboloid:
      return fmt::format("upright paraboloid of focal length {:.4g} m and rim radius {:.4g} m, vertex at {}",
                         s.focal_length, s.radius, numbers(s.center));
    case AnalyticSurface::Kind::field:
      return fmt::format("{} within {:.4g} m about {}, by its distance field", label(s.field.shape), s.radius,
                         numbers(s.center));
  }
  return "";
}

// Seeded cameras are found by the tracer that the experiments find them with.
Camera camera_of_scene(const Scene& scene, const std::string& name) {
  if (!seeded_camera_number(name)) return find_camera(scene, name);
  return camera_of(Tracer(scene, {.robust = true, .high_quality = false}), name);
}

}  // namespace

int scene_list_command(const Environment& environment) {
  TextTable table;
  for (const SceneEntry& scene : list_scenes(environment.scene_paths))
    table.push_back({scene.name, label(scene.state), scene.source});
  fmt::print("{}", aligned_table(table));
  return kOk;
}

int scene_info_command(const Environment& environment, const std::string& name) {
  const Scene scene = load_scene(environment.scene_paths, name);
  fmt::print("scene      {}\n", name);
  fmt::print("triangles  {}\n", scene.triangle_count());
  if (!scene.curves.empty()) fmt::print("curves     {}\n", scene.curves.size());
  fmt::print("vertices   {}\n", scene.positions.size());
  fmt::print("objects    {}\n", scene.objects.size());
  fmt::print("materials  {}\n", scene.materials.size());
  fmt::print("lights     {}\n", scene.lights.size());
  fmt::print("bounds     {} to {} m\n", numbers(scene.bounds.lower), numbers(scene.bounds.upper));
  fmt::print("hash       {}\n", hex(scene.content_hash));
  for (const AnalyticSurface& surface : scene.analytic) {
    fmt::print("surface    {}: {}, material {}\n", surface.name, shape_words(surface),
               scene.materials[surface.material].name);
  }
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
  if (options.camera.empty() && scene.cameras.empty())
    throw InputError(options.scene, "the scene has no camera");
  const Camera camera =
      options.camera.empty() ? scene.cameras.front() : camera_of_scene(scene, options.camera);
  std::string file =
      options.file.empty() ? fmt::format("{}-{}.png", options.scene, camera.name) : options.file;
  if (options.file.empty()) std::replace(file.begin(), file.end(), '/', '-');
  const Tracer tracer(scene, {});
  render_preview(tracer, camera, resolution->width, resolution->height, file);
  log_info(fmt::format("{} from {} -> {}", options.scene, camera.name, file));
  return kOk;
}

}  // namespace hybray
