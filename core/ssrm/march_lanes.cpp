// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/ssrm/march_lanes.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/ssrm/march_lanes.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <array>
#include <atomic>
#include <memory>

#include <hwy/highway.h>
#include <tbb/enumerable_thread_specific.h>

#ifndef HYBRAY_MARCH_LANES_ONCE
#define HYBRAY_MARCH_LANES_ONCE
namespace hybray::ssrm {

// Rays of one block that are still under way, in waves: a wave moves every ray by some steps, and those that
// have ended drop out of the next, so that few lanes idle.
struct MarchWave {
  static constexpr size_t kSize = 1024, kAllocated = kSize + 32;
  template <class T>
  using Lanes = std::array<T, kAllocated>;

  alignas(64) Lanes<float> ox, oy, oz, ix, iy, dz, l_end, l;  // ix, iy: inverse directions
  alignas(64) Lanes<int32_t> px, py, level, samples, taken;   // taken: of a budget
  alignas(64) Lanes<uint32_t> ray;
  size_t count = 0;
};

// Rays that stopped behind a pixel's depth and await correction.
struct StoppedRays {
  template <class T>
  using Lanes = MarchWave::Lanes<T>;
  alignas(64) Lanes<uint32_t> ray;
  alignas(64) Lanes<int32_t> px, py, previous_x, previous_y;
  alignas(64) Lanes<float> l;  // where they entered the pixel; kept only where it is asked for
  size_t count = 0;
};

struct EndedRays {
  alignas(64) MarchWave::Lanes<uint32_t> ray;
  alignas(64) MarchWave::Lanes<int32_t> how;
  alignas(64) MarchWave::Lanes<float> l;  // where they ended; kept only where it is asked for
  size_t count = 0;
};

struct MarchMemory {
  MarchWave wave;
  StoppedRays stopped;
  EndedRays ended;
};

// First texel of each level: as many as a vector of the widest machine holds.
constexpr int kMostLevels = 16;
using FirstTexels = std::array<int32_t, kMostLevels>;

// How a lane's march ended.
enum : int32_t { kUnderWay, kAtEnd, kOffscreen, kStopped, kOutOfBudget };

struct MarchJob {
  const DepthView& view;
  const ScreenRays& rays;
  const std::vector<uint32_t>& pixels;
  int32_t step_budget;    // 0: none
  const uint32_t* which;  // rays of the list to march; null: all of them
  bool correct, keeps_l;
  alignas(64) FirstTexels first_texels;
};

}  // namespace hybray::ssrm
#endif

HWY_BEFORE_NAMESPACE();
namespace hybray::ssrm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, 16>;
using DI = hn::RebindToSigned<DF>;
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using M = hn::Mask<DF>;
using MI = hn::Mask<DI>;

HWY_INLINE MI as_int(M m) {
  return hn::RebindMask(DI(), m);
}
HWY_INLINE M as_float(MI m) {
  return hn::RebindMask(DF(), m);
}

// Axis of cell_walk.h.
struct AxisLanes {
  VF origin, inverse;
  VI back;  // 0 forward, 1 backward
  int32_t size;

  HWY_INLINE AxisLanes(VF o, VF inverse_direction, int pixels)
      : origin(o),
        inverse(inverse_direction),
        back(hn::IfThenElseZero(as_int(hn::Lt(inverse, hn::Zero(DF()))), hn::Set(DI(), 1))),
        size(pixels) {}

