// Pixel order in small tiles, each walked along a Morton (Z) curve, so that neighbours in the list are
// neighbours on the screen.
#pragma once

#include <cstdint>

namespace hybray {

constexpr int kMortonTile = 8;  // pixels along one side of a tile

// Position (x, y) of index i in [0, 64) along the Morton curve of one 8x8 tile: even bits are x, odd bits y.
constexpr int morton_x(uint32_t i) {
  return static_cast<int>((i & 1) | (i >> 1 & 2) | (i >> 2 & 4));
}
constexpr int morton_y(uint32_t i) {
  return static_cast<int>((i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4));
}

}  // namespace hybray
