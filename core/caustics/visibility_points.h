// Backward photon maps: what the camera sees through specular surfaces, as points on diffuse surfaces
// (caustics paper, "Mixed caustics", Figure 5).
#pragma once

#include "core/caustics/path_walk.h"
#include "core/gbuffer/gbuffer.h"

#include <vector>

namespace hybray::caustics {

struct VisibilityPoint {
  vec3 position{0.0f};   // on a surface with a diffuse part, metres
  vec3 normal{0.0f};     // geometric, unit, on the side of arrival
  vec3 weight{0.0f};     // of the radiance that leaves here, in the pixel, by channel
  float cos_out = 1.0f;  // of the way to the camera, with the shading normal
  float radius = 0.0f;   // of the integration sphere, metres
  uint32_t pixel = 0;    // row-major
  uint32_t material = 0;
  uint32_t primitive = 0;
};

struct CameraPathOptions {
  WalkOptions walk;
  int paths_per_pixel = 1;
  // Radius of an integration sphere in pixels: times the angular size of a pixel at the centre of the image
  // and the length of the path.
  double radius_pixels = 2.0;
  // false: paths start at the surfaces of the G-buffer, at pixel centres. true: anywhere in the pixel, one
  // ray more, and every pixel of the view takes part.
  bool jittered = false;
};

struct VisibilityPoints {
  std::vector<VisibilityPoint> points;  // in an order that does not depend on threads
  WalkCounts counts;
  uint64_t pixels = 0;  // that start paths
  uint64_t paths = 0;
};

// Points on diffuse surfaces from the second surface of each path on. Paths start only at pixels that see a
// specular surface: without one, nothing is done. The G-buffer must hold depth, primitive and shading normal
// (jittered: nothing). `start_medium` is the medium that the camera lies in; weights carry (n_camera / n)^2,
// n the index of the medium around the point.
VisibilityPoints trace_visibility_points(const Tracer& tracer, const optics::OpticsTable& optics,
                                         const GBuffer& gbuffer, uint16_t start_medium,
                                         const CameraPathOptions& options);

}  // namespace hybray::caustics