  HWY_INLINE VF crossing(VI border) const {
    return hn::Mul(hn::Sub(hn::ConvertTo(DF(), border), origin), inverse);
  }
  HWY_INLINE VI exit_border(VI cell, VI level) const {
    const VI next = hn::Add(cell, hn::Sub(hn::Set(DI(), 1), back));
    return hn::Min(hn::Shl(next, level), hn::Set(DI(), size));
  }
  HWY_INLINE VI pixel_after(VI border) const { return hn::Sub(border, back); }
  HWY_INLINE MI outside(VI pixel) const {
    return hn::Or(hn::Eq(pixel, hn::Set(DI(), size)), hn::Eq(pixel, hn::Set(DI(), -1)));
  }
  // The pixel before `pixel`, where the ray entered that through its border here at `l` or later.
  HWY_INLINE VI previous(VI pixel, VF l) const {
    const MI through = as_int(hn::Ge(crossing(hn::Add(pixel, back)), l));
    const VI before = hn::Add(pixel, hn::Sub(hn::Add(back, back), hn::Set(DI(), 1)));
    return hn::IfThenElse(through, before, pixel);
  }
  // Which half of a cell of `level` >= 1 the ray is in at `l`.
  HWY_INLINE VI descend(VI pixel, VI cell, VI level, VF l, MI where) const {
    const DI di;
    const VI one = hn::Set(di, 1);
    const VI middle = hn::Shl(hn::Add(hn::Add(cell, cell), one), hn::Max(hn::Sub(level, one), hn::Zero(di)));
    const MI passed = as_int(hn::Le(crossing(middle), l));
    const VI half = hn::Min(pixel_after(middle), hn::Set(di, size - 1));
    return hn::IfThenElse(hn::And(where, passed), half, pixel);
  }
};

// One vector of rays under way.
struct Packet {
  AxisLanes x, y;
  VF oz, dz, l_end, l;
  VI px, py, level, samples, taken, how;
  M live;

  HWY_INLINE Packet(const MarchWave& wave, size_t at, const DepthView& view)
      : x(hn::Load(DF(), &wave.ox[at]), hn::Load(DF(), &wave.ix[at]), view.width()),
        y(hn::Load(DF(), &wave.oy[at]), hn::Load(DF(), &wave.iy[at]), view.height()),
        oz(hn::Load(DF(), &wave.oz[at])),
        dz(hn::Load(DF(), &wave.dz[at])),
        l_end(hn::Load(DF(), &wave.l_end[at])),
        l(hn::Load(DF(), &wave.l[at])),
        px(hn::Load(DI(), &wave.px[at])),
        py(hn::Load(DI(), &wave.py[at])),
        level(hn::Load(DI(), &wave.level[at])),
        samples(hn::Load(DI(), &wave.samples[at])),
        taken(hn::Load(DI(), &wave.taken[at])),
        how(hn::Zero(DI())),
        live(hn::FirstN(DF(), at < wave.count ? wave.count - at : 0)) {}
};

// The table's entries of the lanes' levels, without a gather where they fit into one or two vectors.
HWY_INLINE VI first_texel(const FirstTexels& table, VI level) {
  const DI di;
#if HWY_TARGET != HWY_SCALAR
  constexpr size_t kLanes = hn::MaxLanes(DI());
  const auto look_up = [&](size_t first, VI index) HWY_ATTR {
    return hn::TableLookupLanes(hn::Load(di, table.data() + first), hn::IndicesFromVec(di, index));
  };
  if constexpr (kLanes == kMostLevels) return look_up(0, level);
  if constexpr (2 * kLanes == kMostLevels) {
    const VI lanes = hn::Set(di, static_cast<int32_t>(kLanes));
    const VI index = hn::And(level, hn::Sub(lanes, hn::Set(di, 1)));
    return hn::IfThenElse(hn::Lt(level, lanes), look_up(0, index), look_up(kLanes, index));
  }
#endif
  return hn::GatherIndex(di, table.data(), level);
}

