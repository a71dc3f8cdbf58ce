// What a point of `caustics` works on: view, G-buffer, settings and the lights that it uses.
#include "core/base/error.h"
#include "core/caustics/light_source.h"
#include "core/caustics/medium_at.h"
#include "core/tracer/seeded_camera.h"
#include "harness/experiments/caustics.h"
#include "harness/experiments/resolution.h"
#include "harness/experiments/workspace.h"

#include <algorithm>

#include <fmt/format.h>

namespace hybray::caustics_parts {
namespace {

using namespace caustics;

// Whether the camera sees the light itself: inside the view, nothing between. Directional light comes from
// everywhere in its direction and counts as seen.
bool camera_sees(const Light& light, const View& view, const Tracer& tracer) {
  if (light.kind == LightKind::directional) return true;
  const dvec3 place(light.position);
  if (!(view.view_depth(place) > view.near())) return false;
  const dvec2 pixel = view.project(place);
  if (!(pixel.x >= 0.0 && pixel.x < view.width() && pixel.y >= 0.0 && pixel.y < view.height())) return false;
  const dvec3 way = place - view.eye();
  const double distance = glm::length(way);
  return !tracer.occluded(vec3(view.eye()), vec3(way / distance), static_cast<float>(view.near()),
                          static_cast<float>(distance * (1.0 - 1e-4)));
}

// The first `wanted` lights of `among`, all of them for -1.
void take(const std::vector<uint32_t>& among, int64_t wanted, const char* parameter, const Scene& scene,
          const std::string& camera, std::vector<uint32_t>& lights) {
  if (wanted > static_cast<int64_t>(among.size()))
    throw InputError(parameter,
                     fmt::format("{} lights are asked for; scene '{}' has {} of that kind from camera '{}'",
                                 wanted, scene.name, among.size(), camera));
  const size_t count = wanted < 0 ? among.size() : static_cast<size_t>(wanted);
  lights.insert(lights.end(), among.begin(), among.begin() + static_cast<ptrdiff_t>(count));
}

PassSettings pass_settings(const Point& point, uint64_t seed) {
  PassSettings s;
  s.map_resolution = static_cast<int>(point.integer("map_resolution"));
  s.rays_per_texel = point.number("rays_per_texel");
  s.emission = point.text("emission") == "uniform" ? EmissionKind::uniform : EmissionKind::map;
  s.first_surface = point.text("first_surface") == "traced" ? FirstSurface::traced : FirstSurface::stored;
  s.visibility = point.text("visibility") == "shadow" ? Visibility::shadow : Visibility::depth;
  s.walk.max_events = static_cast<int>(point.integer("mirror_depth"));
  s.walk.roulette_threshold = point.number("roulette_threshold");
  s.walk.seed = seed;
  if (point.text("mixed") == "backward") s.mixed = PhotonMapKind::backward;
  if (point.text("mixed") == "forward") s.mixed = PhotonMapKind::forward;
  s.camera.walk = s.walk;
  s.camera.paths_per_pixel = static_cast<int>(point.integer("camera_paths"));
  s.camera.radius_pixels = point.number("gather_radius");
  return s;
}

}  // namespace

Setup make_setup(const Point& point, Workspace& workspace) {
  const std::string& name = point.text("scene");
  const Scene& scene = workspace.scene(name);
  const Tracer& robust = workspace.robust_tracer(name);
  const Tracer& tracer = workspace.tracer(name);
  const CausticScene& caustic_scene = workspace.shared<CausticScene>(
      name, "caustic scene", [&] { return std::make_shared<CausticScene>(tracer); });

  const Resolution size = *parse_resolution(point.text("resolution"));
  const std::string& camera = point.text("camera");
  View::Settings settings;
  settings.width = size.width, settings.height = size.height;
  settings.near = point.number("near");
  const View view(camera_of(robust, camera), settings, scene.bounds);
  const bool filter = point.text("filter") == "wavelet";
  unsigned bits = kDepth | kDepthDerivatives | kShadingNormal | kPrimitive;
  if (filter && caustic_scene.optics.any_specular)
    bits |= kGeometricNormal | kMaterial;  // the filter's guides

  PassSettings pass = pass_settings(point, workspace.settings().seed);
  std::vector<uint32_t> visible, invisible;
  for (uint32_t i = 0; i < scene.lights.size(); ++i)
    (camera_sees(scene.lights[i], view, robust) ? visible : invisible).push_back(i);
  take(visible, point.integer("lights_visible"), "lights_visible", scene, camera, pass.lights);
  const auto visible_count = static_cast<int64_t>(pass.lights.size());
  take(invisible, point.integer("lights_invisible"), "lights_invisible", scene, camera, pass.lights);

  return {scene,         robust,
          caustic_scene, view,
          bits,          make_gbuffer(robust, view, bits),
          pass,          medium_at(robust, caustic_scene.optics, view.eye()),
          visible_count, static_cast<int64_t>(pass.lights.size()) - visible_count,
          filter};
}

}  // namespace hybray::caustics_parts
