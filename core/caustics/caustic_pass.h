// The caustic part of the pipeline as one pass (caustics paper, "Rendering method"): maps, forward tracing
// and deposit, mixed caustics. Its stages can be run and timed one by one.
#pragma once

#include "core/caustics/path_audit.h"
#include "core/caustics/photon_maps.h"
#include "core/caustics/photon_trace.h"
#include "core/caustics/splat.h"

#include <optional>
#include <span>
#include <vector>

namespace hybray::caustics {

// What caustics need to know of a scene, prepared once. The tracer must outlive it.
struct CausticScene {
  // Throws InputError for materials that optics cannot take and for transmitting bodies that are open.
  explicit CausticScene(const Tracer& tracer);

  const Tracer& tracer;
  optics::OpticsTable optics;
  SpecularTargets targets;
  std::vector<uint16_t> light_media;  // the medium that each light lies in
};

struct PassSettings {
  int map_resolution = 512;     // texels along one side of a frame
  double rays_per_texel = 1.0;  // > 0; with EmissionKind::uniform of every texel that a full map would have
  EmissionKind emission = EmissionKind::map;
  FirstSurface first_surface = FirstSurface::stored;
  Visibility visibility = Visibility::depth;
  WalkOptions walk;                    // of light paths
  std::optional<PhotonMapKind> mixed;  // none: caustics behind specular surfaces are left out
  CameraPathOptions camera;            // of mixed caustics
  std::vector<uint32_t> lights;        // into Scene::lights
};

// Light paths that one pass may have: their photons are in memory at once.
constexpr double kMostPathsOfPass = 0x1p24;

// Paths and photons of all lights.
struct LightPaths {
  PhotonList list;
  std::vector<FluxLedger> ledgers;  // one a map

  // Empties it but keeps the memory for the next frame.
  void clear() {
    list.photons.clear();
    list.counts = {};
    list.paths = 0;
    ledgers.clear();
  }
};

struct DirectResult {
  FixedPointImage image;  // illumination caustics, W/(sr m^2)
  SplatCounts counts;
};

struct MixedResult {
  FixedPointImage image;  // mixed caustics, W/(sr m^2)
  PhotonMapCounts counts;
  uint64_t points = 0, pixels = 0, rays = 0;
};

// The stages, in order. Every one returns at once where the scene has nothing for it to do. `sample` numbers
// independent repetitions of the random choices. trace_light_paths throws InputError where more than
// kMostPathsOfPass paths are asked for.
MapSet make_maps(const CausticScene& scene, const PassSettings& settings);
LightPaths trace_light_paths(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                             uint32_t sample);
// The same into `result`, whose memory is used again.
void trace_light_paths(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                       uint32_t sample, LightPaths& result);
// The same paths audited, as where first surfaces are traced.
PathAudit audit_light_paths(const CausticScene& scene, const PassSettings& settings, const MapSet& maps,
                            uint32_t sample);
DirectResult deposit(const CausticScene& scene, const PassSettings& settings, const GBuffer& camera,
                     const LightPaths& paths);
MixedResult add_mixed(const CausticScene& scene, const PassSettings& settings, const GBuffer& camera,
                      uint16_t camera_medium, const LightPaths& paths, uint32_t sample);

// Whether the camera sees a specular surface at the centre of any pixel.
bool sees_specular(const CausticScene& scene, const GBuffer& camera);

}  // namespace hybray::caustics