// in_front_of_slant() of march_paper.cpp, in the lanes `where`.
HWY_INLINE M in_front_of_slant(const Packet& p, const DepthView& view, VF leave, M where) {
  const DF df;
  const DI di;
  const VI pixel = hn::IfThenElseZero(as_int(where), hn::Add(hn::Mul(p.py, hn::Set(di, view.width())), p.px));
  const VI pair = hn::Add(pixel, pixel);
  const float* slopes = &view.derivatives.data()->x;
  const VF one = hn::Set(df, 1.0f), half = hn::Set(df, 0.5f), zero = hn::Zero(df);
  const VF sign = hn::Set(df, static_cast<float>(view.depth_sign));
  const VF gx = hn::Mul(sign, hn::GatherIndex(df, slopes, pair));
  const VF gy = hn::Mul(sign, hn::GatherIndex(df, slopes + 1, pair));
  const VF intercept = hn::GatherIndex(df, view.intercept->data(), pixel);
  const VF dx = hn::Div(one, p.x.inverse), dy = hn::Div(one, p.y.inverse);
  const VF across_x = hn::Mul(gx, hn::Sub(p.x.origin, hn::Add(hn::ConvertTo(df, p.px), half)));
  const VF across_y = hn::Mul(gy, hn::Sub(p.y.origin, hn::Add(hn::ConvertTo(df, p.py), half)));
  const VF offset = hn::Sub(hn::Sub(hn::Sub(p.oz, intercept), across_x), across_y);
  const VF slope = hn::Sub(hn::Sub(p.dz, hn::Mul(gx, dx)), hn::Mul(gy, dy));
  return hn::And(hn::Le(hn::Add(offset, hn::Mul(p.l, slope)), zero),
                 hn::Le(hn::Add(offset, hn::Mul(leave, slope)), zero));
}

// One depth sample of each live lane: march_paper_ray's loop body. Returns how many there were.
template <bool kBudget, bool kSlanted>
HWY_INLINE size_t step(Packet& p, const MarchJob& job, const float* texels, VI top) {
  const DF df;
  const DI di;
  const VI one = hn::Set(di, 1);
  if constexpr (kBudget) {
    const MI spent = hn::And(as_int(p.live), hn::Eq(p.taken, hn::Set(di, job.step_budget)));
    p.how = hn::IfThenElse(spent, hn::Set(di, kOutOfBudget), p.how);
    p.live = hn::AndNot(as_float(spent), p.live);
    p.taken = hn::Add(p.taken, one);
  }
  const VI cell_x = hn::Shr(p.px, p.level), cell_y = hn::Shr(p.py, p.level);
  const VI border_x = p.x.exit_border(cell_x, p.level), border_y = p.y.exit_border(cell_y, p.level);
  const VF lx = p.x.crossing(border_x), ly = p.y.crossing(border_y);
  const VF exit = hn::Min(lx, ly);
  const VF leave = hn::Min(p.l_end, exit);
  const VF farthest = hn::Max(hn::Mul(p.l, p.dz), hn::Mul(leave, p.dz));
  const VI row = hn::Add(hn::Shr(hn::Set(di, job.view.width() - 1), p.level), one);  // length, in texels
  const VI texel = hn::Add(hn::Add(first_texel(job.first_texels, p.level), cell_x), hn::Mul(cell_y, row));
  const VF depth = hn::GatherIndex(df, texels, hn::IfThenElseZero(as_int(p.live), texel));
  M behind = hn::Gt(farthest, hn::Sub(depth, p.oz));
  if constexpr (kSlanted) {
    const M asked = hn::And(hn::And(p.live, behind), as_float(hn::Eq(p.level, hn::Zero(di))));
    if (!hn::AllFalse(df, asked))
      behind = hn::AndNot(hn::And(asked, in_front_of_slant(p, job.view, leave, asked)), behind);
  }
  const M ends = hn::Le(p.l_end, exit);

  const M intersects = hn::And(p.live, behind), clear = hn::AndNot(behind, p.live);
  const M at_end = hn::And(clear, ends), advances = hn::AndNot(ends, clear);
  const MI ground = hn::Eq(p.level, hn::Zero(di));
  const MI stops = hn::And(as_int(intersects), ground), descends = hn::AndNot(ground, as_int(intersects));
  const MI goes = as_int(advances);
  const size_t count = hn::CountTrue(df, p.live);

  const MI goes_x = as_int(hn::And(advances, hn::Le(lx, exit)));
  const MI goes_y = as_int(hn::And(advances, hn::Le(ly, exit)));
  const VI next_x = p.x.pixel_after(border_x), next_y = p.y.pixel_after(border_y);
  p.px = hn::IfThenElse(goes_x, next_x, p.px);
  p.py = hn::IfThenElse(goes_y, next_y, p.py);
  const MI leaves = hn::And(goes, hn::Or(p.x.outside(p.px), p.y.outside(p.py)));
  p.l = hn::IfThenElse(advances, exit, p.l);

  p.px = p.x.descend(p.px, cell_x, p.level, p.l, descends);
  p.py = p.y.descend(p.py, cell_y, p.level, p.l, descends);

  const VI more = hn::Add(p.samples, one);
  const MI full = hn::And(goes, hn::Eq(more, hn::Set(di, kSamplesPerIteration)));
  p.samples = hn::IfThenZeroElse(hn::Or(full, descends), more);
  p.level = hn::IfThenElse(full, hn::Min(hn::Add(p.level, one), top), p.level);
  p.level = hn::IfThenElse(descends, hn::Sub(p.level, one), p.level);

  p.how = hn::IfThenElse(as_int(at_end), hn::Set(di, kAtEnd), p.how);
  p.how = hn::IfThenElse(leaves, hn::Set(di, kOffscreen), p.how);
  p.how = hn::IfThenElse(stops, hn::Set(di, kStopped), p.how);
  p.live = hn::AndNot(hn::Or(at_end, hn::Or(as_float(leaves), as_float(stops))), p.live);
  return count;
}

