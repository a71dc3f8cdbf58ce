// What a light sees through its texels: the geometry buffer of a LightFrame.
#pragma once

#include "core/base/tiled_image.h"
#include "core/gbuffer/light_frame.h"
#include "core/tracer/tracer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hybray {

// What a ray through a texel's centre meets.
struct LightTexel {
  float distance = std::numeric_limits<float>::infinity();  // along the ray, metres
  uint32_t primitive = kNoPrimitive;
  float u = 0.0f, v = 0.0f;  // barycentric weights of the triangle's second and third vertex
};

struct LightBuffer {
  LightFrame frame;
  TiledImage<LightTexel> texels;  // width x height of the frame; kNoPrimitive where nothing is seen
  size_t traced = 0;              // texels that a ray was traced for
};

// Traces the texel centres of the tiles marked in `tiles` (8x8 texels, row by row; empty: all of them) in
// coherent packets. Normals and materials follow from the primitive (surface_point.h).
LightBuffer make_light_buffer(const Tracer& tracer, const LightFrame& frame,
                              std::span<const uint8_t> tiles = {});

}  // namespace hybray
