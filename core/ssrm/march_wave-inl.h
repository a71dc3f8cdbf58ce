// The march in vector lanes, over Google Highway: what march_paper_ray and march_plane_ray do, sample by
// sample, for many rays at once. Per-target code: included inside HWY_BEFORE_NAMESPACE() again for every
// instruction set, so there is no #pragma once.
//
// Marchers differ in a Rule: a struct with
//   Ascent kAscent
//   VF depth_slack(VF oz): what is added to the depth of the origin
//   M behind(const Packet&, VI texel, VF leave, VF to_center_x, VF to_center_y): whether a ray may be behind
//   the
//     texel between p.l and `leave`; to_center: from the ray's origin to the centre of the cell, pixels.
#if defined(HYBRAY_MARCH_WAVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRAY_MARCH_WAVE_INL_H_
#undef HYBRAY_MARCH_WAVE_INL_H_
#else
#define HYBRAY_MARCH_WAVE_INL_H_
#endif

#include "core/ssrm/march_wave.h"

#include <algorithm>

#include <hwy/highway.h>

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
HWY_INLINE VF to_float(VI v) {
  return hn::ConvertTo(DF(), v);
}
HWY_INLINE VI add_where(MI where, VI a, VI b) {
  return hn::IfThenElse(where, hn::Add(a, b), a);
}