// Packs the lanes under way to the front of the wave, from `out` on, and the others into the lists of the
// ended; returns where the next packet's lanes go.
HWY_INLINE size_t write_back(const Packet& p, size_t at, size_t out, M here, bool keeps_l,
                             MarchMemory& memory) {
  const DF df;
  const DI di;
  const DU du;
  MarchWave& wave = memory.wave;
  const VU ray = hn::Load(du, &wave.ray[at]);
  const MI stopped = hn::And(as_int(here), hn::Eq(p.how, hn::Set(di, kStopped)));
  const MI ended = hn::AndNot(hn::Or(as_int(p.live), stopped), as_int(here));
  if (!hn::AllFalse(di, stopped)) {
    StoppedRays& to = memory.stopped;
    const VI previous_x = p.x.previous(p.px, p.l), previous_y = p.y.previous(p.py, p.l);
    hn::CompressStore(ray, hn::RebindMask(du, stopped), du, &to.ray[to.count]);
    hn::CompressStore(p.px, stopped, di, &to.px[to.count]);
    hn::CompressStore(p.py, stopped, di, &to.py[to.count]);
    hn::CompressStore(previous_x, stopped, di, &to.previous_x[to.count]);
    hn::CompressStore(previous_y, stopped, di, &to.previous_y[to.count]);
    if (keeps_l) hn::CompressStore(p.l, as_float(stopped), df, &to.l[to.count]);
    to.count += hn::CountTrue(di, stopped);
  }
  if (!hn::AllFalse(di, ended)) {
    EndedRays& to = memory.ended;
    hn::CompressStore(ray, hn::RebindMask(du, ended), du, &to.ray[to.count]);
    hn::CompressStore(p.how, ended, di, &to.how[to.count]);
    if (keeps_l) {
      const M at_end = as_float(hn::Eq(p.how, hn::Set(di, kAtEnd)));
      hn::CompressStore(hn::IfThenElse(at_end, p.l_end, p.l), as_float(ended), df, &to.l[to.count]);
    }
    to.count += hn::CountTrue(di, ended);
  }
  const auto keep = [&](VF v, float* to) HWY_ATTR { hn::CompressStore(v, p.live, df, to + out); };
  const auto keep_int = [&](VI v, int32_t* to)
                            HWY_ATTR { hn::CompressStore(v, as_int(p.live), di, to + out); };
  keep(p.x.origin, wave.ox.data()), keep(p.y.origin, wave.oy.data());
  keep(p.x.inverse, wave.ix.data()), keep(p.y.inverse, wave.iy.data());
  keep(p.oz, wave.oz.data()), keep(p.dz, wave.dz.data());
  keep(p.l_end, wave.l_end.data()), keep(p.l, wave.l.data());
  keep_int(p.px, wave.px.data()), keep_int(p.py, wave.py.data());
  keep_int(p.level, wave.level.data()), keep_int(p.samples, wave.samples.data());
  keep_int(p.taken, wave.taken.data());
  hn::CompressStore(ray, hn::RebindMask(du, p.live), du, wave.ray.data() + out);
  return out + hn::CountTrue(df, p.live);
}

