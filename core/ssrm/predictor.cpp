#include "core/ssrm/predictor.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace hybray::ssrm {
namespace {

// What a march has found counts that much more than what was believed where none was made: HITs that an
// explored run finds then reach its neighbours. Tuned on a path of 9 frames, 5 cm each, in Sponza: with 1 the
// time saved falls from frame to frame, from 8 on it does not.
constexpr uint32_t kFreshWeight = 16;

// Row and column of a pixel, without a division of integers.
class PixelPlace {
 public:
  explicit PixelPlace(int width) : width_(width), inverse_(1.0 / width) {}
  ivec2 operator()(uint32_t pixel) const {
    // Exact: a half is further from the next whole row than rounding reaches.
    const int row = static_cast<int>((static_cast<double>(pixel) + 0.5) * inverse_);
    return {static_cast<int>(pixel) - row * width_, row};
  }

 private:
  int width_;
  double inverse_;
};

struct RayRange {
  size_t begin, end;
};
RayRange rays_of(size_t run, size_t rays) {
  return {kRun * run, std::min(kRun * (run + 1), rays)};
}

void leave(size_t begin, size_t end, MarchResults& results) {
  const auto fill = [&](auto& list, auto value) {
    std::fill(list.begin() + static_cast<ptrdiff_t>(begin), list.begin() + static_cast<ptrdiff_t>(end),
              value);
  };
  fill(results.verdict, Verdict::budget);
  fill(results.pixel, kNoPixel);
  if (!results.proved.empty()) fill(results.proved, 0.0f);
}

// Lists the runs that worth(run) keeps, in order at any number of threads, and leaves the rays of the others,
// but for sampled ones.
template <class Worth>
void choose_runs(size_t rays, bool sampled, const Worth& worth, MarchResults& results, Prediction& p) {
  constexpr size_t kPart = 1024;
  const size_t runs = runs_of(rays);
  std::vector<size_t> first((runs + kPart - 1) / kPart + 1, 0);
  std::atomic<size_t> marched{0};
  p.scratch.resize(runs);
  parallel_blocks(runs, kPart, [&](size_t begin, size_t end) {
    size_t count = 0, mine = 0;
    for (size_t run = begin; run < end; ++run) {
      const RayRange range = rays_of(run, rays);
      if (worth(run)) {
        p.scratch[begin + count++] = static_cast<uint32_t>(run);
        mine += range.end - range.begin;
      } else if (sampled) {
        leave(range.begin, sampled_ray(run, rays), results);
        leave(sampled_ray(run, rays) + 1, range.end, results);
        ++mine;
      } else {
        leave(range.begin, range.end, results);
      }
    }
    first[begin / kPart + 1] = count;
    marched += mine;
  });
  for (size_t b = 1; b < first.size(); ++b) first[b] += first[b - 1];
  p.runs.resize(first.back());
  parallel_blocks(runs, kPart, [&](size_t begin, size_t) {
    const size_t b = begin / kPart;
    std::copy_n(p.scratch.data() + begin, first[b + 1] - first[b], p.runs.data() + first[b]);
  });
  p.marched = marched;
}

void march_chosen_runs(const MarchInput& in, RayChoice::Of of, MarchResults& results, const Prediction& p) {
  march_chosen(in.depth, in.rays, in.pixels, {of, p.runs}, in.options, results);
}

// Chance of each run by the frames before.
void look_up(const MarchInput& in, const View& view, const ChanceHistory& history, Prediction& p) {
  p.chance.resize(runs_of(in.rays.size()));
  p.start.resize(p.chance.size());
  const Reprojection before(view, history.view.value_or(view));
  const PixelPlace place(view.width());
  const auto sign = static_cast<float>(in.depth.depth_sign);
  parallel_blocks(p.chance.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t run = begin; run < end; ++run) {
      const ivec2 at = p.start[run] = place(in.pixels[sampled_ray(run, in.rays.size())]);
      const vec2 was = before(static_cast<float>(at.x) + 0.5f, static_cast<float>(at.y) + 0.5f,
                              sign * in.depth.pyramid.at(0, at.x, at.y));
      p.chance[run] = history.chances.around(was.x, was.y);
    }
  });
}

