// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/ssrm/march_paper_lanes.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/ssrm/march_paper_lanes.h"

#include "core/ssrm/march_wave-inl.h"
#include "core/ssrm/plane_lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray::ssrm {
namespace HWY_NAMESPACE {

struct PaperRule {
  static constexpr Ascent kAscent = Ascent::iteration;
  const float* texels;

  HWY_INLINE VF depth_slack(VF) const { return hn::Zero(DF()); }

  // The flat test: the farthest depth of the ray inside the cell against the cell's nearest.
  HWY_INLINE M behind(const Packet& p, VI texel, VF leave, VF, VF) const {
    const VF depth = hn::GatherIndex(DF(), texels, texel);
    const VF farthest = hn::Max(hn::Mul(p.l, p.dz), hn::Mul(leave, p.dz));
    return hn::Gt(farthest, hn::Sub(depth, p.oz));
  }
};

// CellWalk::previous: pixels along one axis before the ray entered `pixel` at `l`.
HWY_INLINE VHI previous(const std::vector<float>& origin, const std::vector<float>& direction, VHI ray,
                        VHI pixel, VHF l) {
  const DHF df;
  const DHI di;
  const VHF o = hn::GatherIndex(df, origin.data(), ray), d = hn::GatherIndex(df, direction.data(), ray);
  const VHF inverse = hn::Div(hn::Set(df, 1.0f), d);
  const VHI back = hn::IfThenElseZero(hn::RebindMask(di, hn::Lt(inverse, hn::Zero(df))), hn::Set(di, 1));
  const VHF border = hn::ConvertTo(df, hn::Add(pixel, back));
  const MHI through = hn::RebindMask(di, hn::Ge(hn::Mul(hn::Sub(border, o), inverse), l));
  const VHI before = hn::Add(pixel, hn::Sub(hn::Add(back, back), hn::Set(di, 1)));
  return hn::IfThenElse(through, before, pixel);
}

// The paper's third stage, correct() of correction.h: `how` of every ray that stopped becomes kHit (x, y: the
// accepted pixel), kBehind or kFailed.
HWY_INLINE void correct_stopped(const DepthView& view, const WaveJob& job, MarchWave::Ended& ended) {
  const DD d;
  const DHF df;
  const DHI di;
  const auto* pixels = reinterpret_cast<const int32_t*>(job.pixels.data());
  const VHI width = hn::Set(di, view.width());
  const VD zero = hn::Zero(d);
  for (size_t i = 0; i < ended.count; i += hn::Lanes(d)) {
    const VHI how = hn::IfThenElseZero(hn::FirstN(di, ended.count - i), hn::LoadU(di, &ended.how[i]));
    const MHI stopped = hn::Eq(how, hn::Set(di, kStopped));
    if (hn::AllFalse(di, stopped)) continue;
    const auto at = [&](const int32_t* field)
                        HWY_ATTR { return hn::IfThenElseZero(stopped, hn::LoadU(di, field + i)); };
    const VHI index = at(reinterpret_cast<const int32_t*>(ended.ray.data()));
    const RayDouble ray(job.rays, index);
    VHI x = at(ended.x.data()), y = at(ended.y.data());
    const PixelGap here = pixel_gap(view, ray, x, y);
    const MHI in_front = narrow(hn::Le(here.enter, zero));
    MHI hit = hn::And(in_front, narrow(hn::Ge(here.leave, zero)));
    const VHF l = hn::LoadU(df, &ended.l[i]);
    const VHI qx = previous(job.rays.ox, job.rays.dx, index, x, l);
    const VHI qy = previous(job.rays.oy, job.rays.dy, index, y, l);
    const MHI is_origin = hn::Eq(hn::Add(hn::Mul(qy, width), qx), hn::GatherIndex(di, pixels, index));
    // A ray that does not start in its own pixel may have been beside the screen.
    const MHI inside = hn::AndNot(hn::Lt(hn::Or(qx, qy), hn::Zero(di)),
                                  hn::And(hn::Lt(qx, width), hn::Lt(qy, hn::Set(di, view.height()))));
    const MHI asks = hn::And(inside, hn::AndNot(hn::Or(hit, is_origin), stopped));
    if (!hn::AllFalse(di, asks)) {
      const PixelGap before = pixel_gap(view, ray, hn::IfThenElse(asks, qx, x), hn::IfThenElse(asks, qy, y));
      const MHI passes = narrow(hn::And(hn::Le(before.enter, zero), hn::Ge(before.leave, zero)));
      const MHI accepts = hn::And(asks, passes);
      x = hn::IfThenElse(accepts, qx, x);
      y = hn::IfThenElse(accepts, qy, y);
      hit = hn::Or(hit, accepts);
    }
    const VHI failed = hn::IfThenElse(in_front, hn::Set(di, kFailed), hn::Set(di, kBehind));
    const VHI found = hn::IfThenElse(hit, hn::Set(di, kHit), failed);
    hn::StoreU(hn::IfThenElse(stopped, found, how), di, &ended.how[i]);
    hn::StoreU(x, di, &ended.x[i]);
    hn::StoreU(y, di, &ended.y[i]);
  }
}

uint64_t march_paper_block(const DepthView& view, const WaveJob& job, size_t begin, size_t end,
                           MarchWave& wave) {
  const uint64_t steps = march_wave(job, PaperRule{view.pyramid.texels()}, begin, end, wave);
  if (job.correct) correct_stopped(view, job, wave.ended);
  return steps;
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::ssrm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray::ssrm {

HWY_EXPORT(march_paper_block);

uint64_t march_paper_lanes(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                           std::span<const uint32_t> which, const MarchOptions& options,
                           MarchResults& results) {
  const WaveJob job(rays, pixels, which, view.pyramid, options);
  return march_in_blocks(job, [&](size_t begin, size_t end, MarchWave& wave) {
    const uint64_t steps = HWY_DYNAMIC_DISPATCH(march_paper_block)(view, job, begin, end, wave);
    write_results(rays, view.width(), wave.ended, results);
    return steps;
  });
}

}  // namespace hybray::ssrm
#endif
