// Marcher `layers`: the paper's strict march, which goes on behind the first surface as long as further depth
// layers say that it is in free space.
//
// In front of everything it is march_paper: the same steps, the same test, the same HITs. A ray that gets
// behind the first layer has, in each pixel, a slot: the number of layers in front of it. In a slot it walks
// from pixel to pixel; crossing the slanted plane of the layer behind or in front of its slot inside a pixel
// is a HIT on that layer. Space that is not free (FreeSpace) can only be reached through a surface: a ray
// that finds itself there has gone through one unseen, and is not resolved. Nor is it behind the last layer,
// nor where a surface that was behind it in one pixel may be the one that is in front of it in the next.
#pragma once

#include "core/gbuffer/depth_layers.h"
#include "core/ssrm/correction.h"
#include "core/ssrm/slot_pyramid.h"

namespace hybray::ssrm {

// What the marcher sees. The references must outlive it.
struct LayeredView {
  DepthView first;
  const Image2D<uint32_t>& primitive;  // of the first layer
  const DepthLayers& layers;
  const SlotPyramid* slots =
      nullptr;  // lets rays behind the first layer skip cells; the same results without it

  int count() const { return layers.count(); }
  bool has(int layer, size_t pixel) const { return primitive_of(layer, pixel) != kNoPrimitive; }
  uint32_t primitive_of(int layer, size_t pixel) const {
    return layer == 0 ? primitive[pixel] : layers.further[layer - 1].primitive[pixel];
  }
  PixelPlane plane(int layer, int x, int y) const;
};

struct LayerOptions {
  FreeSpace free_space = FreeSpace::closed;
  bool march_on = true;  // a ray that was stopped by a pixel's centre depth, but stays in front of its
                         // slanted plane, goes on; the paper gives it up
};

struct LayerResults {
  MarchResults march;
  std::vector<uint8_t> layer;  // of a HIT, 0 = first
  std::vector<uint8_t> late;   // of a HIT: 1 where the paper's marcher would have given the ray up before

  void resize(size_t n) {
    march.resize(n);
    layer.resize(n);
    late.resize(n);
  }
};

struct LayerHit {
  Verdict verdict;
  uint32_t pixel = kNoPixel;
  int layer = 0;
  bool late = false;
};

// All rays, all threads. As march_paper; with one layer and without march_on, the same results. `steps`
// counts depths read, of every layer.
void march_layers(const LayeredView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                  const LayerOptions& options, LayerResults& results);

// One ray.
LayerHit march_layers_ray(const LayeredView& view, const ScreenRay<float>& ray, uint32_t pixel,
                          const LayerOptions& options, uint64_t& steps);

}  // namespace hybray::ssrm