// Copies rays [begin, end), or those places of the list, into the wave.
HWY_INLINE void gather_rays(const MarchJob& job, size_t begin, size_t count, MarchWave& wave) {
  if (job.which)
    std::copy_n(job.which + begin, count, wave.ray.data());
  else
    for (size_t i = 0; i < count; ++i) wave.ray[i] = static_cast<uint32_t>(begin + i);
  const auto copy = [&](const std::vector<float>& from, MarchWave::Lanes<float>& to) {
    if (!job.which)
      std::copy_n(from.data() + begin, count, to.data());
    else
      for (size_t i = 0; i < count; ++i) to[i] = from[wave.ray[i]];
  };
  copy(job.rays.ox, wave.ox), copy(job.rays.oy, wave.oy), copy(job.rays.oz, wave.oz);
  copy(job.rays.dx, wave.ix), copy(job.rays.dy, wave.iy), copy(job.rays.dz, wave.dz);
  copy(job.rays.l_end, wave.l_end);
}

// Stage 1: every ray of [begin, end), places of the list if there is one, up to the exit of its own pixel.
HWY_INLINE void start(const MarchJob& job, size_t begin, size_t end, MarchMemory& memory) {
  const DF df;
  const DI di;
  const size_t lanes = hn::Lanes(df), count = end - begin;
  MarchWave& wave = memory.wave;
  memory.stopped.count = memory.ended.count = 0;
  gather_rays(job, begin, count, wave);
  const int32_t width = job.view.width();
  const double inverse_width = 1.0 / width;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t pixel = job.pixels[wave.ray[i]];
    // Exact: a half is further from the next whole row than rounding reaches.
    const auto row = static_cast<int32_t>((static_cast<double>(pixel) + 0.5) * inverse_width);
    wave.py[i] = row;
    wave.px[i] = static_cast<int32_t>(pixel) - row * width;
  }
  wave.count = count;
  const VI zero = hn::Zero(di);
  size_t out = 0;
  for (size_t at = 0; at < count; at += lanes) {
    for (MarchWave::Lanes<float>* inverse : {&wave.ix, &wave.iy})
      hn::Store(hn::Div(hn::Set(df, 1.0f), hn::Load(df, &(*inverse)[at])), df, &(*inverse)[at]);
    Packet p(wave, at, job.view);
    p.level = p.samples = p.taken = zero;
    const M here = p.live;
    const VI border_x = p.x.exit_border(p.px, zero), border_y = p.y.exit_border(p.py, zero);
    const VF lx = p.x.crossing(border_x), ly = p.y.crossing(border_y);
    p.l = hn::Min(lx, ly);
    const M ends = hn::Le(p.l_end, p.l);
    p.px = hn::IfThenElse(as_int(hn::Le(lx, p.l)), p.x.pixel_after(border_x), p.px);
    p.py = hn::IfThenElse(as_int(hn::Le(ly, p.l)), p.y.pixel_after(border_y), p.py);
    const M leaves = as_float(hn::Or(p.x.outside(p.px), p.y.outside(p.py)));
    p.how = hn::IfThenElse(as_int(ends), hn::Set(di, kAtEnd), hn::Set(di, kOffscreen));
    p.live = hn::AndNot(hn::Or(ends, leaves), here);
    out = write_back(p, at, out, here, job.keeps_l, memory);
  }
  wave.count = out;
}

