#include "harness/experiments/ssrm_rays.h"

#include "harness/experiments/cells.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ray_picture.h"
#include "harness/experiments/ray_times.h"

namespace hybray {
namespace {

std::vector<Parameter> parameters() {
  std::vector<Parameter> p = ray_parameters();
  p.push_back(parameter::repeats());
  p.push_back(parameter::flag(
      "picture", false,
      "Write a picture of the verdicts of each bounce at the pixels that its rays start from: "
      "grey = right HIT, red = false HIT, light blue = MISS, blue = unknown, black = no ray."));
  return p;
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  std::vector<Column> c;
  add_ray_columns(c);
  add_time(c, "pyramid", "depth pyramid");
  add_time(c, "t_ss", "SSRM on all rays, all bounces");
  add_time(c, "t_hw", "general tracer on all rays in its fastest mode");
  add_time(c, "t_hw_single", "general tracer on all rays, one ray at a time");
  add_time(c, "t_unresolved", "general tracer on the unresolved rays in their fastest mode");
  add_time(c, "t_hybrid",
           "measured hybrid: pyramid, and for each bounce march, compaction, trace, write-back");
  add_time(c, "t_hybrid_single", "the same with the unresolved rays traced one at a time");
  c.push_back(finding("hw_mode",
                      "fastest mode of the general tracer for all rays, by measurement; one for each "
                      "bounce where they differ",
                      Comparison::none));
  c.push_back(finding("hw_mode_unresolved", "the same for the unresolved rays", Comparison::none));
  add(c, {
             {"ss_ns_per_ray", "ns", ColumnKind::time, lower, "t_ss / rays"},
             {"hw_ns_per_ray", "ns", ColumnKind::time, lower, "t_hw / rays"},
             {"hw_single_ns_per_ray", "ns", ColumnKind::time, lower, "t_hw_single / rays"},
         });
  add_ratio(c, "speedup_sequential", "T_HW / (T_SS + (1 - alpha) T_HW), the paper's formula");
  add_ratio(c, "speedup_partitioned", "T_HW / (alpha T_SS + (1 - alpha) T_HW), a perfect predictor");
  add_ratio(c, "speedup_conditional", "T_HW / (T_SS + (1 - alpha) c T_HW), c = unresolved_cost_ratio");
  add_ratio(c, "speedup_measured", "T_HW / t_hybrid, both in their fastest modes");
  add_ratio(c, "speedup_measured_vs_single", "t_hw_single / t_hybrid_single: like against like");
  add_ratio(c, "unresolved_cost_ratio",
            "cost of an unresolved ray relative to the mean ray; the paper assumes 1", none);
  add_ratio(c, "break_even_alpha", "T_SS / T_HW: alpha from which the paper's formula gains", lower);
  add_repeats(c);
  return c;
}

void add_times(Row& row, const RayFrame& frame, const RayTimes& t, uint64_t seed) {
  put_time(row, "pyramid", t.pyramid);
  put_time(row, "t_ss", t.ss);
  put_time(row, "t_hw", t.hw);
  put_time(row, "t_hw_single", t.hw_single);
  put_time(row, "t_unresolved", t.unresolved);
  put_time(row, "t_hybrid", t.hybrid);
  put_time(row, "t_hybrid_single", t.hybrid_single);
  row["hw_mode"] = t.mode;
  row["hw_mode_unresolved"] = t.mode_unresolved;
  const double ns = 1e6 / static_cast<double>(frame.rays);
  row["ss_ns_per_ray"] = ns * metrics::median(t.ss);
  row["hw_ns_per_ray"] = ns * metrics::median(t.hw);
  row["hw_single_ns_per_ray"] = ns * metrics::median(t.hw_single);
  const RayEstimates e = estimate(frame, t);
  put_ratio(row, "speedup_sequential", t.hw, e.sequential, seed);
  put_ratio(row, "speedup_partitioned", t.hw, e.partitioned, seed);
  put_ratio(row, "speedup_conditional", t.hw, e.conditional, seed);
  put_ratio(row, "speedup_measured", t.hw, t.hybrid, seed);
  put_ratio(row, "speedup_measured_vs_single", t.hw_single, t.hybrid_single, seed);
  if (frame.unresolved > 0)
    put_ratio(row, "unresolved_cost_ratio", e.cost_per_unresolved, e.cost_per_ray, seed);
  put_ratio(row, "break_even_alpha", t.ss, t.hw, seed);
}

Row run(const Point& point, Workspace& workspace) {
  const SsrmSetup setup(point, workspace);
  const RayFrame& frame = shared_ray_frame(point, workspace, setup);
  Row row;
  add_ray_cells(row, point, setup, frame);
  if (point.boolean("picture")) write_ray_pictures(point, workspace, frame);
  const auto repeats = static_cast<int>(point.integer("repeats"));
  row["repeats"] = int64_t{repeats};
  if (workspace.settings().timing && frame.rays > 0)
    add_times(row, frame,
              time_rays(workspace.tracer(point.text("scene")), frame, {}, repeats, workspace.settings().seed),
              workspace.settings().seed);
  return row;
}

double cost_seconds(const Point& point, const SceneFacts& scene) {
  return 1.0 + ray_frame_seconds(point) +
         ray_round_seconds(point, scene, 6.0) * (static_cast<double>(point.integer("repeats")) + 1.0);
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  return {scene_cost(point, scene)};
}

}  // namespace

const Experiment& ssrm_rays_experiment() {
  static const Experiment experiment{
      "ssrm_rays",
      "SSRM and the hybrid on mirror, rough, ambient-occlusion and shadow rays and on several bounces.",
      parameters(),
      columns(),
      run,
      ray_memory_bytes,
      cost_seconds,
      shared_costs};
  return experiment;
}

}  // namespace hybray
