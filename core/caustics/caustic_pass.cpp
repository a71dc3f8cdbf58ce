#include "core/caustics/caustic_pass.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/caustics/medium_at.h"
#include "core/scene/closed_bodies.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace hybray::caustics {
namespace {

uint64_t mixed_seed(uint64_t seed, uint64_t stream, uint64_t sample) {
  return mix_bits(seed ^ mix_bits(stream << 32 ^ sample));
}

constexpr uint64_t kCameraStream = 0x80000000u;  // beyond the number of any light

// Calls work(map, emission, walk) for each light, with its own random numbers.
template <class Work>
void for_each_light(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                    uint32_t sample, const Work& work) {
  for (const VisibilityMap& map : maps.maps) {
    const uint64_t seed = mixed_seed(settings.walk.seed, map.light, sample);
    const Emission emission(scene.tracer.scene().lights[map.light], map, scene.tracer.scene().bounds,
                            settings.emission,
                            expected_paths(map, settings.emission, settings.rays_per_texel), seed);
    WalkOptions walk = settings.walk;
    walk.seed = seed;
    work(map, emission, walk);
  }
}

}  // namespace

CausticScene::CausticScene(const Tracer& t) : tracer(t), optics(optics::make_optics(t.scene())) {
  const Scene& scene = t.scene();
  if (!optics.any_specular) return;
  if (optics.any_interface) check_closed_bodies(scene);
  targets = specular_targets(scene, optics);
  for (const Light& light : scene.lights)
    light_media.push_back(light.kind == LightKind::directional
                              ? uint16_t{0}
                              : medium_at(tracer, optics, dvec3(light.position)));
}

MapSet make_maps(const CausticScene& scene, const PassSettings& settings) {
  if (!scene.optics.any_specular) {
    MapSet none;
    none.lights_skipped = static_cast<uint32_t>(settings.lights.size());
    return none;
  }
  return make_visibility_maps(scene.tracer, scene.optics, scene.targets, settings.lights,
                              settings.map_resolution, settings.emission != EmissionKind::map);
}

LightPaths trace_light_paths(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                             uint32_t sample) {
  LightPaths result;
  trace_light_paths(scene, settings, maps, sample, result);
  return result;
}

void trace_light_paths(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                       uint32_t sample, LightPaths& result) {
  result.clear();
  double expected = 0.0;
  for (const VisibilityMap& map : maps.maps)
    expected += expected_paths(map, settings.emission, settings.rays_per_texel);
  if (expected > kMostPathsOfPass)
    throw InputError("rays_per_texel",
                     fmt::format("{} asks for {:.0f} light paths in one pass; at most {:.0f} can be traced",
                                 settings.rays_per_texel, expected, kMostPathsOfPass));
  for_each_light(scene, settings, maps, sample,
                 [&](const VisibilityMap& map, const Emission& emission, const WalkOptions& walk) {
                   // The list gathers all lights; what this one adds to its account is its own.
                   WalkCounts before;
                   std::swap(before, result.list.counts);
                   trace_photons(scene.tracer, scene.optics, emission, map, settings.first_surface,
                                 scene.light_media[map.light], walk, 0, emission.paths(), result.list);
                   result.ledgers.push_back(result.list.counts.ledger);
                   before.add(result.list.counts);
                   result.list.counts = before;
                 });
}

PathAudit audit_light_paths(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                            uint32_t sample) {
  PathAudit all;
  all.arrived.assign(scene.optics.media.size(), 0.0);
  for_each_light(scene, settings, maps, sample,
                 [&](const VisibilityMap& map, const Emission& emission, const WalkOptions& walk) {
                   const PathAudit one = audit_paths(scene.tracer, scene.optics, emission,
                                                     scene.light_media[map.light], walk, 0, emission.paths());
                   all.segments += one.segments, all.self_intersections += one.self_intersections;
                   for (size_t m = 0; m < all.arrived.size(); ++m) all.arrived[m] += one.arrived[m];
                 });
  return all;
}

DirectResult deposit(const CausticScene& scene, const PassSettings& settings, const GBuffer& camera,
                     const LightPaths& paths) {
  DirectResult result;
  if (paths.list.photons.empty()) return result;
  const double flux = 3.0 * paths.list.counts.ledger.emitted;
  result.image = FixedPointImage(camera.view.width(), camera.view.height(), largest_radiance(flux, camera));
  result.counts =
      splat(paths.list.photons, camera, scene.optics, settings.visibility, scene.tracer, result.image);
  return result;
}

bool sees_specular(const CausticScene& scene, const GBuffer& camera) {
  if (!scene.optics.any_specular) return false;
  const Scene& s = scene.tracer.scene();
  return std::any_of(camera.primitive.begin(), camera.primitive.end(), [&](uint32_t primitive) {
    return primitive != kNoPrimitive && scene.optics.materials[s.material_of(primitive)].specular;
  });
}

MixedResult add_mixed(const CausticScene& scene, const PassSettings& settings, const GBuffer& camera,
                      uint16_t camera_medium, const LightPaths& paths, uint32_t sample) {
  MixedResult result;
  if (!settings.mixed || paths.list.photons.empty()) return result;
  CameraPathOptions options = settings.camera;
  options.walk.seed = mixed_seed(settings.walk.seed, kCameraStream, sample);
  const VisibilityPoints visible =
      trace_visibility_points(scene.tracer, scene.optics, camera, camera_medium, options);
  result.points = visible.points.size();
  result.pixels = visible.pixels;
  result.rays = visible.counts.rays;
  if (visible.points.empty()) return result;
  result.image = FixedPointImage(camera.view.width(), camera.view.height(),
                                 largest_radiance(3.0 * paths.list.counts.ledger.emitted, visible));
  result.counts = add_mixed_caustics(*settings.mixed, scene.tracer.scene(), scene.optics, paths.list.photons,
                                     visible, result.image);
  return result;
}

}  // namespace hybray::caustics