// Stage 2, until no ray is under way.
template <bool kBudget, bool kSlanted>
HWY_INLINE uint64_t march(const MarchJob& job, MarchMemory& memory) {
  constexpr int kStepsPerWave = 8;
  const DI di;
  const size_t lanes = hn::Lanes(di);
  MarchWave& wave = memory.wave;
  const VI top = hn::Set(di, job.view.pyramid.levels() - 1);
  const float* texels = job.view.pyramid.texels();
  uint64_t steps = 0;
  while (wave.count > 0) {
    size_t out = 0;
    for (size_t at = 0; at < wave.count; at += 2 * lanes) {
      // Two at a time: one computes while the other waits.
      Packet a(wave, at, job.view), b(wave, at + lanes, job.view);
      const M here_a = a.live, here_b = b.live;
      for (int k = 0; k < kStepsPerWave; ++k) {
        steps += step<kBudget, kSlanted>(a, job, texels, top);
        steps += step<kBudget, kSlanted>(b, job, texels, top);
      }
      out = write_back(a, at, out, here_a, job.keeps_l, memory);
      out = write_back(b, at + lanes, out, here_b, job.keeps_l, memory);
    }
    wave.count = out;
  }
  return steps;
}

// Stage 3, in double: correct() of correction.h.
using DD = hn::CappedTag<double, 8>;
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;
using DH = hn::Rebind<float, DD>;
using DHI = hn::Rebind<int32_t, DD>;
using VHI = hn::Vec<DHI>;

struct AxisDouble {
  VD origin, direction, inverse, entry;  // entry border - pixel: 0 forward, 1 backward

  HWY_INLINE AxisDouble(VD o, VD d)
      : origin(o),
        direction(d),
        inverse(hn::Div(hn::Set(DD(), 1.0), d)),
        entry(hn::IfThenElseZero(hn::Lt(d, hn::Zero(DD())), hn::Set(DD(), 1.0))) {}
  HWY_INLINE VD crossing(VD border) const { return hn::Mul(hn::Sub(border, origin), inverse); }
  HWY_INLINE VD enter(VD pixel) const { return crossing(hn::Add(pixel, entry)); }
  HWY_INLINE VD leave(VD pixel) const { return crossing(hn::Add(pixel, hn::Sub(hn::Set(DD(), 1.0), entry))); }
};

struct RayDouble {
  AxisDouble x, y;
  VD oz, dz, l_end;
};

struct SlantedLanes {
  MD enters_in_front, passes;
};

