// Depth that holds over each pixel's whole area, which samples at pixel centres cannot give: a conservative
// rasteriser in software over all triangles of a scene, clipped at the near plane.
//
// Each pixel is taken with a rim around it, and each depth with a margin, so that the bounds also hold for
// what single precision makes of a ray: a march of the float ray that stays in front of them proves that the
// ray, in the general tracer too, meets nothing on its way.
#pragma once

#include "core/gbuffer/gbuffer.h"

#include <cstdint>

namespace hybray {

struct ConservativeDepth {
  // Device depth that no surface beyond the near plane is nearer than, anywhere in the pixel; the
  // background's where none touches it.
  Image2D<float> nearest;
  // A slanted bound with the slopes of GBuffer::depth_derivatives, in march depth (View::depth_sign()):
  // everything in the pixel is at or behind intercept + slopes . (point - centre). +infinity where no surface
  // touches the pixel.
  Image2D<float> intercept;
  // 1 where nothing in the pixel rises above the plane of the triangle that its centre sees, toward the
  // viewer, by more than half of what lifts a reflection ray off that plane: such a ray leaves the pixel
  // unhindered.
  Image2D<uint8_t> origin_clear;
  uint64_t pixels_touched = 0;  // summed over the triangles

  size_t memory_bytes() const { return nearest.size() * (2 * sizeof(float) + sizeof(uint8_t)); }
};

// What is subtracted from every depth of a pixel, device depth: eight times the rounding of the depth of a
// ray's origin in float.
constexpr double kDepthMargin = 0x1p-21;

// Width of the rim around a pixel, pixels: four times the rounding of a place on a screen of this size.
constexpr double pixel_rim(int width, int height) {
  return 0x1p-20 * (width + height);
}

// Needs depth, derivatives and primitives of `g`, all threads; the same at any number of them. `result` is
// reused from call to call. An analytic surface counts as its bounding box, a curve as those of
// its pieces.
void make_conservative_depth(const GBuffer& g, const Scene& scene, ConservativeDepth& result);

}  // namespace hybray
