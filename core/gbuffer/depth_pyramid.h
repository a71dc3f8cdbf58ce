// Hierarchical depth buffer: level 0 is a copy of the depth buffer, a texel of each further level holds the
// depth nearest to the viewer of the 2x2 texels below it (SSRM paper, "hierarchical depth buffer").
//
// Depths are kept as march depths, sign * device depth with the sign of View::depth_sign(), so that "nearest"
// is always the smallest, whichever depth convention the buffer has; negation loses nothing. Background
// texels hold +infinity: no ray is ever behind them.
//
// Level l has ceil(W / 2^l) x ceil(H / 2^l) texels, so that texel (x, y) of level 0 lies under texel (x >> l,
// y >> l) at every size, odd ones included; a floor would lose the last row or column, and rays would pass
// through walls there. Texels outside the screen take no part.
#pragma once

#include "core/base/image2d.h"

#include <cstddef>
#include <vector>

namespace hybray {

class DepthPyramid {
 public:
  // floor(log2(min(W, H))) + 1: 11 for 1920x1080, 12 for 3840x2160.
  static int level_count(int width, int height);

  // Allocates all levels for this size; contents are set by `build`.
  DepthPyramid(int width, int height);

  // Fills the first `levels` levels from a depth buffer of the same size, all threads. `background` is the
  // value of pixels that see nothing.
  void build(const Image2D<float>& depth, int depth_sign, float background, int levels = kAllLevels);
  static constexpr int kAllLevels = 32;

  int levels() const { return static_cast<int>(levels_.size()); }
  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }
  int width(int level) const { return levels_[level].width; }
  int height(int level) const { return levels_[level].height; }
  float at(int level, int x, int y) const {
    const Level& l = levels_[level];
    return texels_[l.first + static_cast<size_t>(y) * static_cast<size_t>(l.width) + static_cast<size_t>(x)];
  }
  // All texels, level after level, each row by row: at(level, x, y) is texels()[first_texel(level) + y *
  // row_length(level) + x].
  const float* texels() const { return texels_.data(); }
  size_t first_texel(int level) const { return levels_[level].first; }
  int row_length(int level) const { return levels_[level].width; }
  size_t memory_bytes() const { return texels_.size() * sizeof(float); }

 private:
  struct Level {
    int width, height;
    size_t first;  // of its texels in texels_
  };
  void reduce_rows(int level, int first_row, int last_row);

  std::vector<Level> levels_;
  std::vector<float> texels_;
};

}  // namespace hybray