// The table's entries of the lanes' levels, without a gather where they fit into one or two vectors.
HWY_INLINE VI of_level(const LevelTable& table, VI level) {
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

// One screen axis of a vector of rays (Axis of cell_walk.h), in cells of each lane's level.
struct AxisLanes {
  VF origin, direction, inverse;
  VF forward;  // 1 forward, 0 backward
  VI step;     // 1 forward, -1 backward
  VI cell;

  HWY_INLINE AxisLanes(VF o, VF d, VF i, VI c)
      : origin(o),
        direction(d),
        inverse(i),
        forward(hn::IfThenElseZero(hn::Gt(i, hn::Zero(DF())), hn::Set(DF(), 1.0f))),
        step(hn::Or(hn::Set(DI(), 1), hn::ShiftRight<31>(hn::BitCast(DI(), i)))),
        cell(c) {}

  HWY_INLINE VF crossing(VF border) const { return hn::Mul(hn::Sub(border, origin), inverse); }

  // The half of its cell that the ray is in at `l`, as a cell of the level below.
  HWY_INLINE VI half(VF to_center, VF l) const {
    const M passed = hn::Le(hn::Mul(to_center, inverse), l);
    const MI upper = as_int(hn::Xor(passed, hn::Lt(inverse, hn::Zero(DF()))));
    return add_where(upper, hn::Add(cell, cell), hn::Set(DI(), 1));
  }
};

// One vector of rays under way.
struct Packet {
  AxisLanes x, y;
  VF oz, dz, l_end, l;
  VF side;  // of a cell, pixels
  VI level, samples, taken;
  M live, stopped, spent;

  HWY_INLINE Packet(const MarchWave& w, size_t at)
      : x(hn::Load(DF(), &w.ox[at]), hn::Load(DF(), &w.dx[at]), hn::Load(DF(), &w.ix[at]),
          hn::Load(DI(), &w.x[at])),
        y(hn::Load(DF(), &w.oy[at]), hn::Load(DF(), &w.dy[at]), hn::Load(DF(), &w.iy[at]),
          hn::Load(DI(), &w.y[at])),
        oz(hn::Load(DF(), &w.oz[at])),
        dz(hn::Load(DF(), &w.dz[at])),
        l_end(hn::Load(DF(), &w.l_end[at])),
        l(hn::Load(DF(), &w.l[at])),
        side(to_float(hn::Shl(hn::Set(DI(), 1), hn::Load(DI(), &w.level[at])))),
        level(hn::Load(DI(), &w.level[at])),
        samples(hn::Load(DI(), &w.samples[at])),
        taken(hn::Load(DI(), &w.taken[at])),
        live(hn::FirstN(DF(), at < w.count ? w.count - at : 0)),
        stopped(hn::FirstN(DF(), 0)),
        spent(stopped) {}
};

// One depth sample of each live lane. Returns how many there were.
template <bool kBudget, class Rule>
HWY_INLINE size_t step(Packet& p, const WaveJob& job, const Rule& rule) {
  const DF df;
  const DI di;
  const VI one = hn::Set(di, 1);
  const VF half = hn::Set(df, 0.5f);
  if constexpr (kBudget) {
    const M out_of_budget = hn::And(p.live, as_float(hn::Eq(p.taken, hn::Set(di, job.step_budget))));
    p.spent = hn::Or(p.spent, out_of_budget);
    p.live = hn::AndNot(out_of_budget, p.live);
    p.taken = add_where(as_int(p.live), p.taken, one);
  }
  const size_t count = hn::CountTrue(df, p.live);
  const VF cell_x = to_float(p.x.cell), cell_y = to_float(p.y.cell);
  const VF lx = p.x.crossing(hn::Mul(hn::Add(cell_x, p.x.forward), p.side));
  const VF ly = p.y.crossing(hn::Mul(hn::Add(cell_y, p.y.forward), p.side));
  const VF exit = hn::Min(lx, ly), leave = hn::Min(p.l_end, exit);
  const VF to_center_x = hn::Sub(hn::Mul(hn::Add(cell_x, half), p.side), p.x.origin);
  const VF to_center_y = hn::Sub(hn::Mul(hn::Add(cell_y, half), p.side), p.y.origin);
  const VI row = hn::Mul(p.y.cell, of_level(job.row, p.level));
  const VI texel = hn::Add(hn::Add(of_level(job.first_texel, p.level), p.x.cell), row);
  const M behind = rule.behind(p, hn::IfThenElseZero(as_int(p.live), texel), leave, to_center_x, to_center_y);

  const M ends = hn::Le(p.l_end, exit), ground = as_float(hn::Eq(p.level, hn::Zero(di)));
  const M intersects = hn::And(p.live, behind), clear = hn::AndNot(behind, p.live);
  const M advances = hn::AndNot(ends, clear), descends = hn::AndNot(ground, intersects);
  p.stopped = hn::Or(p.stopped, hn::And(intersects, ground));
  p.live = hn::Or(advances, descends);

  const VI half_x = p.x.half(to_center_x, p.l), half_y = p.y.half(to_center_y, p.l);
  const MI goes_x = as_int(hn::And(advances, hn::Le(lx, exit)));
  const MI goes_y = as_int(hn::And(advances, hn::Le(ly, exit)));
  const VI next_x = add_where(goes_x, p.x.cell, p.x.step), next_y = add_where(goes_y, p.y.cell, p.y.step);
  p.l = hn::IfThenElse(advances, exit, p.l);
  const MI down = as_int(descends);
  MI up = hn::Lt(p.level, hn::Set(di, job.levels - 1));
  if constexpr (Rule::kAscent == Ascent::parent) {
    // Some bit but the last has changed.
    const VI changed = hn::Or(hn::Xor(next_x, p.x.cell), hn::Xor(next_y, p.y.cell));
    up = hn::And(hn::Gt(changed, one), up);
  } else {
    const VI more = add_where(as_int(advances), p.samples, one);
    const MI full = hn::Eq(more, hn::Set(di, kSamplesPerIteration));
    p.samples = hn::IfThenZeroElse(hn::Or(full, down), more);
    up = hn::And(full, up);
  }
  p.x.cell = hn::IfThenElse(down, half_x, hn::IfThenElse(up, hn::ShiftRight<1>(next_x), next_x));
  p.y.cell = hn::IfThenElse(down, half_y, hn::IfThenElse(up, hn::ShiftRight<1>(next_y), next_y));
  const VF grown = hn::IfThenElse(as_float(up), hn::Add(p.side, p.side), p.side);
  p.side = hn::IfThenElse(descends, hn::Mul(p.side, half), grown);
  p.level = hn::IfThenElse(down, hn::Sub(p.level, one), add_where(up, p.level, one));
  return count;
}

// Packs the lanes under way to the front of the wave, from `out` on, and the others into the list of the
// ended; returns where the next packet's lanes go. A packet's lanes go nowhere beyond its own place.
HWY_INLINE size_t write_back(const Packet& p, size_t at, size_t out, M here, MarchWave& w) {
  const DF df;
  const DI di;
  const DU du;
  const VU ray = hn::Load(du, &w.ray[at]);
  const M ended = hn::AndNot(p.live, here);
  if (!hn::AllFalse(df, ended)) {
    MarchWave::Ended& to = w.ended;
    const VI how = hn::IfThenElse(as_int(p.stopped), hn::Set(di, kStopped),
                                  hn::IfThenElseZero(as_int(p.spent), hn::Set(di, kOutOfBudget)));
    const VF l = hn::IfThenElse(hn::Or(p.stopped, p.spent), p.l, p.l_end);
    const auto keep = [&](auto v, auto d, auto& field) HWY_ATTR {
      hn::StoreU(hn::Compress(v, hn::RebindMask(d, ended)), d, &field[to.count]);
    };
    keep(ray, du, to.ray), keep(how, di, to.how), keep(l, df, to.l);
    keep(p.x.cell, di, to.x), keep(p.y.cell, di, to.y);
    keep(p.samples, di, to.samples), keep(p.taken, di, to.taken);
    to.count += hn::CountTrue(df, ended);
  }
  const auto keep = [&](auto v, auto d, auto& field)
                        HWY_ATTR { hn::StoreU(hn::Compress(v, hn::RebindMask(d, p.live)), d, &field[out]); };
  keep(ray, du, w.ray), keep(p.l_end, df, w.l_end), keep(p.l, df, w.l);
  keep(p.x.origin, df, w.ox), keep(p.x.direction, df, w.dx), keep(p.x.inverse, df, w.ix);
  keep(p.y.origin, df, w.oy), keep(p.y.direction, df, w.dy), keep(p.y.inverse, df, w.iy);
  keep(p.oz, df, w.oz), keep(p.dz, df, w.dz);
  keep(p.x.cell, di, w.x), keep(p.y.cell, di, w.y);
  keep(p.level, di, w.level), keep(p.samples, di, w.samples), keep(p.taken, di, w.taken);
  return out + hn::CountTrue(df, p.live);
}

// Copies what the chosen rays of parts [begin, end) have in `from`, to.
HWY_INLINE void load(const WaveJob& job, size_t begin, size_t end, const MarchWave& w, size_t count,
                     const std::vector<float>& from, MarchWave::Lanes<float>& to) {
  switch (job.choice.of) {
    case RayChoice::Of::all:
      std::copy_n(from.data() + begin, count, to.data());
      return;
    case RayChoice::Of::listed:
      for (size_t i = 0; i < count; ++i) to[i] = from[w.ray[i]];
      return;
    case RayChoice::Of::runs:
    case RayChoice::Of::rest_of_runs:
      // A whole run is a copy of fixed length; the last ray takes the place of a sampled one.
      const size_t left_out = job.choice.of == RayChoice::Of::rest_of_runs;
      size_t at = 0;
      for (size_t k = begin; k < end; ++k) {
        const size_t first = kRun * job.choice.which[k];
        if (first + kRun <= from.size()) {
          std::copy_n(from.data() + first, kRun, to.data() + at);
          if (left_out) to[at + kSampleOfRun] = to[at + kRun - 1];
          at += kRun - left_out;
        } else {
          const size_t last = at + from.size() - first - left_out;
          for (; at < last; ++at) to[at] = from[w.ray[at]];
        }
      }
  }
}

// The numbers of the rays of parts [begin, end), in the order of load(). Returns how many they are.
HWY_INLINE size_t number(const WaveJob& job, size_t begin, size_t end, MarchWave& w) {
  switch (job.choice.of) {
    case RayChoice::Of::all:
      for (size_t i = begin; i < end; ++i) w.ray[i - begin] = static_cast<uint32_t>(i);
      return end - begin;
    case RayChoice::Of::listed:
      std::copy_n(job.choice.which.data() + begin, end - begin, w.ray.data());
      return end - begin;
    case RayChoice::Of::runs:
    case RayChoice::Of::rest_of_runs:
      break;
  }
  const size_t rays = job.rays.size(), left_out = job.choice.of == RayChoice::Of::rest_of_runs;
  size_t count = 0;
  for (size_t k = begin; k < end; ++k) {
    const size_t run = job.choice.which[k], first = kRun * run, here = std::min(kRun, rays - first);
    for (size_t i = 0; i < here; ++i) w.ray[count + i] = static_cast<uint32_t>(first + i);
    if (left_out) w.ray[count + sampled_ray(run, rays) - first] = static_cast<uint32_t>(first + here - 1);
    count += here - left_out;
  }
  return count;
}

// The rays of parts [begin, end) of the job, each at its own pixel.
HWY_INLINE void fill(const WaveJob& job, size_t begin, size_t end, MarchWave& w) {
  const size_t count = number(job, begin, end, w);
  const auto copy = [&](const std::vector<float>& from, MarchWave::Lanes<float>& to) {
    load(job, begin, end, w, count, from, to);
  };
  copy(job.rays.ox, w.ox), copy(job.rays.oy, w.oy), copy(job.rays.oz, w.oz);
  copy(job.rays.dx, w.dx), copy(job.rays.dy, w.dy), copy(job.rays.dz, w.dz);
  copy(job.rays.l_end, w.l_end);
  const double inverse_width = 1.0 / job.width;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t pixel = job.pixels[w.ray[i]];
    // Exact: a half is further from the next whole row than rounding reaches.
    const auto row = static_cast<int32_t>((static_cast<double>(pixel) + 0.5) * inverse_width);
    w.y[i] = row;
    w.x[i] = static_cast<int32_t>(pixel) - row * job.width;
    w.level[i] = w.samples[i] = w.taken[i] = 0;
    w.l[i] = 0.0f;
  }
  w.count = count;
  w.ended.count = 0;
}

