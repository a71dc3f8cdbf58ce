// The order in which rays of pixels are listed: tiles of 8x8 pixels row by row, each along a Morton curve,
// covered pixels only.
#pragma once

#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/gbuffer/gbuffer.h"

#include <vector>

namespace hybray {

class CoveredPixels {
 public:
  // Counts them. Needs the primitive buffer, which must outlive this.
  explicit CoveredPixels(const GBuffer& g)
      : g_(g), tiles_x_((static_cast<size_t>(g.view.width()) + kMortonTile - 1) / kMortonTile) {
    const size_t tiles = tiles_x_ * ((static_cast<size_t>(g.view.height()) + kMortonTile - 1) / kMortonTile);
    first_.assign(tiles + 1, 0);
    parallel_blocks(tiles, 256, [&](size_t begin, size_t end) {
      for (size_t tile = begin; tile < end; ++tile) visit(tile, [&](int, int) { ++first_[tile + 1]; });
    });
    for (size_t tile = 0; tile < tiles; ++tile) first_[tile + 1] += first_[tile];
  }

  size_t tiles() const { return first_.size() - 1; }
  size_t size() const { return first_.back(); }
  size_t first(size_t tile) const { return first_[tile]; }  // place of a tile's first pixel in the list
  size_t count(size_t tile) const { return first_[tile + 1] - first_[tile]; }

  // Calls body(x, y) for the covered pixels of one tile, in order.
  template <class Body>
  void visit(size_t tile, const Body& body) const {
    const int tx = static_cast<int>(tile % tiles_x_) * kMortonTile,
              ty = static_cast<int>(tile / tiles_x_) * kMortonTile;
    for (uint32_t i = 0; i < kMortonTile * kMortonTile; ++i) {
      const int x = tx + morton_x(i), y = ty + morton_y(i);
      if (x < g_.view.width() && y < g_.view.height() && g_.primitive(x, y) != kNoPrimitive) body(x, y);
    }
  }

 private:
  const GBuffer& g_;
  size_t tiles_x_;
  std::vector<size_t> first_;
};

}  // namespace hybray