HWY_INLINE SlantedLanes slanted(const DepthView& view, const RayDouble& ray, VHI px, VHI py) {
  const DD d;
  const DH dh;
  const DHI di;
  const VHI pixel = hn::Add(hn::Mul(py, hn::Set(di, view.width())), px), pair = hn::Add(pixel, pixel);
  const float* slopes = &view.derivatives.data()->x;
  const VD sign = hn::Set(d, static_cast<double>(view.depth_sign));
  const VD gx = hn::Mul(sign, hn::PromoteTo(d, hn::GatherIndex(dh, slopes, pair)));
  const VD gy = hn::Mul(sign, hn::PromoteTo(d, hn::GatherIndex(dh, slopes + 1, pair)));
  const VD center = hn::PromoteTo(d, hn::GatherIndex(dh, view.pyramid.texels(), pixel));
  const VD x = hn::PromoteTo(d, px), y = hn::PromoteTo(d, py), half = hn::Set(d, 0.5);
  const VD across_x = hn::Mul(gx, hn::Sub(ray.x.origin, hn::Add(x, half)));
  const VD across_y = hn::Mul(gy, hn::Sub(ray.y.origin, hn::Add(y, half)));
  const VD offset = hn::Sub(hn::Sub(hn::Sub(ray.oz, center), across_x), across_y);
  const VD slope = hn::Sub(hn::Sub(ray.dz, hn::Mul(gx, ray.x.direction)), hn::Mul(gy, ray.y.direction));
  const VD enter = hn::Max(ray.x.enter(x), ray.y.enter(y));
  const VD leave = hn::Min(hn::Min(ray.x.leave(x), ray.y.leave(y)), ray.l_end);
  const MD in_front = hn::Le(hn::Add(offset, hn::Mul(enter, slope)), hn::Zero(d));
  const MD behind = hn::Ge(hn::Add(offset, hn::Mul(leave, slope)), hn::Zero(d));
  return {in_front, hn::And(in_front, behind)};
}

HWY_INLINE void correct_stopped(const MarchJob& job, MarchMemory& memory, MarchResults& results) {
  const DD d;
  const DH dh;
  const DHI di;
  const size_t lanes = hn::Lanes(d);
  const StoppedRays& from = memory.stopped;
  const ScreenRays& rays = job.rays;
  const auto* pixels = reinterpret_cast<const int32_t*>(job.pixels.data());
  alignas(64) int32_t accepted[8], verdict[8];
  for (size_t i = 0; i < from.count; i += lanes) {
    const auto here = hn::FirstN(di, from.count - i);
    const VHI ray = hn::IfThenElseZero(here, hn::LoadU(di, reinterpret_cast<const int32_t*>(&from.ray[i])));
    const auto get = [&](const std::vector<float>& field)
                         HWY_ATTR { return hn::PromoteTo(d, hn::GatherIndex(dh, field.data(), ray)); };
    const RayDouble r{AxisDouble(get(rays.ox), get(rays.dx)), AxisDouble(get(rays.oy), get(rays.dy)),
                      get(rays.oz), get(rays.dz), get(rays.l_end)};
    const auto at = [&](const StoppedRays::Lanes<int32_t>& field)
                        HWY_ATTR { return hn::IfThenElseZero(here, hn::LoadU(di, &field[i])); };
    const VHI px = at(from.px), py = at(from.py), qx = at(from.previous_x), qy = at(from.previous_y);
    const VHI width = hn::Set(di, job.view.width());
    const VHI pixel = hn::Add(hn::Mul(py, width), px), previous = hn::Add(hn::Mul(qy, width), qx);
    const SlantedLanes first = slanted(job.view, r, px, py);
    const auto mask = [](MD m) HWY_ATTR {
      uint8_t bits[8] = {};
      hn::StoreMaskBits(DD(), m, bits);
      return hn::LoadMaskBits(DHI(), bits);
    };
    const auto first_passes = mask(first.passes), in_front = mask(first.enters_in_front);
    const auto may_be_previous = hn::Ne(previous, hn::GatherIndex(di, pixels, ray));
    VHI hit = hn::IfThenElse(first_passes, pixel, hn::Set(di, -1));
    const auto second = hn::AndNot(first_passes, hn::And(here, may_be_previous));
    if (!hn::AllFalse(di, second)) {
      const auto passes = hn::And(second, mask(slanted(job.view, r, qx, qy).passes));
      hit = hn::IfThenElse(passes, previous, hit);
    }
    const VHI fail = hn::IfThenElse(in_front, hn::Set(di, static_cast<int32_t>(Verdict::correction)),
                                    hn::Set(di, static_cast<int32_t>(Verdict::behind)));
    const VHI how =
        hn::IfThenElse(hn::Eq(hit, hn::Set(di, -1)), fail, hn::Set(di, static_cast<int32_t>(Verdict::hit)));
    hn::StoreU(hit, di, accepted);
    hn::StoreU(how, di, verdict);
    for (size_t lane = 0; lane < std::min(lanes, from.count - i); ++lane) {
      results.verdict[from.ray[i + lane]] = static_cast<Verdict>(verdict[lane]);
      results.pixel[from.ray[i + lane]] = static_cast<uint32_t>(accepted[lane]);  // -1 is kNoPixel
    }
  }
}

