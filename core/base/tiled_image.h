// A width x height array of values of which only some 8x8 tiles have memory; the others read as one value.
// For images seen through a small window, such as what a light sees of a few objects.
#pragma once

#include "core/base/check.h"
#include "core/base/morton.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hybray {

template <class T>
class TiledImage {
 public:
  TiledImage() = default;
  // `tiles`: one byte a tile, row by row, not 0 where it has memory; empty: all of them have. Everything
  // starts as `value`.
  TiledImage(int width, int height, std::span<const uint8_t> tiles, const T& value = T{})
      : tiles_x_((width + kMortonTile - 1) / kMortonTile), outside_(value) {
    const size_t count =
        static_cast<size_t>(tiles_x_) * static_cast<size_t>((height + kMortonTile - 1) / kMortonTile);
    HYBRAY_CHECK(tiles.empty() || tiles.size() == count);
    first_.resize(count);
    size_t stored = 0;
    for (size_t tile = 0; tile < count; ++tile)
      first_[tile] = tiles.empty() || tiles[tile] ? kTexels * stored++ : kNone;
    data_.assign(kTexels * stored, value);
  }

  bool stored(int x, int y) const { return first_[tile(x, y)] != kNone; }
  const T& operator()(int x, int y) const {
    const size_t first = first_[tile(x, y)];
    return first == kNone ? outside_ : data_[first + inside(x, y)];
  }
  // (x, y) must be stored.
  T& at(int x, int y) { return data_[first_[tile(x, y)] + inside(x, y)]; }

  // All values that have memory, tile by tile, those beyond the image's border included.
  std::span<const T> values() const { return data_; }

 private:
  static constexpr size_t kTexels = kMortonTile * kMortonTile;
  static constexpr size_t kNone = SIZE_MAX;

  size_t tile(int x, int y) const {
    return static_cast<size_t>(y / kMortonTile) * static_cast<size_t>(tiles_x_) +
           static_cast<size_t>(x / kMortonTile);
  }
  static size_t inside(int x, int y) {
    return static_cast<size_t>(y % kMortonTile) * kMortonTile + static_cast<size_t>(x % kMortonTile);
  }

  int tiles_x_ = 0;
  T outside_{};
  std::vector<size_t> first_;  // of each tile, into data_
  std::vector<T> data_;
};

}  // namespace hybray