// The paper's first stage: every ray up to the exit of its own pixel.
template <class Rule>
HWY_INLINE void start(const WaveJob& job, const Rule& rule, MarchWave& w) {
  const DF df;
  const VF one = hn::Set(df, 1.0f);
  size_t out = 0;
  for (size_t at = 0; at < w.count; at += hn::Lanes(df)) {
    hn::Store(hn::Div(one, hn::Load(df, &w.dx[at])), df, &w.ix[at]);
    hn::Store(hn::Div(one, hn::Load(df, &w.dy[at])), df, &w.iy[at]);
    Packet p(w, at);
    const M here = p.live;
    p.oz = hn::Add(p.oz, rule.depth_slack(p.oz));
    // The screen's edge ends a ray as well: no step need ask for it.
    const auto edge = [&](const AxisLanes& axis, int32_t pixels) HWY_ATTR {
      return axis.crossing(hn::Mul(axis.forward, hn::Set(df, static_cast<float>(pixels))));
    };
    p.l_end = hn::Min(p.l_end, hn::Min(edge(p.x, job.width), edge(p.y, job.height)));
    const VF lx = p.x.crossing(hn::Add(to_float(p.x.cell), p.x.forward));
    const VF ly = p.y.crossing(hn::Add(to_float(p.y.cell), p.y.forward));
    p.l = hn::Min(lx, ly);
    p.live = hn::AndNot(hn::Le(p.l_end, p.l), here);
    // Nor could one that is beyond the screen (CellWalk::beyond_screen) be kept in its cells.
    const auto beyond = [&](const AxisLanes& axis, int32_t pixels) HWY_ATTR {
      const VF far_edge = axis.crossing(hn::Set(df, static_cast<float>(pixels)));
      return hn::And(hn::Lt(axis.inverse, hn::Zero(df)), hn::Gt(far_edge, p.l));
    };
    const M outside = hn::And(p.live, hn::Or(beyond(p.x, job.width), beyond(p.y, job.height)));
    p.l_end = hn::IfThenZeroElse(outside, p.l_end);
    p.live = hn::AndNot(outside, p.live);
    p.x.cell = add_where(as_int(hn::Le(lx, p.l)), p.x.cell, p.x.step);
    p.y.cell = add_where(as_int(hn::Le(ly, p.l)), p.y.cell, p.y.step);
    out = write_back(p, at, out, here, w);
  }
  w.count = out;
}

