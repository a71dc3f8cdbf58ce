// A depth pyramid of slanted lower bounds: each texel holds a plane, affine in the pixel coordinates, that
// lies nowhere behind the planes of the pixels under it, over their whole area. Device depth is affine in
// 1/w, so that a plane in space is a plane here, and a ray that glides along a wall or a floor stays in front
// of the bounds of that surface, where the flat bound of DepthPyramid stops it.
//
// Depths are march depths, as in DepthPyramid; background texels hold +infinity. Level l has ceil(W / 2^l) x
// ceil(H / 2^l) texels, and texel (x, y) covers the square [x, x + 1) 2^l x [y, y + 1) 2^l of pixels, which
// may reach beyond the screen.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybray {

// Slopes are kept in 16 bits each (the upper half of a float); the depth makes up for their rounding.
struct SlantedTexel {
  float depth;      // of the bound at the centre of the texel's square
  uint32_t slopes;  // x in the upper half, y in the lower

  float slope_x() const { return std::bit_cast<float>(slopes & 0xffff0000u); }  // march depth a pixel
  float slope_y() const { return std::bit_cast<float>(slopes << 16); }
};

class SlantedPyramid {
 public:
  // What bounds are made of: slanted planes, or flat ones, which are nowhere behind the pixels' planes
  // either.
  enum class Bounds { slanted, flat };

  // Allocates all levels for this size; contents are set by `build`.
  SlantedPyramid(int width, int height);

  // Fills all levels, all threads, from depth and derivatives as in GBuffer, both of the pyramid's size.
  void build(const Image2D<float>& depth, const Image2D<vec2>& derivatives, int depth_sign, float background,
             Bounds bounds = Bounds::slanted);

  int levels() const { return static_cast<int>(levels_.size()); }
  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }
  int width(int level) const { return levels_[static_cast<size_t>(level)].width; }
  int height(int level) const { return levels_[static_cast<size_t>(level)].height; }
  SlantedTexel at(int level, int x, int y) const {
    return texels_[first_texel(level) + static_cast<size_t>(y) * static_cast<size_t>(row_length(level)) +
                   static_cast<size_t>(x)];
  }

  // All texels, level after level, each row by row: at(level, x, y) is texels()[first_texel(level) + y *
  // row_length(level) + x].
  const SlantedTexel* texels() const { return texels_.data(); }
  size_t first_texel(int level) const { return levels_[static_cast<size_t>(level)].first; }
  int row_length(int level) const { return levels_[static_cast<size_t>(level)].row; }
  size_t memory_bytes() const { return texels_.size() * sizeof(SlantedTexel); }

  // Vector code reads and writes rows in steps of this many texels.
  static constexpr int kRowStep = 32;

 private:
  struct Level {
    int width, height;
    int row;       // width, rounded up; what lies beyond the width is background
    size_t first;  // of its texels in texels_
  };

  std::vector<Level> levels_;
  std::vector<SlantedTexel> texels_;
};

}  // namespace hybray
