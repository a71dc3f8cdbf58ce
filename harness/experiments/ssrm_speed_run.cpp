// One point of `ssrm_speed`: the designs, what each sends where, and their times in one interleaved run.
#include "core/metrics/statistics.h"
#include "core/ssrm/hybrid.h"
#include "core/ssrm/predictor.h"
#include "core/ssrm/remaining_segment.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/ssrm_speed.h"
#include "harness/timing/interleaved.h"
#include "harness/timing/trace_mode_choice.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace hybray::ssrm_speed_parts {
namespace {

using ssrm::MarchCode;
using ssrm::Verdict;

ssrm::MarchOptions in_lanes(const Point& point) {
  return {.code = MarchCode::lanes,
          .marcher = point.text("marcher") == "plane" ? ssrm::Marcher::plane : ssrm::Marcher::paper};
}

// What the marcher needs beside the frame.
void prepare(SsrmFrame& frame, const ssrm::MarchOptions& march) {
  if (march.marcher == ssrm::Marcher::plane) frame.add_slanted(SlantedPyramid::Bounds::slanted);
}

uint64_t hits_of(const ssrm::MarchResults& results) {
  return static_cast<uint64_t>(std::count(results.verdict.begin(), results.verdict.end(), Verdict::hit));
}

// A frame, and every design of the hybrid on it. The one place that names the marcher.
class Designs {
 public:
  ssrm::MarchOptions lanes, scalar;

  Designs(const SsrmSetup& setup, SsrmFrame& frame, const Tracer& tracer, const ssrm::TileHistory& history,
          const ssrm::MarchOptions& march)
      : lanes(march),
        scalar(march),
        setup_(setup),
        frame_(frame),
        tracer_(tracer),
        history_(history),
        buffers(frame.rays().size()),
        exact(frame.view(), frame.rays().size()) {
    scalar.code = MarchCode::scalar;
    t_near.resize(frame.rays().size());
  }

  void build_pyramid() {
    // Marcher `plane` reads the first level alone of the flat pyramid.
    frame_.pyramid.build(frame_.gbuffer.depth, setup_.view.depth_sign(), setup_.view.background_depth(),
                         frame_.slanted ? 1 : DepthPyramid::kAllLevels);
    prepare(frame_, lanes);
  }
  void march(const ssrm::MarchOptions& options, ssrm::MarchResults& results) {
    ssrm::march(frame_.depth(), frame_.screen_rays, frame_.rays().pixel, options, results);
  }
  void trace(TraceMode mode, std::span<const float> from = {}) {
    tracer_.trace_some(frame_.rays(), buffers.unresolved, buffers.hits, mode, from);
  }
  void compact(const ssrm::MarchResults& results) { ssrm::compact_unresolved(results, buffers.unresolved); }

  void hybrid(TraceMode mode) {
    build_pyramid();
    march(lanes, buffers.results);
    compact(buffers.results);
    trace(mode);
  }
  void predict(const ssrm::PredictorOptions& options) {
    ssrm::march_predicted(frame_.depth(), frame_.screen_rays, frame_.rays().pixel, lanes, options, history_,
                          buffers.results, prediction);
  }
  void predicted(TraceMode mode, const ssrm::PredictorOptions& options) {
    build_pyramid();
    predict(options);
    compact(buffers.results);
    trace(mode);
  }
  // The lists are known beforehand: nothing is compacted.
  void oracle(TraceMode mode, std::span<const uint32_t> resolved, std::span<const uint32_t> unresolved) {
    build_pyramid();
    ssrm::march_some(frame_.depth(), frame_.screen_rays, frame_.rays().pixel, resolved, lanes,
                     buffers.results);
    tracer_.trace_some(frame_.rays(), unresolved, buffers.hits, mode);
  }
  void centre(TraceMode mode, ssrm::MarchResults& results) {
    build_pyramid();
    march(lanes, results);
    compact(results);
    ssrm::centre_segments(frame_.rays(), setup_.view, setup_.scene.bounds, results.proved, buffers.unresolved,
                          t_near);
    trace(mode, t_near);
  }
  void build_conservative() { ssrm::build_conservative(frame_.gbuffer, setup_.scene, exact); }
  void exact_segments() {
    ssrm::exact_segments(frame_.gbuffer, setup_.scene, frame_.rays(), frame_.screen_rays, buffers.unresolved,
                         MarchCode::lanes, exact);
  }
  void exact_hybrid(TraceMode mode, bool certified, bool build) {
    build_pyramid();
    if (build) build_conservative();
    march(lanes, buffers.results);
    compact(buffers.results);
    exact_segments();
    if (certified) std::erase_if(buffers.unresolved, [&](uint32_t i) { return exact.misses[i] != 0; });
    trace(mode, exact.t_near);
  }

