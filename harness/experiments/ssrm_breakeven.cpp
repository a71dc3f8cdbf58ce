#include "harness/experiments/ssrm_breakeven.h"

#include "harness/experiments/cells.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ray_times.h"

#include <string>

namespace hybray {
namespace {

constexpr const char* kFastest = "fastest";

std::vector<Parameter> parameters() {
  std::vector<Parameter> p = ray_parameters();
  std::vector<std::string> modes = {kFastest};
  for (TraceMode mode : kAllTraceModes) modes.push_back(label(mode));
  p.push_back(
      parameter::choice("tracer_mode", kFastest, modes,
                        "How all rays, and in the hybrid the unresolved ones, are handed to the general "
                        "tracer; the fastest is found by measurement for each list of rays."));
  p.push_back(parameter::repeats());
  return p;
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  std::vector<Column> c;
  add_ray_columns(c);
  c.push_back(key("tracer_mode", "how rays are handed to the general tracer"));
  c.push_back(finding("hw_mode", "the mode that this was for all rays; one for each bounce where they differ",
                      Comparison::none));
  c.push_back(finding("hw_mode_unresolved", "the same for the unresolved rays", Comparison::none));
  add_time(c, "t_ss", "SSRM on all rays, all bounces");
  add_time(c, "t_hw", "general tracer on all rays in this mode");
  add_time(c, "t_hybrid",
           "measured hybrid: pyramid, and for each bounce march, compaction, trace, write-back");
  add_ratio(c, "break_even_alpha", "T_SS / T_HW", lower);
  add_ratio(c, "unresolved_cost_ratio", "c: cost of an unresolved ray relative to the mean ray", none);
  add_ratio(c, "speedup_sequential", "T_HW / (T_SS + (1 - alpha) T_HW), the paper's formula");
  add_ratio(c, "speedup_partitioned", "T_HW / (alpha T_SS + (1 - alpha) T_HW), a perfect predictor");
  add_ratio(c, "speedup_conditional", "T_HW / (T_SS + (1 - alpha) c T_HW)");
  add_ratio(c, "speedup_measured", "T_HW / t_hybrid");
  for (const char* name : {"pays_sequential", "pays_partitioned", "pays_conditional", "pays_measured"})
    c.push_back(finding(name,
                        "yes or no: whether the interval of the speedup of that name lies above or below 1; "
                        "unclear where 1 is inside",
                        Comparison::none));
  add_repeats(c);
  return c;
}

void put_speedup(Row& row, const std::string& name, std::span<const double> hw, std::span<const double> time,
                 uint64_t seed) {
  const metrics::Interval s = metrics::median_ratio(hw, time, seed);
  put_interval(row, "speedup_" + name, s);
  row["pays_" + name] = std::string(s.low > 1.0 ? "yes" : s.high < 1.0 ? "no" : "unclear");
}

std::optional<TraceMode> mode_named(const std::string& name) {
  for (TraceMode mode : kAllTraceModes)
    if (name == label(mode)) return mode;
  return {};
}

void add_times(Row& row, const RayFrame& frame, const RayTimes& t, uint64_t seed) {
  row["hw_mode"] = t.mode;
  row["hw_mode_unresolved"] = t.mode_unresolved;
  put_time(row, "t_ss", t.ss);
  put_time(row, "t_hw", t.hw);
  put_time(row, "t_hybrid", t.hybrid);
  put_ratio(row, "break_even_alpha", t.ss, t.hw, seed);
  const RayEstimates e = estimate(frame, t);
  if (frame.unresolved > 0)
    put_ratio(row, "unresolved_cost_ratio", e.cost_per_unresolved, e.cost_per_ray, seed);
  put_speedup(row, "sequential", t.hw, e.sequential, seed);
  put_speedup(row, "partitioned", t.hw, e.partitioned, seed);
  put_speedup(row, "conditional", t.hw, e.conditional, seed);
  put_speedup(row, "measured", t.hw, t.hybrid, seed);
}

Row run(const Point& point, Workspace& workspace) {
  const SsrmSetup setup(point, workspace);
  const RayFrame& frame = shared_ray_frame(point, workspace, setup);
  Row row;
  add_ray_cells(row, point, setup, frame);
  row["tracer_mode"] = point.text("tracer_mode");
  const auto repeats = static_cast<int>(point.integer("repeats"));
  row["repeats"] = int64_t{repeats};
  if (workspace.settings().timing && frame.rays > 0) {
    const uint64_t seed = workspace.settings().seed;
    add_times(row, frame,
              time_rays(workspace.tracer(point.text("scene")), frame, mode_named(point.text("tracer_mode")),
                        repeats, seed),
              seed);
  }
  return row;
}

double cost_seconds(const Point& point, const SceneFacts& scene) {
  return 0.5 + ray_round_seconds(point, scene, 6.0) * (static_cast<double>(point.integer("repeats")) + 1.0);
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  std::string frame = "ray frame";
  for (const Parameter& p : ray_parameters()) frame += ' ' + to_text(point.parameters.at(p.name));
  return {scene_cost(point, scene), {frame, ray_frame_seconds(point)}};
}

}  // namespace

const Experiment& ssrm_breakeven_experiment() {
  static const Experiment experiment{"ssrm_breakeven",
                                     "Whether the hybrid pays, for each kind of rays and mode of the general "
                                     "tracer, and which formula says so.",
                                     parameters(),
                                     columns(),
                                     run,
                                     ray_memory_bytes,
                                     cost_seconds,
                                     shared_costs};
  return experiment;
}

}  // namespace hybray
