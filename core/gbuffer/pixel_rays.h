// Rays from the surfaces that a view sees, of the kinds that renderers ask for besides perfect mirrors.
//
// Directions are drawn with counter-based random numbers keyed by pixel, sample, dimension and seed. Rays of
// one 8x8 tile stand together, sample after sample, each along a Morton curve, so that neighbours in the list
// are neighbours on the screen. Surfaces are two-sided: normals are turned to the viewer's side. Where the
// shading normal faces away from the viewer, or sends a ray into the surface, the ray is made about the
// geometric normal instead, from the same random numbers.
#pragma once

#include "core/base/ray_stream.h"
#include "core/gbuffer/gbuffer.h"

#include <vector>

namespace hybray {

enum class RayKind : uint8_t {
  mirror,   // perfect reflection, one a pixel (reflection_rays.h)
  rough,    // reflection at a GGX microfacet that the viewer sees (ggx.h)
  ambient,  // cosine-weighted, as far as `length`: ambient occlusion
  shadow,   // toward a light: one of the scene's, each with equal chance, or a given sun
};

struct PixelRaySettings {
  RayKind kind = RayKind::mirror;
  int rays_per_pixel = 1;  // >= 1; a mirror has one
  double roughness = 0.3;  // of glTF: GGX's alpha is its square; 0 is a mirror
  double length = 1.0;     // of ambient rays, metres
  dvec3 to_sun{0.0};  // unit direction toward the sun; zero: the scene's lights, of which there must be one
  uint64_t seed = 1;
};

struct PixelRays {
  RayStream rays;
  std::vector<float> lengths;  // metres, for each ray; empty: they go on for ever
  size_t about_geometric_normal = 0;
  // Not made: rough reflections that end in the surface about either normal; shadow rays of surfaces turned
  // away from the light or outside of its cone.
  size_t skipped = 0;
};

// Whether such rays ask only if something is in the way.
constexpr bool asks_for_occlusion(RayKind kind) {
  return kind == RayKind::ambient || kind == RayKind::shadow;
}

// Needs the primitive and shading-normal buffers. All threads. Shadow rays to a point or spot light end
// 1/10,000 of their length before it.
PixelRays make_pixel_rays(const GBuffer& gbuffer, const Scene& scene, const PixelRaySettings& settings);

}  // namespace hybray
