// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/ssrm/march_plane_lanes.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/ssrm/march_plane_lanes.h"

#include "core/ssrm/march_plane.h"
#include "core/ssrm/march_wave-inl.h"
#include "core/ssrm/plane_lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray::ssrm {
namespace HWY_NAMESPACE {

// may_be_behind of march_plane.cpp.
template <Ascent kWhen>
struct PlaneRule {
  static constexpr Ascent kAscent = kWhen;
  const SlantedTexel* texels;

  HWY_INLINE VF depth_slack(VF oz) const { return hn::Mul(hn::Set(DF(), kOriginSlack), hn::Abs(oz)); }

  HWY_INLINE M behind(const Packet& p, VI texel, VF leave, VF to_center_x, VF to_center_y) const {
    const DF df;
    const DU du;
    const auto* halves = reinterpret_cast<const uint32_t*>(texels);
    const VI place = hn::Add(texel, texel);
    const VF depth = hn::BitCast(df, hn::GatherIndex(du, halves, place));
    const VU slopes = hn::GatherIndex(du, halves + 1, place);
    const VF slope_x = hn::BitCast(df, hn::And(slopes, hn::Set(du, 0xffff0000u)));
    const VF slope_y = hn::BitCast(df, hn::ShiftLeft<16>(slopes));
    const VF across = hn::Add(hn::Mul(slope_x, to_center_x), hn::Mul(slope_y, to_center_y));
    const VF bound = hn::Sub(hn::Sub(depth, p.oz), across);
    const VF rise = hn::Sub(p.dz, hn::Add(hn::Mul(slope_x, p.x.direction), hn::Mul(slope_y, p.y.direction)));
    return hn::Gt(hn::Max(hn::Mul(p.l, rise), hn::Mul(leave, rise)), bound);
  }
};

// pixel_crossing for every ray that stopped: `how` becomes kHit, kBehind or kCleared.
HWY_INLINE void look_closer(const DepthView& view, const ScreenRays& rays, MarchWave::Ended& ended) {
  const DD d;
  const DHI di;
  for (size_t i = 0; i < ended.count; i += hn::Lanes(d)) {
    const VHI how = hn::IfThenElseZero(hn::FirstN(di, ended.count - i), hn::LoadU(di, &ended.how[i]));
    const MHI stopped = hn::Eq(how, hn::Set(di, kStopped));
    if (hn::AllFalse(di, stopped)) continue;
    const auto at = [&](const int32_t* field)
                        HWY_ATTR { return hn::IfThenElseZero(stopped, hn::LoadU(di, field + i)); };
    const RayDouble ray(rays, at(reinterpret_cast<const int32_t*>(ended.ray.data())));
    const PixelGap gap = pixel_gap(view, ray, at(ended.x.data()), at(ended.y.data()));
    const VD tolerance = hn::Mul(hn::Set(d, kBufferRounding), gap.magnitude);
    const auto leaves_behind = hn::Gt(gap.leave, tolerance);
    const MHI behind = narrow(hn::Gt(gap.enter, hn::IfThenZeroElse(leaves_behind, tolerance))),
              leaves = narrow(leaves_behind);
    const VHI in_front = hn::IfThenElse(leaves, hn::Set(di, kHit), hn::Set(di, kCleared));
    const VHI found = hn::IfThenElse(behind, hn::Set(di, kBehind), in_front);
    hn::StoreU(hn::IfThenElse(stopped, found, how), di, &ended.how[i]);
  }
}

uint64_t march_plane_block(const DepthView& view, const WaveJob& job, size_t begin, size_t end,
                           MarchWave& wave) {
  const SlantedTexel* texels = view.slanted->texels();
  const uint64_t steps = job.ascent == Ascent::parent
                             ? march_wave(job, PlaneRule<Ascent::parent>{texels}, begin, end, wave)
                             : march_wave(job, PlaneRule<Ascent::iteration>{texels}, begin, end, wave);
  if (job.correct) look_closer(view, job.rays, wave.ended);
  return steps;
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::ssrm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray::ssrm {

HWY_EXPORT(march_plane_block);

uint64_t march_plane_lanes(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                           std::span<const uint32_t> which, const MarchOptions& options,
                           MarchResults& results) {
  const WaveJob job(rays, pixels, which, *view.slanted, options);
  return march_in_blocks(job, [&](size_t begin, size_t end, MarchWave& wave) {
    uint64_t steps = HWY_DYNAMIC_DISPATCH(march_plane_block)(view, job, begin, end, wave);
    const MarchWave::Ended& ended = wave.ended;
    size_t cleared = write_results(rays, view.width(), ended, results);
    // The few that a closer look clears go on as scalar code.
    for (size_t i = 0; cleared > 0; ++i) {
      if (ended.how[i] != kCleared) continue;
      --cleared;
      const uint32_t ray = ended.ray[i];
      const PlaneMarch from{ended.x[i],       ended.y[i], ended.l[i], static_cast<uint64_t>(ended.taken[i]),
                            ended.samples[i], true};
      const Correction c = continue_plane_ray(view, rays.get<float>(ray), from, options, steps);
      results.verdict[ray] = c.verdict;
      results.pixel[ray] = c.pixel;
      if (!results.proved.empty()) results.proved[ray] = c.l;
    }
    return steps;
  });
}

}  // namespace hybray::ssrm
#endif