uint64_t march_block(const MarchJob& job, size_t begin, size_t end, MarchMemory& memory,
                     MarchResults& results) {
  start(job, begin, end, memory);
  const bool slanted = job.view.intercept != nullptr;
  const uint64_t steps = job.step_budget
                             ? (slanted ? march<true, true>(job, memory) : march<true, false>(job, memory))
                         : slanted ? march<false, true>(job, memory)
                                   : march<false, false>(job, memory);
  for (size_t i = 0; i < memory.ended.count; ++i) {
    const uint32_t ray = memory.ended.ray[i];
    const int32_t how = memory.ended.how[i];
    results.verdict[ray] = how == kAtEnd       ? job.rays.end[ray]
                           : how == kOffscreen ? Verdict::offscreen
                                               : Verdict::budget;
    results.pixel[ray] = kNoPixel;
    if (job.keeps_l) results.proved[ray] = memory.ended.l[i];
  }
  const StoppedRays& stopped = memory.stopped;
  if (job.keeps_l)
    for (size_t i = 0; i < stopped.count; ++i) results.proved[stopped.ray[i]] = stopped.l[i];
  if (job.correct) {
    correct_stopped(job, memory, results);
  } else {
    for (size_t i = 0; i < stopped.count; ++i) {
      results.verdict[stopped.ray[i]] = Verdict::correction;
      results.pixel[stopped.ray[i]] = kNoPixel;
    }
  }
  return steps;
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::ssrm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray::ssrm {

HWY_EXPORT(march_block);

namespace {

void march_listed(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                  const uint32_t* which, size_t count, const MarchOptions& options, MarchResults& results) {
  HYBRAY_CHECK_EQ(rays.size(), pixels.size());
  HYBRAY_CHECK_EQ(rays.size(), results.size());
  // No ray takes as many samples as that.
  constexpr uint64_t kUnlimited = uint64_t{1} << 30;
  MarchJob job{view,
               rays,
               pixels,
               options.step_budget < kUnlimited ? static_cast<int32_t>(options.step_budget) : 0,
               which,
               options.correct,
               !results.proved.empty(),
               {}};
  HYBRAY_CHECK_LE(view.pyramid.levels(), kMostLevels);
  for (int level = 0; level < view.pyramid.levels(); ++level)
    job.first_texels[static_cast<size_t>(level)] = static_cast<int32_t>(view.pyramid.first_texel(level));
  std::atomic<uint64_t> steps{0};
  tbb::enumerable_thread_specific<std::unique_ptr<MarchMemory>> memories(std::make_unique<MarchMemory>);
  parallel_blocks(count, MarchWave::kSize, [&](size_t begin, size_t end) {
    steps += HWY_DYNAMIC_DISPATCH(march_block)(job, begin, end, *memories.local(), results);
  });
  results.steps = steps;
}

}  // namespace

void march_paper_lanes(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                       const MarchOptions& options, MarchResults& results) {
  march_listed(view, rays, pixels, nullptr, rays.size(), options, results);
}

void march_paper_lanes_some(const DepthView& view, const ScreenRays& rays,
                            const std::vector<uint32_t>& pixels, std::span<const uint32_t> which,
                            const MarchOptions& options, MarchResults& results) {
  march_listed(view, rays, pixels, which.data(), which.size(), options, results);
}

}  // namespace hybray::ssrm
#endif
