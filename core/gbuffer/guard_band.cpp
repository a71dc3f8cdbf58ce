#include "core/gbuffer/guard_band.h"

#include "core/base/check.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hybray {
namespace {

template <class T>
void copy_inside(const Image2D<T>& from, Image2D<T>& to, ivec2 margin) {
  for (int y = 0; y < from.height(); ++y)
    std::copy_n(from.data() + static_cast<size_t>(y) * from.width(), from.width(),
                &to(margin.x, y + margin.y));
}

unsigned bits_of(const GBuffer& g) {
  return (g.depth.empty() ? 0u : kDepth) | (g.depth_derivatives.empty() ? 0u : kDepthDerivatives) |
         (g.geometric_normal.empty() ? 0u : kGeometricNormal) |
         (g.shading_normal.empty() ? 0u : kShadingNormal) | (g.primitive.empty() ? 0u : kPrimitive) |
         (g.material.empty() ? 0u : kMaterial);
}

}  // namespace

int guard_band(int size, double fraction) {
  const int pixels = static_cast<int>(std::ceil(fraction * size));
  return (pixels + kMortonTile - 1) / kMortonTile * kMortonTile;
}

GBuffer with_guard_band(const Tracer& tracer, const GBuffer& inner, ivec2 margin) {
  HYBRAY_CHECK_EQ(margin.x % kMortonTile, 0);
  HYBRAY_CHECK_EQ(margin.y % kMortonTile, 0);
  const View view = inner.view.with_margin(margin.x, margin.y);
  GBuffer g = empty_gbuffer(view, bits_of(inner));
  copy_inside(inner.depth, g.depth, margin);
  copy_inside(inner.depth_derivatives, g.depth_derivatives, margin);
  copy_inside(inner.geometric_normal, g.geometric_normal, margin);
  copy_inside(inner.shading_normal, g.shading_normal, margin);
  copy_inside(inner.primitive, g.primitive, margin);
  copy_inside(inner.material, g.material, margin);
  const auto inside = [](int tile, int first, int size) {
    return tile * kMortonTile >= first && (tile + 1) * kMortonTile <= first + size;
  };
  const int w = view.width(), h = view.height();
  const int tiles_x = (w + kMortonTile - 1) / kMortonTile, tiles_y = (h + kMortonTile - 1) / kMortonTile;
  std::atomic<size_t> covered{0};
  parallel_blocks(
      static_cast<size_t>(tiles_x) * static_cast<size_t>(tiles_y), 16, [&](size_t begin, size_t end) {
        size_t mine = 0;
        for (size_t tile = begin; tile < end; ++tile) {
          const int x = static_cast<int>(tile % tiles_x), y = static_cast<int>(tile / tiles_x);
          if (!inside(x, margin.x, inner.view.width()) || !inside(y, margin.y, inner.view.height()))
            mine += trace_tile(tracer, g, x, y);
          else
            for (int j = y * kMortonTile; j < (y + 1) * kMortonTile; ++j)
              for (int i = x * kMortonTile; i < (x + 1) * kMortonTile; ++i)
                mine += g.primitive(i, j) != kNoPrimitive;
        }
        covered += mine;
      });
  g.covered_pixels = covered;
  return g;
}

}  // namespace hybray
