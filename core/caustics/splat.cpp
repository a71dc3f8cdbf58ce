#include "core/caustics/splat.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace hybray::caustics {
namespace {

// Whether the depth buffer shows the surface that the photon lies on.
bool agrees(const GBuffer& camera, double w, const dvec2& place, int x, int y) {
  const double stored = camera.depth(x, y);
  if (camera.depth(x, y) == camera.view.background_depth()) return false;
  const vec2& slope = camera.depth_derivatives(x, y);
  const double predicted = stored + static_cast<double>(slope.x) * (place.x - (x + 0.5)) +
                           static_cast<double>(slope.y) * (place.y - (y + 0.5));
  const double w_predicted = camera.view.view_depth_of(predicted);
  // NaN and planes that end before the photon compare false.
  return std::abs(w_predicted - w) <= w / camera.view.focal();
}

}  // namespace

SplatCounts splat(const PhotonBlocks& photons, const GBuffer& camera, const optics::OpticsTable& optics,
                  Visibility visibility, const Tracer& tracer, FixedPointImage& image) {
  const View& view = camera.view;
  HYBRAY_CHECK_EQ(image.width(), view.width());
  HYBRAY_CHECK_EQ(image.height(), view.height());
  if (visibility == Visibility::depth)
    HYBRAY_CHECK(!camera.depth.empty() && !camera.depth_derivatives.empty());

  std::vector<SplatCounts> blocks(photons.blocks().size());
  parallel_blocks(blocks.size(), 1, [&](size_t begin, size_t) {
    SplatCounts& counts = blocks[begin];
    for (const Photon& photon : photons.blocks()[begin]) {
      const double flux = photon.mean_flux();
      const dvec3 p(photon.position), n(photon.normal);
      const double w = view.view_depth(p);
      if (!(w > view.near() && w < view.far())) {
        counts.offscreen += flux;
        continue;
      }
      const dvec2 place = view.project(p);
      if (!(place.x >= 0.0 && place.x < view.width() && place.y >= 0.0 && place.y < view.height())) {
        counts.offscreen += flux;
        continue;
      }
      const int x = static_cast<int>(place.x), y = static_cast<int>(place.y);
      const dvec3 to_eye = view.eye() - p;
      const double distance = glm::length(to_eye), cos_out = glm::dot(to_eye, n) / distance;
      bool seen = cos_out > 0.0 && photon.shading_ratio() > 0.0f;
      if (seen && visibility == Visibility::depth) {
        seen = agrees(camera, w, place, x, y);
      } else if (seen) {
        // From a little off the surface to a little before the eye.
        const double offset = 0x1p-18 * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), distance});
        const dvec3 from = p + offset * n, direction = glm::normalize(view.eye() - from);
        const double near_sphere = view.near() * distance / w;
        seen =
            !tracer.occluded(vec3(from), vec3(direction), 0.0f, static_cast<float>(distance - near_sphere));
      }
      if (!seen) {
        counts.rejected += flux;
        continue;
      }
      counts.landed += flux;
      if (photon.missed_by_map) counts.missed_by_map += flux;
      const double cos3 = w * w * w / (distance * distance * distance);
      const double per_area = view.focal() * view.focal() * cos_out / (distance * distance * cos3);
      const optics::SurfaceOptics& surface = optics.materials[photon.material];
      const dvec3 brdf = optics::diffuse_brdf(surface, static_cast<double>(photon.cos_in), cos_out);
      image.add(static_cast<size_t>(y) * static_cast<size_t>(view.width()) + static_cast<size_t>(x),
                dvec3(photon.flux) * brdf * (static_cast<double>(photon.shading_ratio()) * per_area));
    }
  });
  SplatCounts total;
  for (const SplatCounts& counts : blocks) total.add(counts);
  return total;
}

double largest_radiance(double flux, const GBuffer& camera) {
  HYBRAY_CHECK(!camera.depth.empty());
  const View& view = camera.view;
  const int sign = view.depth_sign();
  float nearest = std::numeric_limits<float>::infinity();
  for (const float depth : camera.depth) nearest = std::min(nearest, static_cast<float>(sign) * depth);
  const double w =
      std::max(view.near(), view.view_depth_of(static_cast<double>(sign) * static_cast<double>(nearest)));
  // In a corner of the image the distance d is longer than the depth w: d / w^3 grows with it.
  const dvec2 reach = glm::max(view.center(), dvec2(view.width(), view.height()) - view.center());
  const double corner = std::hypot(1.0, reach.x / view.focal(), reach.y / view.focal());
  // Not so small that the scale of a FixedPointImage would be infinite.
  return std::max(1e-280, flux * view.focal() * view.focal() * corner / (std::numbers::pi * w * w));
}

}  // namespace hybray::caustics
