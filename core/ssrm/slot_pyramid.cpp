#include "core/ssrm/slot_pyramid.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybray::ssrm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Half a pixel's worth of slope to the pixel's corners, and what the marcher wants surfaces to be apart. The
// marcher's depths are rounded to float: a few of its ulps on top.
float reach(const PixelPlane& plane) {
  const double slopes = std::abs(plane.slope_x) + std::abs(plane.slope_y);
  return static_cast<float>((0.5 + 0.5 * kContinuation) * slopes * (1.0 + 1e-6) +
                            std::abs(plane.center) * 0x1p-21);
}

}  // namespace

SlotPyramid::Bounds SlotPyramid::pixel(const DepthView& view, const DepthLayers& layers, FreeSpace rule,
                                       int x, int y) const {
  constexpr Bounds kNever{kInfinity, -kInfinity};
  const PixelPlane first = pixel_plane(view, x, y);
  if (layers.further.empty() || std::isinf(first.center)) return kNever;
  Bounds b{static_cast<float>(first.center) + reach(first), kInfinity};
  for (const GBuffer& g : layers.further) {
    if (g.primitive(x, y) == kNoPrimitive) break;
    const vec2 d = g.depth_derivatives(x, y);
    const PixelPlane plane{view.depth_sign * static_cast<double>(g.depth(x, y)), d.x, d.y};
    b.next_begins = std::min(b.next_begins, static_cast<float>(plane.center) - reach(plane));
  }
  const size_t index = static_cast<size_t>(y) * static_cast<size_t>(view.width()) + static_cast<size_t>(x);
  const bool free = is_free(rule, layers.shows_front(index, 0), layers.shows_front(index, 1));
  return std::isinf(b.next_begins) || !free ? kNever : b;
}

SlotPyramid::SlotPyramid(const DepthView& view, const DepthLayers& layers, FreeSpace rule) {
  size_t texels = 0;
  for (int l = 1, w = (view.width() + 1) / 2, h = (view.height() + 1) / 2;
       l < DepthPyramid::level_count(view.width(), view.height()); ++l, w = (w + 1) / 2, h = (h + 1) / 2) {
    levels_.push_back({w, h, texels});
    texels += static_cast<size_t>(w) * static_cast<size_t>(h);
  }
  texels_.resize(texels);
  for (size_t l = 0; l < levels_.size(); ++l) {
    const Level& here = levels_[l];
    const int width = l == 0 ? view.width() : levels_[l - 1].width;
    const int height = l == 0 ? view.height() : levels_[l - 1].height;
    const auto below = [&](int x, int y) {
      if (l == 0) return pixel(view, layers, rule, x, y);
      return texels_[levels_[l - 1].first + static_cast<size_t>(y) * static_cast<size_t>(width) +
                     static_cast<size_t>(x)];
    };
    parallel_blocks(static_cast<size_t>(here.height), 8, [&](size_t begin, size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        for (int x = 0; x < here.width; ++x) {
          Bounds all{-kInfinity, kInfinity};
          for (int j = 2 * y; j < std::min(2 * y + 2, height); ++j)
            for (int i = 2 * x; i < std::min(2 * x + 2, width); ++i) {
              const Bounds b = below(i, j);
              all.first_reaches = std::max(all.first_reaches, b.first_reaches);
              all.next_begins = std::min(all.next_begins, b.next_begins);
            }
          texels_[here.first + static_cast<size_t>(y) * static_cast<size_t>(here.width) +
                  static_cast<size_t>(x)] = all;
        }
    });
  }
}

}  // namespace hybray::ssrm
