// Depositing photons on the pixels that see them (caustics paper, "Illumination caustics", equation 2).
#pragma once

#include "core/caustics/fixed_point_image.h"
#include "core/caustics/photon_blocks.h"
#include "core/gbuffer/gbuffer.h"
#include "core/optics/surface_optics.h"

namespace hybray::caustics {

enum class Visibility : uint8_t {
  depth,   // agrees with the camera's depth buffer: no ray, the paper's way
  shadow,  // a ray to the camera decides
};

// Where deposited flux ended, W, mean of the channels; parts of FluxLedger::deposited.
struct SplatCounts {
  double landed = 0.0;         // reached a pixel
  double offscreen = 0.0;      // outside the view volume
  double rejected = 0.0;       // hidden from the camera, or on the far side of its surface
  double missed_by_map = 0.0;  // part of landed whose paths no map would have emitted

  void add(const SplatCounts& o) {
    landed += o.landed, offscreen += o.offscreen, rejected += o.rejected, missed_by_map += o.missed_by_map;
  }
};

// Adds the radiance toward the camera, W/(sr m^2), that each photon gives its pixel: flux * BRDF / area, with
// the surface area under a pixel d^2 cos^3(theta_camera) / (f^2 cos(theta_surface)), d the Euclidean
// distance, f the focal length in pixels.
//
// With Visibility::depth the G-buffer must hold depth and depth derivatives: a photon is seen if its depth is
// that of its pixel's plane at its own place, to within one pixel footprint. `tracer` is used by
// Visibility::shadow alone.
SplatCounts splat(const PhotonBlocks& photons, const GBuffer& camera, const optics::OpticsTable& optics,
                  Visibility visibility, const Tracer& tracer, FixedPointImage& image);

// The greatest radiance that `flux` watts can give one pixel, for the scale of a FixedPointImage: all of it
// on a white surface that faces the camera at the nearest depth in view.
double largest_radiance(double flux, const GBuffer& camera);

}  // namespace hybray::caustics
