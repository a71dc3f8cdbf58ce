// One point of `ssrm_speed`: the designs, what each sends where, and their times in one interleaved run.
#include "harness/experiments/cells.h"
#include "harness/experiments/ssrm_speed.h"
#include "harness/experiments/ssrm_speed_designs.h"

#include <algorithm>

namespace hybray::ssrm_speed_parts {
namespace {

using ssrm::Verdict;

uint64_t hits_of(const ssrm::MarchResults& results) {
  return static_cast<uint64_t>(std::count(results.verdict.begin(), results.verdict.end(), Verdict::hit));
}

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

// Rays whose answer from `t_near` differs from that from their origin, in the mode where most do.
uint64_t most_changed(const Tracer& tracer, const RayStream& rays, std::span<const uint32_t> which,
                      const std::vector<float>& t_near) {
  HitStream from_origin, from_there;
  from_origin.resize(rays.size()), from_there.resize(rays.size());
  uint64_t most = 0;
  for (const TraceMode mode : kAllTraceModes) {
    tracer.trace_some(rays, which, from_origin, mode);
    tracer.trace_some(rays, which, from_there, mode, t_near);
    most = std::max(most, static_cast<uint64_t>(std::ranges::count_if(which, [&](uint32_t i) {
                      return ssrm::answers_differ(from_origin.t[i], from_there.t[i]);
                    })));
  }
  return most;
}

void add_segments(Row& row, const SsrmSetup& setup, const SsrmFrame& frame, const Tracer& timed, Designs& d) {
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
  row["segment_exact_changed_timed_fraction"] =
      share(most_changed(timed, rays, unresolved, d.exact.t_near), unresolved.size());
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

// How each of the two is predicted; a history is of the frames on the way here, each of which marched what
// its own history told it to.
std::array<Predictor, 2> predictors_of(const Point& point, const SsrmSetup& setup) {
  std::array<Predictor, 2> predictors{Predictor{point.number("least_chance")},
                                      {point.number("least_chance_single")}};
  if (point.text("predictor") != "history") return predictors;
  for (Predictor& p : predictors) p.history.emplace();
  ssrm::MarchResults results;
  ssrm::Prediction prediction;
  for (int64_t before = point.integer("path_frames"); before > 0; --before) {
    SsrmSetup then = setup;
    Camera camera = find_camera(setup.scene, point.text("camera"));
    const vec3 step(setup.view.right() * (-point.number("path_step") * static_cast<double>(before)));
    camera.eye += step, camera.target += step;
    then.view = View(camera,
                     {.width = setup.view.width(),
                      .height = setup.view.height(),
                      .near = setup.view.near(),
                      .far = setup.view.far(),
                      .convention = setup.view.convention()},
                     setup.scene.bounds);
    SsrmFrame frame(then);
    prepare(frame, in_lanes(point));
    results.resize(frame.rays().size());
    const ssrm::DepthView depth = frame.depth();
    for (Predictor& p : predictors)
      ssrm::march_by_history({depth, frame.screen_rays, frame.rays().pixel, in_lanes(point)}, frame.view(),
                             p.least, *p.history, results, prediction);
  }
  return predictors;
}

void add_predictions(Row& row, const std::array<Predictor, 2>& predictors, Designs& d, size_t rays) {
  for (const bool single : {false, true}) {
    const std::string end = single ? "_single" : "";
    d.predict(predictors[single], d.buffers.results);
    row["alpha_predicted" + end] = share(hits_of(d.buffers.results), rays);
    row["predicted" + end + "_fraction"] = share(rays - d.prediction.marched, rays);
  }
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
  for (const char* name : {"least_chance", "least_chance_single"}) row[name] = point.number(name);
  row["path_step_m"] = point.number("path_step");
  row["path_frames"] = point.integer("path_frames");
  for (const char* name : {"remaining_segment", "certified_misses"}) row[name] = point.boolean(name);

  const std::array<Predictor, 2> predictors = predictors_of(point, setup);
  const Tracer& tracer = workspace.tracer(point.text("scene"));
  Designs designs(setup, frame, tracer, in_lanes(point));
  add_predictions(row, predictors, designs, rays.size());
  designs.march(designs.lanes, designs.buffers.results);
  designs.compact(designs.buffers.results);
  row["alpha"] = share(hits_of(designs.buffers.results), rays.size());
  row["steps_per_ray"] = share(designs.buffers.results.steps, rays.size());
  if (point.boolean("remaining_segment")) add_segments(row, setup, frame, tracer, designs);
  if (workspace.settings().timing && rays.size() > 0)
    add_times(row, point, frame, tracer, designs, predictors, workspace.settings().seed);
  return row;
}

}  // namespace hybray::ssrm_speed_parts
