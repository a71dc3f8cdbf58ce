#include "core/gbuffer/depth_pyramid.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace hybray {
namespace {

// A band of level-0 rows is reduced through this many levels by one task while it is in the cache; what is
// left above is small.
constexpr int kBandLevels = 5;
constexpr int kBandRows = 1 << kBandLevels;

}  // namespace

int DepthPyramid::level_count(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::min(width, height)));
}

DepthPyramid::DepthPyramid(int width, int height) {
  HYBRAY_CHECK_LT(0, std::min(width, height));
  size_t texels = 0;
  for (int l = 0, w = width, h = height; l < level_count(width, height);
       ++l, w = (w + 1) / 2, h = (h + 1) / 2) {
    levels_.push_back({w, h, texels});
    texels += static_cast<size_t>(w) * static_cast<size_t>(h);
  }
  texels_.resize(texels);
}

void DepthPyramid::reduce_rows(int level, int first_row, int last_row) {
  const Level& below = levels_[level - 1];
  const Level& here = levels_[level];
  const auto row_below = [&](int y) {
    return texels_.data() + below.first + static_cast<size_t>(std::min(y, below.height - 1)) * below.width;
  };
  for (int y = first_row; y < last_row; ++y) {
    const float* a = row_below(2 * y);
    const float* b = row_below(2 * y + 1);
    float* out = texels_.data() + here.first + static_cast<size_t>(y) * here.width;
    const int whole = below.width / 2;
    for (int x = 0; x < whole; ++x)
      out[x] = std::min(std::min(a[2 * x], a[2 * x + 1]), std::min(b[2 * x], b[2 * x + 1]));
    if (whole < here.width) out[whole] = std::min(a[2 * whole], b[2 * whole]);
  }
}

void DepthPyramid::build(const Image2D<float>& depth, int depth_sign, float background, int levels) {
  HYBRAY_CHECK_EQ(depth.width(), width());
  HYBRAY_CHECK_EQ(depth.height(), height());
  const float sign = static_cast<float>(depth_sign);
  const int h = height(), w = width(), built = std::min(levels, this->levels());
  const int bands = (h + kBandRows - 1) / kBandRows;
  parallel_blocks(static_cast<size_t>(bands), 1, [&](size_t band, size_t) {
    const int first = static_cast<int>(band) * kBandRows, last = std::min(h, first + kBandRows);
    const float* in = depth.data() + static_cast<size_t>(first) * w;
    float* out = texels_.data() + static_cast<size_t>(first) * w;
    for (size_t i = 0; i < static_cast<size_t>(last - first) * w; ++i)
      out[i] = in[i] == background ? std::numeric_limits<float>::infinity() : sign * in[i];
    for (int l = 1; l <= kBandLevels && l < built; ++l)
      reduce_rows(l, first >> l, (last + (1 << l) - 1) >> l);
  });
  for (int l = kBandLevels + 1; l < built; ++l) reduce_rows(l, 0, levels_[l].height);
}

}  // namespace hybray
