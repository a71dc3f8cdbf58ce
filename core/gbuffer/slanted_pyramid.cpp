// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/gbuffer/slanted_pyramid.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/gbuffer/slanted_pyramid.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/gbuffer/depth_pyramid.h"

#include <algorithm>
#include <limits>

#include <hwy/highway.h>

#ifndef HYBRAY_SLANTED_PYRAMID_ONCE
#define HYBRAY_SLANTED_PYRAMID_ONCE
namespace hybray {

// Float code that asks on which side of a bound a ray is may err by that much (core/ssrm/march_plane.h has
// the other part, which depends on the ray): shares of the depth, and of the slopes times the distance in
// pixels over which they are followed.
constexpr float kDepthSlack = 0x1p-21f, kSlopeSlack = 0x1p-20f;

// Depth of pixels and their derivatives, where a row begins, and what turns them into march depth.
struct PixelRow {
  const float* depth;
  const vec2* derivatives;
  int width;
  float sign, background;
};

// What all texels of a level have in common.
struct LevelShape {
  float half;   // half the side of a texel of the level below, pixels; level 0: of its own texels
  float reach;  // how far slopes are followed at most, pixels
  bool flat;
};

}  // namespace hybray
#endif

HWY_BEFORE_NAMESPACE();
namespace hybray {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using M = hn::Mask<DF>;

// To the nearest of the values that 16 bits hold.
HWY_INLINE VF rounded_slope(VF v) {
  const DU du;
  const VU bits = hn::Add(hn::BitCast(du, v), hn::Set(du, 0x8000u));
  return hn::BitCast(DF(), hn::And(bits, hn::Set(du, 0xffff0000u)));
}

HWY_INLINE VF sum_of_magnitudes(VF x, VF y) {
  return hn::Add(hn::Abs(x), hn::Abs(y));
}

// Texels from bounds with rounded slopes, where there are any. `lost`: the greatest difference that went into
// the depth, which may be much greater than the depth itself.
HWY_INLINE void store(VF depth, VF lost, VF slope_x, VF slope_y, M any, const LevelShape& shape,
                      SlantedTexel* to) {
  const DF df;
  const DU du;
  const VF slack =
      hn::Add(hn::Mul(hn::Set(df, kDepthSlack), hn::Add(hn::Abs(depth), lost)),
              hn::Mul(hn::Set(df, kSlopeSlack * shape.reach), sum_of_magnitudes(slope_x, slope_y)));
  const VF bound = hn::IfThenElse(any, hn::Sub(depth, slack), hn::Inf(df));
  const VU slopes = hn::Or(hn::BitCast(du, slope_x), hn::ShiftRight<16>(hn::BitCast(du, slope_y)));
  const VU packed = hn::IfThenElseZero(hn::RebindMask(du, any), slopes);
  hn::StoreInterleaved2(hn::BitCast(du, bound), packed, du, reinterpret_cast<uint32_t*>(to));
}

void build_pixels(const PixelRow& from, const LevelShape& shape, SlantedTexel* to) {
  const DF df;
  const int lanes = static_cast<int>(hn::Lanes(df));
  alignas(64) float depths[16], across[32];
  for (int x = 0; x < from.width; x += lanes) {
    const float* depth_from = from.depth + x;
    const float* slopes_from = &from.derivatives[x].x;
    if (x + lanes > from.width) {  // the rest of a row: nothing beyond the buffers is read
      std::fill(depths, depths + 16, from.background);
      std::fill(across, across + 32, 0.0f);
      std::copy(from.depth + x, from.depth + from.width, depths);
      std::copy(slopes_from, slopes_from + 2 * (from.width - x), across);
      depth_from = depths, slopes_from = across;
    }
    const VF device = hn::LoadU(df, depth_from), sign = hn::Set(df, from.sign);
    VF dx, dy;
    hn::LoadInterleaved2(df, slopes_from, dx, dy);
    dx = hn::Mul(sign, dx), dy = hn::Mul(sign, dy);
    const VF sx = shape.flat ? hn::Zero(df) : rounded_slope(dx), sy = shape.flat ? sx : rounded_slope(dy);
    const VF lost = hn::Mul(hn::Set(df, shape.half), sum_of_magnitudes(hn::Sub(dx, sx), hn::Sub(dy, sy)));
    const M any = hn::Ne(device, hn::Set(df, from.background));
    store(hn::Sub(hn::Mul(sign, device), lost), lost, sx, sy, any, shape, to + x);
  }
}

struct Children {
  VF depth, slope_x, slope_y;
  M any;
};

HWY_INLINE Children unpack(VU depth, VU slopes) {
  const DF df;
  const DU du;
  const VF d = hn::BitCast(df, depth);
  return {d, hn::BitCast(df, hn::And(slopes, hn::Set(du, 0xffff0000u))),
          hn::BitCast(df, hn::ShiftLeft<16>(slopes)), hn::Lt(d, hn::Inf(df))};
}

// One row of a level from the two rows under it.
void build_row(const SlantedTexel* upper, const SlantedTexel* lower, int count, const LevelShape& shape,
               SlantedTexel* to) {
  const DF df;
  const DU du;
  const int lanes = static_cast<int>(hn::Lanes(df));
  const VF zero = hn::Zero(df), one = hn::Set(df, 1.0f), half = hn::Set(df, shape.half);
  for (int x = 0; x < count; x += lanes) {
    VU d0, s0, d1, s1, d2, s2, d3, s3;
    hn::LoadInterleaved4(du, reinterpret_cast<const uint32_t*>(upper + 2 * x), d0, s0, d1, s1);
    hn::LoadInterleaved4(du, reinterpret_cast<const uint32_t*>(lower + 2 * x), d2, s2, d3, s3);
    const Children c[4] = {unpack(d0, s0), unpack(d1, s1), unpack(d2, s2), unpack(d3, s3)};
    // The mean slope of the children: exact where they lie on one plane.
    const auto part = [&](M any, VF v) HWY_ATTR { return hn::IfThenElseZero(any, v); };
    const auto sum = [&](VF a, VF b, VF e, VF f) HWY_ATTR { return hn::Add(hn::Add(a, b), hn::Add(e, f)); };
    VF sx = zero, sy = zero;
    if (!shape.flat) {
      const VF n = sum(part(c[0].any, one), part(c[1].any, one), part(c[2].any, one), part(c[3].any, one));
      const VF share = hn::Div(one, hn::Max(n, one));
      sx = rounded_slope(hn::Mul(share, sum(c[0].slope_x, c[1].slope_x, c[2].slope_x, c[3].slope_x)));
      sy = rounded_slope(hn::Mul(share, sum(c[0].slope_y, c[1].slope_y, c[2].slope_y, c[3].slope_y)));
    }
    // A child's plane, less the new slopes, is least at a corner of its square.
    const VF step_x = hn::Mul(half, sx), step_y = hn::Mul(half, sy);
    VF most = zero;
    const auto least = [&](const Children& child, VF across) HWY_ATTR {
      const VF lost =
          hn::Mul(half, sum_of_magnitudes(hn::Sub(child.slope_x, sx), hn::Sub(child.slope_y, sy)));
      most = hn::Max(most, lost);
      return hn::Sub(hn::Add(child.depth, across), lost);  // infinite where there is nothing
    };
    const VF sum_steps = hn::Add(step_x, step_y), difference = hn::Sub(step_x, step_y);
    const VF top = hn::Min(least(c[0], sum_steps), least(c[1], hn::Neg(difference)));
    const VF bottom = hn::Min(least(c[2], difference), least(c[3], hn::Neg(sum_steps)));
    const M any = hn::Or(hn::Or(c[0].any, c[1].any), hn::Or(c[2].any, c[3].any));
    store(hn::Min(top, bottom), most, sx, sy, any, shape, to + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray {

HWY_EXPORT(build_pixels);
HWY_EXPORT(build_row);

namespace {

// A band of level-0 rows goes through this many levels in one task while it is in the cache.
constexpr int kBandLevels = 5;
constexpr int kBandRows = 1 << kBandLevels;
constexpr SlantedTexel kNothing{std::numeric_limits<float>::infinity(), 0};

}  // namespace

SlantedPyramid::SlantedPyramid(int width, int height) {
  HYBRAY_CHECK_LT(0, std::min(width, height));
  size_t texels = 0;
  for (int l = 0, w = width, h = height; l < DepthPyramid::level_count(width, height);
       ++l, w = (w + 1) / 2, h = (h + 1) / 2) {
    const int row = (w + kRowStep - 1) / kRowStep * kRowStep;
    levels_.push_back({w, h, row, texels});
    texels += static_cast<size_t>(row) * static_cast<size_t>(h);
  }
  texels_.resize(texels, kNothing);
}

void SlantedPyramid::build(const Image2D<float>& depth, const Image2D<vec2>& derivatives, int depth_sign,
                           float background, Bounds bounds) {
  HYBRAY_CHECK_EQ(depth.width(), width());
  HYBRAY_CHECK_EQ(depth.height(), height());
  HYBRAY_CHECK_EQ(derivatives.width(), width());
  HYBRAY_CHECK_EQ(derivatives.height(), height());
  const std::vector<SlantedTexel> nothing(static_cast<size_t>(levels_[0].row), kNothing);
  const auto row_of = [&](int level, int y) {
    return texels_.data() + first_texel(level) +
           static_cast<size_t>(y) * static_cast<size_t>(row_length(level));
  };
  const auto shape_of = [&](int level) {
    const float side = static_cast<float>(1 << level);
    return LevelShape{level == 0 ? 0.5f : 0.25f * side,
                      side + static_cast<float>(std::max(width(), height())), bounds == Bounds::flat};
  };
  const auto build_rows = [&](int level, int first, int last) {
    const int rows_below = height(level - 1);
    for (int y = first; y < last; ++y) HWY_DYNAMIC_DISPATCH(build_row)
    (row_of(level - 1, 2 * y), 2 * y + 1 < rows_below ? row_of(level - 1, 2 * y + 1) : nothing.data(),
     row_length(level - 1) / 2, shape_of(level), row_of(level, y));
  };

  const int bands = (height() + kBandRows - 1) / kBandRows;
  parallel_blocks(static_cast<size_t>(bands), 1, [&](size_t band, size_t) {
    const int first = static_cast<int>(band) * kBandRows, last = std::min(height(), first + kBandRows);
    for (int y = first; y < last; ++y) HWY_DYNAMIC_DISPATCH(build_pixels)
    ({&depth(0, y), &derivatives(0, y), width(), static_cast<float>(depth_sign), background}, shape_of(0),
     row_of(0, y));
    for (int l = 1; l <= kBandLevels && l < levels(); ++l)
      build_rows(l, first >> l, (last + (1 << l) - 1) >> l);
  });
  for (int l = kBandLevels + 1; l < levels(); ++l) build_rows(l, 0, height(l));
}

}  // namespace hybray
#endif
