// The timed part of `ssrm_speed`.
#include "core/metrics/statistics.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/ssrm_speed_designs.h"
#include "harness/timing/interleaved.h"
#include "harness/timing/trace_mode_choice.h"

#include <cmath>
#include <map>
#include <numeric>

namespace hybray::ssrm_speed_parts {
namespace {

using ssrm::Verdict;
using Times = std::map<std::string, std::span<const double>>;

// Medians of the paired differences over one another; nothing where the denominator may be 0.
void put_efficiency(Row& row, const std::string& name, std::span<const double> all,
                    std::span<const double> predicted, std::span<const double> oracle, uint64_t seed) {
  std::vector<double> gain;
  for (size_t r = 0; r < all.size(); ++r) gain.push_back(all[r] - oracle[r]);
  const auto middle = [](std::span<const double> v) { return metrics::median(v); };
  const metrics::Interval bound = metrics::bootstrap(gain, middle, seed);
  if (bound.low <= 0.0 && bound.high >= 0.0) return;
  // Rounds are drawn together: their numbers are what is resampled.
  std::vector<double> rounds(all.size());
  std::iota(rounds.begin(), rounds.end(), 0.0);
  put_interval(row, name,
               metrics::bootstrap(
                   rounds,
                   [&](std::span<const double> drawn) {
                     std::vector<double> gained, possible;
                     for (const double at : drawn) {
                       const auto r = static_cast<size_t>(at);
                       gained.push_back(all[r] - predicted[r]), possible.push_back(all[r] - oracle[r]);
                     }
                     return metrics::median(gained) / metrics::median(possible);
                   },
                   seed));
}

// Runs in which at least the share `least` of the rays hit.
std::vector<uint8_t> worthwhile_runs(const std::vector<Verdict>& verdicts, double least) {
  std::vector<uint8_t> worth(ssrm::runs_of(verdicts.size()));
  for (size_t run = 0; run < worth.size(); ++run) {
    const size_t begin = ssrm::kRun * run, end = std::min(begin + ssrm::kRun, verdicts.size());
    size_t hits = 0;
    for (size_t i = begin; i < end; ++i) hits += verdicts[i] == Verdict::hit;
    worth[run] = static_cast<double>(hits) >= least * static_cast<double>(end - begin);
  }
  return worth;
}

// What the oracle takes beyond alpha T_SS + (1 - alpha) T_HW, in parts that add up to the whole round by
// round, each relative to that formula.
void put_gap(Row& row, Times& of, const std::string& end, double alpha, std::span<const double> formula,
             uint64_t seed) {
  const auto put = [&](const char* name, const std::function<double(size_t)>& part) {
    std::vector<double> parts;
    for (size_t r = 0; r < formula.size(); ++r) parts.push_back(part(r));
    put_ratio(row, name + end, parts, formula, seed);
  };
  const auto all = of["t_ss"], listed = of["t_ss_listed"], hits = of["t_ss_hits"], others = of["t_ss_others"],
             pyramid = of["pyramid"], oracle = of["t_oracle" + end];
  const auto hw = of["t_hw" + end], hw_listed = of["t_hw_listed" + end], hw_hits = of["t_hw_hits" + end],
             hw_others = of["t_hw_others" + end];
  const double beta = 1.0 - alpha;
  put("gap", [&](size_t r) { return oracle[r] - formula[r]; });
  put("gap_pyramid", [&](size_t r) { return pyramid[r]; });
  put("gap_march_listed", [&](size_t r) { return alpha * (listed[r] - all[r]); });
  put("gap_march_apart", [&](size_t r) { return alpha * (hits[r] + others[r] - listed[r]); });
  put("gap_march_dearer", [&](size_t r) { return beta * hits[r] - alpha * others[r]; });
  put("gap_trace_listed", [&](size_t r) { return beta * (hw_listed[r] - hw[r]); });
  put("gap_trace_apart", [&](size_t r) { return beta * (hw_hits[r] + hw_others[r] - hw_listed[r]); });
  put("gap_trace_dearer", [&](size_t r) { return alpha * hw_others[r] - beta * hw_hits[r]; });
  put("gap_rest", [&](size_t r) { return oracle[r] - pyramid[r] - hits[r] - hw_others[r]; });
}

}  // namespace

void add_times(Row& row, const Point& point, const SsrmFrame& frame, const Tracer& tracer, Designs& d,
               const std::array<Predictor, 2>& predictors, uint64_t seed) {
  const RayStream& rays = frame.rays();
  std::vector<uint32_t> all(rays.size()), resolved, unresolved;
  std::iota(all.begin(), all.end(), 0u);
  for (const uint32_t i : all)
    (d.buffers.results.verdict[i] == Verdict::hit ? resolved : unresolved).push_back(i);
  HitStream hits;
  hits.resize(rays.size());
  const TraceMode fast = fastest_trace_mode(tracer, rays, all, hits, seed);
  const TraceMode fast_unresolved = fastest_trace_mode(tracer, rays, unresolved, hits, seed);
  row["hw_mode"] = std::string(label(fast));
  row["hw_mode_unresolved"] = std::string(label(fast_unresolved));
  const bool certified = point.boolean("certified_misses");
  ssrm::MarchResults proving = d.buffers.results;
  proving.ask_proved();
  ssrm::MarchResults predicted = proving;
  const std::array worth{worthwhile_runs(proving.verdict, predictors[0].least),
                         worthwhile_runs(proving.verdict, predictors[1].least)};

  std::vector<Variant> variants{
      {"pyramid", [&] { d.build_pyramid(); }},
      {"t_ss_scalar", [&] { d.march(d.scalar, d.buffers.results); }},
      {"t_ss", [&] { d.march(d.lanes, d.buffers.results); }},
      {"t_ss_listed", [&] { d.march_list(all); }},
      {"t_ss_hits", [&] { d.march_list(resolved); }},
      {"t_ss_others", [&] { d.march_list(unresolved); }},
  };
  const bool segments = point.boolean("remaining_segment");
  if (segments) variants.push_back({"conservative", [&] { d.build_conservative(); }});
  for (const bool single : {false, true}) {
    const std::string end = single ? "_single" : "";
    const TraceMode whole = single ? TraceMode::single : fast,
                    mode = single ? TraceMode::single : fast_unresolved;
    const Predictor& by = predictors[single];
    const std::vector<uint8_t>& runs = worth[single];
    const auto add = [&](const char* stem, const std::function<void()>& run) {
      variants.push_back({stem + end, run});
    };
    add("t_hw", [&, whole] { tracer.trace(rays, hits, whole); });
    add("t_hw_listed", [&, whole] { d.trace_list(all, whole); });
    add("t_hw_hits", [&, mode] { d.trace_list(resolved, mode); });
    add("t_hw_others", [&, mode] { d.trace_list(unresolved, mode); });
    add("t_hybrid", [&, mode] { d.hybrid(mode); });
    add("t_predicted", [&, mode] { d.predicted(mode, by); });
    add("t_oracle", [&, mode] { d.oracle(mode, resolved, unresolved); });
    add("t_oracle_runs", [&, mode] { d.oracle_of_runs(mode, runs); });
    add("t_free", [&, mode] {
      d.compact(proving);
      d.trace(mode);
    });
    if (!segments) continue;
    add("t_centre", [&, mode] { d.centre(mode, proving); });
    add("t_predicted_centre", [&, mode] { d.predicted_centre(mode, by, predicted); });
    add("t_exact", [&, mode] { d.exact_hybrid(mode, certified, true); });
    add("t_exact_given", [&, mode] { d.exact_hybrid(mode, certified, false); });
  }
  const InterleavedTimes times = time_interleaved(variants, static_cast<int>(point.integer("repeats")), seed);
  Times of;
  for (size_t v = 0; v < variants.size(); ++v) {
    of[variants[v].name] = times.of(v);
    put_time(row, variants[v].name, times.of(v));
  }
  const double alpha = static_cast<double>(resolved.size()) / static_cast<double>(rays.size());
  put_ratio(row, "scalar_lanes_ratio", of["t_ss_scalar"], of["t_ss"], seed);
  for (const bool single : {false, true}) {
    const std::string end = single ? "_single" : "", versus = single ? "_vs_single" : "";
    const auto hw = of["t_hw" + end], oracle = of["t_oracle" + end], hybrid = of["t_hybrid" + end];
    const auto put_speedup = [&](const char* name, const char* design) {
      put_ratio(row, std::string("speedup_") + name + versus, hw, of[design + end], seed);
    };
    put_speedup("measured", "t_hybrid");
    put_speedup("predicted", "t_predicted");
    put_speedup("oracle", "t_oracle");
    put_speedup("oracle_runs", "t_oracle_runs");
    put_speedup("free", "t_free");
    if (segments) {
      put_speedup("centre", "t_centre");
      put_speedup("predicted_centre", "t_predicted_centre");
      put_speedup("exact", "t_exact");
    }
    put_efficiency(row, "predictor_efficiency" + end, hybrid, of["t_predicted" + end], oracle, seed);
    put_efficiency(row, "runs_efficiency" + end, hybrid, of["t_oracle_runs" + end], oracle, seed);
    std::vector<double> partitioned;
    for (size_t r = 0; r < hw.size(); ++r)
      partitioned.push_back(ssrm::estimate_hybrid(alpha, of["t_ss"][r], hw[r]).partitioned);
    row["t_partitioned" + end + "_ms"] = metrics::median(partitioned);
    put_ratio(row, "oracle_partitioned" + end + "_ratio", oracle, partitioned, seed);
    put_gap(row, of, end, alpha, partitioned, seed);
    if (resolved.empty() || unresolved.empty()) continue;
    const auto each = [&](const std::string& name, const std::vector<uint32_t>& list) {
      return metrics::median(of[name]) / static_cast<double>(list.size());
    };
    const double chance = ssrm::least_chance(each("t_hw_hits" + end, resolved), each("t_ss_hits", resolved),
                                             each("t_ss_others", unresolved));
    if (std::isfinite(chance)) row["break_even_chance" + end] = chance;
  }
  if (segments)
    put_ratio(row, "speedup_exact_given_vs_single", of["t_hw_single"], of["t_exact_given_single"], seed);
  row["repeats"] = point.integer("repeats");
}

}  // namespace hybray::ssrm_speed_parts