 private:
  const SsrmSetup& setup_;
  SsrmFrame& frame_;
  const Tracer& tracer_;
  const ssrm::TileHistory& history_;

 public:
  ssrm::HybridBuffers buffers;
  ssrm::ExactSegments exact;
  ssrm::Prediction prediction;
  std::vector<float> t_near;
};

// What a start distance changes: traced with the robust tracer, like the truth.
struct SegmentPrice {
  uint64_t changed = 0, hits = 0;
  double proved = 0.0;  // sum of start / true distance
};
SegmentPrice price_of(const Tracer& robust, const RayStream& rays, std::span<const uint32_t> which,
                      const std::vector<float>& t_near, const HitStream& truth) {
  HitStream hits;
  hits.resize(rays.size());
  robust.trace_some(rays, which, hits, TraceMode::single, t_near);
  SegmentPrice price;
  for (const uint32_t i : which) {
    price.changed += hits.t[i] != truth.t[i];
    // A hit at the very origin leaves no way to be proved.
    if (truth.primitive[i] == kNoPrimitive || !(truth.t[i] > 0.0f)) continue;
    ++price.hits;
    price.proved += std::min(1.0, static_cast<double>(t_near[i]) / static_cast<double>(truth.t[i]));
  }
  return price;
}

void add_segments(Row& row, const SsrmSetup& setup, const SsrmFrame& frame, Designs& d) {
  const RayStream& rays = frame.rays();
  ssrm::MarchResults results = d.buffers.results;
  results.ask_proved();
  d.march(d.lanes, results);
  const std::vector<uint32_t>& unresolved = d.buffers.unresolved;
  ssrm::centre_segments(rays, setup.view, setup.scene.bounds, results.proved, unresolved, d.t_near);
  d.build_conservative();
  d.exact_segments();
  HitStream truth;
  truth.resize(rays.size());
  setup.robust.trace_some(rays, unresolved, truth, TraceMode::single);
  const SegmentPrice centre = price_of(setup.robust, rays, unresolved, d.t_near, truth);
  const SegmentPrice exact = price_of(setup.robust, rays, unresolved, d.exact.t_near, truth);
  row["segment_changed_fraction"] = share(centre.changed, unresolved.size());
  row["segment_exact_changed_fraction"] = share(exact.changed, unresolved.size());
  if (centre.hits > 0) {
    row["segment_centre_proved_fraction"] = centre.proved / static_cast<double>(centre.hits);
    row["segment_exact_proved_fraction"] = exact.proved / static_cast<double>(exact.hits);
  }
  uint64_t certified = 0, wrong = 0;
  for (const uint32_t i : unresolved) {
    if (!d.exact.misses[i]) continue;
    ++certified;
    wrong += truth.primitive[i] != kNoPrimitive;
  }
  row["certified_miss_fraction"] = share(certified, rays.size());
  row["certified_false_fraction"] = share(wrong, certified);
  row["conservative_pixels"] = static_cast<int64_t>(d.exact.depth.pixels_touched);
  row["segment_exact_steps_per_ray"] = share(d.exact.results.steps, rays.size());
}

ssrm::PredictorOptions predictor_options(const Point& point, const char* cost) {
  return {.march_cost = point.number(cost), .by_direction = point.text("predictor") != "sample"};
}

// HIT shares of the frame before, taken `path_step` to the left of this one.
ssrm::TileHistory history_of(const Point& point, const SsrmSetup& setup) {
  if (point.text("predictor") != "history") return {};
  SsrmSetup before = setup;
  Camera camera = find_camera(setup.scene, point.text("camera"));
  const vec3 step(setup.view.right() * -point.number("path_step"));
  camera.eye += step, camera.target += step;
  before.view = View(camera,
                     {.width = setup.view.width(),
                      .height = setup.view.height(),
                      .near = setup.view.near(),
                      .far = setup.view.far(),
                      .convention = setup.view.convention()},
                     setup.scene.bounds);
  SsrmFrame frame(before);
  prepare(frame, in_lanes(point));
  ssrm::MarchResults results;
  results.resize(frame.rays().size());
  ssrm::march(frame.depth(), frame.screen_rays, frame.rays().pixel, in_lanes(point), results);
  return ssrm::tile_history(results, frame.rays().pixel, setup.view.width(), setup.view.height());
}

void add_predictions(Row& row, const Point& point, Designs& d, size_t rays) {
  for (const auto& [cost, alpha, fraction] :
       {std::tuple("march_cost", "alpha_predicted", "predicted_fraction"),
        {"march_cost_single", "alpha_predicted_single", "predicted_single_fraction"}}) {
    d.predict(predictor_options(point, cost));
    row[alpha] = share(hits_of(d.buffers.results), rays);
    row[fraction] = share(rays - d.prediction.marched(), rays);
  }
}

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

void add_times(Row& row, const Point& point, SsrmFrame& frame, const Tracer& tracer, Designs& d,
               uint64_t seed) {
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

  std::vector<Variant> variants{
      {"pyramid", [&] { d.build_pyramid(); }},
      {"conservative", [&] { d.build_conservative(); }},
      {"t_ss_scalar", [&] { d.march(d.scalar, d.buffers.results); }},
      {"t_ss", [&] { d.march(d.lanes, d.buffers.results); }},
      {"t_hw", [&] { tracer.trace(rays, hits, fast); }},
      {"t_hw_single", [&] { tracer.trace(rays, hits, TraceMode::single); }},
  };
  for (const bool single : {false, true}) {
    const std::string end = single ? "_single" : "";
    const TraceMode mode = single ? TraceMode::single : fast_unresolved;
    const ssrm::PredictorOptions options =
        predictor_options(point, single ? "march_cost_single" : "march_cost");
    variants.push_back({"t_hybrid" + end, [&, mode] { d.hybrid(mode); }});
    variants.push_back({"t_predicted" + end, [&, mode, options] { d.predicted(mode, options); }});
    variants.push_back({"t_oracle" + end, [&, mode] { d.oracle(mode, resolved, unresolved); }});
    variants.push_back({"t_free" + end, [&, mode] {
                          d.compact(proving);
                          d.trace(mode);
                        }});
    variants.push_back({"t_centre" + end, [&, mode] { d.centre(mode, proving); }});
    variants.push_back({"t_exact" + end, [&, mode] { d.exact_hybrid(mode, certified, true); }});
    variants.push_back({"t_exact_given" + end, [&, mode] { d.exact_hybrid(mode, certified, false); }});
  }
  const InterleavedTimes times = time_interleaved(variants, static_cast<int>(point.integer("repeats")), seed);
  std::map<std::string, std::span<const double>> of;
  for (size_t v = 0; v < variants.size(); ++v) {
    of[variants[v].name] = times.of(v);
    put_time(row, variants[v].name, times.of(v));
  }
  const double alpha = static_cast<double>(resolved.size()) / static_cast<double>(rays.size());
  put_ratio(row, "scalar_lanes_ratio", of["t_ss_scalar"], of["t_ss"], seed);
  for (const bool single : {false, true}) {
    const std::string end = single ? "_single" : "", versus = single ? "_vs_single" : "";
    const auto hw = of["t_hw" + end], oracle = of["t_oracle" + end];
    for (const auto& [name, design] : {std::pair("measured", "t_hybrid"),
                                       {"predicted", "t_predicted"},
                                       {"oracle", "t_oracle"},
                                       {"free", "t_free"},
                                       {"centre", "t_centre"},
                                       {"exact", "t_exact"}})
      put_ratio(row, std::string("speedup_") + name + versus, hw, of[design + end], seed);
    put_efficiency(row, "predictor_efficiency" + end, of["t_hybrid" + end], of["t_predicted" + end], oracle,
                   seed);
    std::vector<double> partitioned;
    for (size_t r = 0; r < hw.size(); ++r)
      partitioned.push_back(ssrm::estimate_hybrid(alpha, of["t_ss"][r], hw[r]).partitioned);
    row["t_partitioned" + end + "_ms"] = metrics::median(partitioned);
    put_ratio(row, "oracle_partitioned" + end + "_ratio", oracle, partitioned, seed);
  }
  put_ratio(row, "speedup_exact_given_vs_single", of["t_hw_single"], of["t_exact_given_single"], seed);
  row["repeats"] = point.integer("repeats");
}

}  // namespace

