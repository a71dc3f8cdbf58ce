// Geometry buffers of a view: what its pixel centres see. Made with coherent ray packets; a rasteriser would
// give the same at pixel centres.
#pragma once

#include "core/base/image2d.h"
#include "core/base/ray_stream.h"
#include "core/gbuffer/view.h"
#include "core/tracer/tracer.h"

#include <cstdint>

namespace hybray {

// Which buffers to build, as bits.
enum GBufferBits : unsigned {
  kDepth = 1u << 0,
  kDepthDerivatives = 1u << 1,
  kGeometricNormal = 1u << 2,
  kShadingNormal = 1u << 3,
  kPrimitive = 1u << 4,
  kMaterial = 1u << 5,
};
constexpr int kGBufferKinds = 6;

// Every image is width x height of the view, or empty if it was not asked for. Background pixels: depth =
// View::background_depth(), derivatives and normals zero, primitive and material kNoPrimitive.
struct GBuffer {
  explicit GBuffer(const View& v) : view(v) {}

  View view;
  Image2D<float> depth;             // device depth in [0, 1] at the pixel centre
  Image2D<vec2> depth_derivatives;  // change of device depth by one pixel to the right and down, of the plane
                                    // seen at the centre
  Image2D<vec3> geometric_normal;   // unit, world space, on the surface's front side
  Image2D<vec3> shading_normal;     // unit, world space, interpolated
  Image2D<uint32_t> primitive;      // id in the scene
  Image2D<uint32_t> material;       // index into Scene::materials
  size_t covered_pixels = 0;        // pixels that see something

  size_t memory_bytes() const;
};

// Builds the buffers in `bits`. Surfaces nearer than the near plane or beyond the far plane are not seen.
GBuffer make_gbuffer(const Tracer& tracer, const View& view, unsigned bits);

// The parts that make_gbuffer is made of. Buffers of background alone:
GBuffer empty_gbuffer(const View& view, unsigned bits);
// Writes what `hit` says to all buffers that `g` has at pixel (x, y).
void store_pixel(GBuffer& g, const Scene& scene, int x, int y, const Hit& hit);
// Traces the pixels of tile (tile_x, tile_y), 8x8 of them, as four packets of 4x4; returns how many are
// covered.
size_t trace_tile(const Tracer& tracer, GBuffer& g, int tile_x, int tile_y);

// The depth derivatives that graphics hardware makes: differences of the depth buffer inside each 2x2 quad,
// edges included ("ddx_fine", "ddy_fine"). At the last column or row of an odd size, where the quad has no
// partner, the difference to the pixel before is taken.
Image2D<vec2> difference_derivatives(const Image2D<float>& depth);

}  // namespace hybray