// The paper's second stage, until no ray is under way. Returns the samples read.
template <bool kBudget, class Rule>
HWY_INLINE uint64_t march_on(const WaveJob& job, const Rule& rule, MarchWave& w) {
  const size_t lanes = hn::Lanes(DF());
  uint64_t steps = 0;
  while (w.count > 0) {
    size_t out = 0;
    for (size_t at = 0; at < w.count; at += 3 * lanes) {
      // Three at a time: some compute while others wait.
      Packet a(w, at), b(w, at + lanes), c(w, at + 2 * lanes);
      const M here_a = a.live, here_b = b.live, here_c = c.live;
      size_t under_way = std::min(3 * lanes, w.count - at);
      const size_t few = 3 * under_way / 4;
      while (under_way > few) {
        under_way = step<kBudget>(a, job, rule) + step<kBudget>(b, job, rule) + step<kBudget>(c, job, rule);
        steps += under_way;
      }
      out = write_back(a, at, out, here_a, w);
      out = write_back(b, at + lanes, out, here_b, w);
      out = write_back(c, at + 2 * lanes, out, here_c, w);
    }
    w.count = out;
  }
  return steps;
}

// The rays of parts [begin, end) of the job: afterwards all are in w.ended.
template <class Rule>
HWY_INLINE uint64_t march_wave(const WaveJob& job, const Rule& rule, size_t begin, size_t end, MarchWave& w) {
  fill(job, begin, end, w);
  start(job, rule, w);
  return job.step_budget ? march_on<true>(job, rule, w) : march_on<false>(job, rule, w);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybray::ssrm
HWY_AFTER_NAMESPACE();

#endif