// HITs in parts of BlockChances::kWhole.
uint32_t hit_part(const Verdict* verdicts, size_t rays) {
  uint32_t hits = 0;
  if (rays == kRun)
    for (size_t i = 0; i < kRun; ++i) hits += verdicts[i] == Verdict::hit;
  else
    for (size_t i = 0; i < rays; ++i) hits += verdicts[i] == Verdict::hit;
  return BlockChances::kWhole * hits / static_cast<uint32_t>(rays);
}

void remember(const MarchInput& in, const View& view, const MarchResults& results, const Prediction& p,
              ChanceHistory& history) {
  const size_t rays = in.rays.size();
  history.view = view;
  ++history.frames;
  history.chances.reset(view.width(), view.height());
  parallel_blocks(p.chance.size(), 1024, [&](size_t begin, size_t end) {
    auto marched = std::lower_bound(p.runs.begin(), p.runs.end(), begin);
    for (size_t run = begin; run < end; ++run) {
      const ivec2 at = p.start[run];
      if (marched != p.runs.end() && *marched == run) {
        ++marched;
        const RayRange range = rays_of(run, rays);
        const uint32_t part = hit_part(results.verdict.data() + range.begin, range.end - range.begin);
        history.chances.add(at.x, at.y, part, kFreshWeight);
      } else {
        const float part = p.chance[run] * static_cast<float>(BlockChances::kWhole) + 0.5f;
        history.chances.add(at.x, at.y, static_cast<uint32_t>(part), 1);
      }
    }
  });
  history.chances.spread();
}

void leave_all(MarchResults& results, Prediction& p) {
  leave(0, results.size(), results);
  results.steps = 0;
  p.runs.clear(), p.sample.clear();
  p.marched = 0;
}

}  // namespace

double least_chance(double trace_of_hit, double march_of_hit, double march_of_other) {
  if (!(trace_of_hit > march_of_hit)) return std::numeric_limits<double>::infinity();
  return march_of_other / (trace_of_hit - march_of_hit + march_of_other);
}

void march_runs(const MarchInput& in, const std::vector<uint8_t>& worth, MarchResults& results,
                Prediction& p) {
  HYBRAY_CHECK_EQ(worth.size(), runs_of(in.rays.size()));
  p.sample.clear();
  choose_runs(
      in.rays.size(), false, [&](size_t run) { return worth[run] != 0; }, results, p);
  march_chosen_runs(in, RayChoice::Of::runs, results, p);
}

void march_by_sample(const MarchInput& in, double least, MarchResults& results, Prediction& p) {
  if (least > 1.0) return leave_all(results, p);
  const size_t rays = in.rays.size();
  p.sample.resize(runs_of(rays));
  for (size_t run = 0; run < p.sample.size(); ++run)
    p.sample[run] = static_cast<uint32_t>(sampled_ray(run, rays));
  march_some(in.depth, in.rays, in.pixels, p.sample, in.options, results);
  const uint64_t sample_steps = results.steps;
  const PixelPlace place(in.depth.width());
  p.start.resize(p.sample.size());
  p.found.reset(in.depth.width(), in.depth.height());
  parallel_blocks(p.sample.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t run = begin; run < end; ++run) {
      const ivec2 at = p.start[run] = place(in.pixels[p.sample[run]]);
      const bool hit = results.verdict[p.sample[run]] == Verdict::hit;
      p.found.add(at.x, at.y, hit ? BlockChances::kWhole : 0, 1);
    }
  });
  p.found.spread();
  const auto worth = [&](size_t run) {
    const vec2 at(p.start[run]);
    return static_cast<double>(p.found.around(at.x, at.y)) >= least;
  };
  choose_runs(rays, true, worth, results, p);
  march_chosen_runs(in, RayChoice::Of::rest_of_runs, results, p);
  results.steps += sample_steps;
}

void march_by_history(const MarchInput& in, const View& view, double least, ChanceHistory& history,
                      MarchResults& results, Prediction& p) {
  if (least > 1.0) return leave_all(results, p);
  p.sample.clear();
  look_up(in, view, history, p);
  const auto worth = [&](size_t run) {
    const float chance = p.chance[run];
    return chance < 0.0f || static_cast<double>(chance) >= least || (run + history.frames) % kExplore == 0;
  };
  choose_runs(in.rays.size(), false, worth, results, p);
  march_chosen_runs(in, RayChoice::Of::runs, results, p);
  remember(in, view, results, p, history);
}

}  // namespace hybray::ssrm
