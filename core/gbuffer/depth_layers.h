// The surfaces behind those that a view sees: further hits along the rays through the pixel centres (depth
// peeling; Everitt 2001, here by tracing instead of rasterising).
#pragma once

#include "core/gbuffer/gbuffer.h"

#include <vector>

namespace hybray {

struct DepthLayers {
  static constexpr int kMost = PassedPrimitives::kMost;  // with the first

  // The second surface along each pixel's ray, the third, and so on: depth, derivatives and primitive as in a
  // G-buffer, background where there are no more.
  std::vector<GBuffer> further;
  Image2D<uint8_t> fronts;  // bit i: surface i + 1 turns its front side (triangles: counter-clockwise) to the
                            // viewer

  int count() const { return static_cast<int>(further.size()) + 1; }
  bool shows_front(size_t pixel, int layer) const { return (fronts[pixel] >> layer & 1) != 0; }
  size_t memory_bytes() const;
};

// Layers 2 to `count` <= DepthLayers::kMost behind the buffers of `first`, which must hold primitives;
// all threads. `tracer`: built with Tracer::Config::layers. A triangle counts once along a ray, and
// coincident ones each on their own, in an order that the tracer chooses. A curve counts once,
// by its near side. An analytic surface is the last layer of its pixel: what lies behind its first point is
// not known.
DepthLayers make_depth_layers(const Tracer& tracer, const GBuffer& first, int count);

}  // namespace hybray