Row run(const Point& point, Workspace& workspace) {
  const SsrmSetup setup(point, workspace);
  SsrmFrame frame(setup);
  prepare(frame, in_lanes(point));
  const RayStream& rays = frame.rays();
  Row row;
  add_view_cells(row, point, setup, frame);
  for (const char* name : {"marcher", "predictor"}) row[name] = point.text(name);
  for (const char* name : {"march_cost", "march_cost_single"}) row[name] = point.number(name);
  row["path_step_m"] = point.number("path_step");
  row["certified_misses"] = point.boolean("certified_misses");

  const ssrm::TileHistory history = history_of(point, setup);
  Designs designs(setup, frame, workspace.tracer(point.text("scene")), history, in_lanes(point));
  add_predictions(row, point, designs, rays.size());
  designs.march(designs.lanes, designs.buffers.results);
  designs.compact(designs.buffers.results);
  row["alpha"] = share(hits_of(designs.buffers.results), rays.size());
  row["steps_per_ray"] = share(designs.buffers.results.steps, rays.size());
  add_segments(row, setup, frame, designs);
  if (workspace.settings().timing && rays.size() > 0)
    add_times(row, point, frame, workspace.tracer(point.text("scene")), designs, workspace.settings().seed);
  return row;
}

}  // namespace hybray::ssrm_speed_parts
