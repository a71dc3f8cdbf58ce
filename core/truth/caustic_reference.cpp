#include "core/truth/caustic_reference.h"

#include "core/base/hash.h"
#include "core/caustics/medium_at.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray::truth {
namespace {

using namespace caustics;

constexpr uint64_t kChunk = uint64_t{1} << 19;  // paths whose photons are in memory at once
constexpr double kAlpha = 2.0 / 3.0;            // share of photons that a pass keeps (Hachisuka et al. 2008)
constexpr uint64_t kCameraStream = 0x80000000u;
constexpr uint64_t kReferenceStream = 0x7265666572656e63u;  // apart from all that the method draws

uint64_t stream_seed(uint64_t seed, uint64_t stream, uint32_t batch, int pass) {
  return mix_bits(mix_bits(seed ^ kReferenceStream) ^
                  mix_bits(stream << 32 ^ static_cast<uint64_t>(batch) << 8 ^ static_cast<uint64_t>(pass)));
}

// Radius of pass i over that of pass 0: r_(i+1)^2 = r_i^2 (i + alpha) / (i + 1), i from 1.
double shrunk(int pass) {
  double square = 1.0;
  for (int i = 1; i <= pass; ++i) square *= (i + kAlpha) / (i + 1.0);
  return std::sqrt(square);
}

void add_to(Image2D<vec3>& sum, const FixedPointImage& image, double factor) {
  if (image.empty()) return;
  const Image2D<vec3> part = image.image(factor);
  for (size_t i = 0; i < part.size(); ++i) sum[i] += part[i];
}

}  // namespace

// What passes add to: illumination over all of them, mixed caustics one at a time, as their scale depends on
// the pass's points.
struct CausticReference::Images {
  FixedPointImage illumination, mixed, mixed_wide;
};

std::string describe(const CausticReferenceSettings& s) {
  return fmt::format(
      "estimator {} paths {} map {} events {} mixed {} passes {} radius {} camera paths {} lights {} mode {} "
      "seed {}",
      kEstimatorVersion, s.paths, s.map_resolution, s.max_events, s.mixed, s.passes, s.radius_pixels,
      s.camera_paths, fmt::join(s.lights, ","), static_cast<int>(s.mode), s.seed);
}

CausticReference::CausticReference(const CausticScene& scene, const GBuffer& camera,
                                   const CausticReferenceSettings& settings)
    : scene_(scene), camera_(camera), settings_(settings) {
  PassSettings maps;
  maps.map_resolution = settings.map_resolution;
  maps.emission = EmissionKind::mixture;
  maps.lights = settings.lights;
  maps_ = make_maps(scene, maps);
  // Paths by covered flux; a light whose map is empty still gets enough to find what it missed.
  double covered = 0.0;
  for (const VisibilityMap& map : maps_.maps) covered += map.covered_flux;
  const double floor =
      std::max(covered, 1e-300) * 0.05 / static_cast<double>(std::max<size_t>(1, maps_.maps.size()));
  const double total = covered + floor * static_cast<double>(maps_.maps.size());
  for (const VisibilityMap& map : maps_.maps)
    light_paths_.push_back(
        std::max(1.0, settings.paths / settings.passes * (map.covered_flux + floor) / total));
  mixed_ = settings.mixed && !maps_.maps.empty() && sees_specular(scene, camera);
  if (scene.optics.any_interface) camera_medium_ = medium_at(scene.tracer, scene.optics, camera.view.eye());
}

void CausticReference::trace_pass(uint32_t batch, int pass, const BackwardMap* seen, Images& images,
                                  CausticReferenceBatch& result) const {
  const Scene& scene = scene_.tracer.scene();
  for (size_t m = 0; m < maps_.maps.size(); ++m) {
    const VisibilityMap& map = maps_.maps[m];
    WalkOptions walk;
    walk.max_events = settings_.max_events;
    walk.mode = settings_.mode;
    walk.seed = stream_seed(settings_.seed, map.light, batch, pass);
    const Emission emission(scene.lights[map.light], map, scene.bounds, EmissionKind::mixture,
                            light_paths_[m], walk.seed);
    for (uint64_t first = 0; first < emission.paths(); first += kChunk) {
      const uint64_t count = std::min(kChunk, emission.paths() - first);
      PhotonList list;
      trace_photons(scene_.tracer, scene_.optics, emission, map, FirstSurface::traced,
                    scene_.light_media[map.light], walk, first, count, list);
      result.ledger.add(list.counts.ledger);
      result.rays += list.counts.rays;
      result.paths += count;
      result.counts.add(splat(list.photons, camera_, scene_.optics, Visibility::shadow, scene_.tracer,
                              images.illumination));
      if (seen) seen->add(list.photons, images.mixed, &images.mixed_wide);
    }
  }
}

CausticReferenceBatch CausticReference::batch(uint32_t batch) const {
  CausticReferenceBatch result;
  const int w = camera_.view.width(), h = camera_.view.height();
  result.illumination = Image2D<vec3>(w, h);
  if (mixed_) result.mixed = result.mixed_wide = Image2D<vec3>(w, h);
  double flux = 0.0;
  for (const VisibilityMap& map : maps_.maps) {
    // An upper bound of what the light emits in all directions, by channel.
    const Light& light = scene_.tracer.scene().lights[map.light];
    const UniformDomain domain(light, scene_.tracer.scene().bounds);
    flux += domain.measure() * static_cast<double>(light.intensity) *
            static_cast<double>(std::max({light.color.x, light.color.y, light.color.z}));
  }
  if (!(flux > 0.0)) return result;

  const double factor = 1.0 / settings_.passes;
  Images images;
  images.illumination = FixedPointImage(w, h, largest_radiance(4.0 * flux * settings_.passes, camera_));
  for (int pass = 0; pass < settings_.passes; ++pass) {
    VisibilityPoints points;
    std::optional<BackwardMap> seen;
    if (mixed_) {
      CameraPathOptions options;
      options.walk.max_events = settings_.max_events;
      options.walk.mode = settings_.mode;
      options.walk.seed = stream_seed(settings_.seed, kCameraStream, batch, pass);
      options.paths_per_pixel = settings_.camera_paths;
      options.radius_pixels = settings_.radius_pixels * shrunk(pass);
      options.jittered = true;
      points = trace_visibility_points(scene_.tracer, scene_.optics, camera_, camera_medium_, options);
      result.rays += points.counts.rays;
      if (!points.points.empty()) {
        const double largest = largest_radiance(4.0 * flux, points);
        images.mixed = FixedPointImage(w, h, largest);
        images.mixed_wide = FixedPointImage(w, h, largest);
        seen.emplace(scene_.tracer.scene(), scene_.optics, points, std::numbers::sqrt2_v<float>);
      }
    }
    trace_pass(batch, pass, seen ? &*seen : nullptr, images, result);
    result.overflows += images.mixed.overflows() + images.mixed_wide.overflows();
    if (mixed_) {
      add_to(result.mixed, images.mixed, factor);
      add_to(result.mixed_wide, images.mixed_wide, factor);
      images.mixed = images.mixed_wide = {};
    }
  }
  result.overflows += images.illumination.overflows();
  result.illumination = images.illumination.image(factor);
  return result;
}

}  // namespace hybray::truth
