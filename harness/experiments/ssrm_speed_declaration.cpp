// What `ssrm_speed` can be asked and what it answers. Exact definitions: docs/hybrid.md.
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/ssrm_speed.h"

#include <cmath>

namespace hybray {
namespace ssrm_speed_parts {
namespace {

std::vector<Parameter> parameters() {
  using namespace parameter;
  std::vector<Parameter> p = ssrm_view_parameters();
  p.insert(
      p.end(),
      {
          choice(
              "marcher", "paper", {"paper", "plane"},
              "Screen-space marcher: the paper's, or the one that takes pixels and cells as slanted planes."),
          choice("predictor", "direction", {"sample", "direction", "history"},
                 "What estimates a ray's chance: a sample of the frame; that and the ray's direction; "
                 "these and the frame before."),
          number("march_cost", "", 0.7, 0.0, 1.0,
                 "T_SS / T_HW of a ray against the fastest mode: the chance from which on it is marched."),
          number("march_cost_single", "", 0.3, 0.0, 1.0, "The same against single rays."),
          number("path_step", "m", 0.05, 0.0, 1e6,
                 "How far to the left the frame before was taken, for predictor history."),
          flag("certified_misses", true,
               "Rays that pass in front of all conservative depth are not traced where the remaining "
               "segment is exact."),
          repeats(),
      });
  return p;
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  std::vector<Column> c;
  add_view_columns(c);
  add(c,
      {
          key("marcher", "screen-space marcher"),
          key("predictor", "what estimates a ray's chance of a HIT"),
          key("march_cost", "chance from which on a ray is marched, fastest mode"),
          key("march_cost_single", "the same against single rays"),
          key("path_step_m", "distance to the frame before", "m"),
          key("certified_misses", "certified misses are not traced"),
          share_of_rays("alpha", higher, "HIT / rays"),
          share_of_rays("alpha_predicted", higher,
                        "HIT / rays, of the rays marched against the fastest mode"),
          share_of_rays("alpha_predicted_single", higher, "the same against single rays"),
          share_of_rays("predicted_fraction", none, "rays sent straight to the fastest mode / rays"),
          share_of_rays("predicted_single_fraction", none, "the same against single rays"),
          share_of_rays("certified_miss_fraction", higher, "certified misses / rays"),
          share_of_rays("certified_false_fraction", lower,
                        "certified misses that truly hit something / those"),
          share_of_rays("segment_changed_fraction", lower,
                        "unresolved rays whose answer changes with the centre segment / unresolved rays"),
          share_of_rays("segment_exact_changed_fraction", lower, "the same of the exact segment"),
          share_of_rays("segment_centre_proved_fraction", higher,
                        "start distance / true distance, mean over the unresolved rays that hit something"),
          share_of_rays("segment_exact_proved_fraction", higher, "the same of the exact segment"),
          follows_rays(counted("conservative_pixels", "pixels touched by triangles, summed over these")),
          samples_read("steps_per_ray", lower, "depth samples read / rays"),
          samples_read("segment_exact_steps_per_ray", lower,
                       "depth samples read for the exact segments / rays"),
      });
  add_time(c, "pyramid", "depth pyramid");
  add_time(c, "conservative", "conservative depth and its pyramid");
  add_time(c, "t_ss_scalar", "march of all rays, scalar code");
  add_time(c, "t_ss", "march of all rays, vector lanes");
  add_time(c, "t_hw", "general tracer on all rays in its fastest mode");
  add_trace_mode_columns(c);
  add_time(c, "t_hw_single", "general tracer on all rays, one ray at a time");
  for (const auto& [end, with] : {std::pair("", "fastest mode"), std::pair("_single", "single rays")}) {
    const auto time = [&](const char* stem, const char* text) {
      add_time(c, std::string(stem) + end, std::string(text) + ", " + with);
    };
    time("t_hybrid", "pyramid, march, compaction, trace");
    time("t_predicted", "the same with the predictor, its sample included");
    time("t_oracle", "the same marching exactly the rays that a march resolves");
    time("t_free", "compaction and trace alone: a march that costs nothing");
    time("t_centre", "hybrid with the remaining segment by pixel centres");
    time("t_exact", "hybrid with the exact remaining segment, conservative depth included");
    time("t_exact_given", "the same with the conservative depth given");
  }
  add_ratio(c, "scalar_lanes_ratio", "t_ss_scalar / t_ss");
  add_ratio(c, "speedup_measured", "t_hw / t_hybrid");
  add_ratio(c, "speedup_predicted", "t_hw / t_predicted");
  add_ratio(c, "speedup_oracle", "t_hw / t_oracle");
  add_ratio(c, "speedup_free", "t_hw / t_free");
  add_ratio(c, "speedup_centre", "t_hw / t_centre");
  add_ratio(c, "speedup_exact", "t_hw / t_exact");
  add_ratio(c, "speedup_measured_vs_single", "t_hw_single / t_hybrid_single");
  add_ratio(c, "speedup_predicted_vs_single", "t_hw_single / t_predicted_single");
  add_ratio(c, "speedup_oracle_vs_single", "t_hw_single / t_oracle_single");
  add_ratio(c, "speedup_free_vs_single", "t_hw_single / t_free_single");
  add_ratio(c, "speedup_centre_vs_single", "t_hw_single / t_centre_single");
  add_ratio(c, "speedup_exact_vs_single", "t_hw_single / t_exact_single");
  add_ratio(c, "speedup_exact_given_vs_single", "t_hw_single / t_exact_given_single");
  add_interval(
      c, "predictor_efficiency", ColumnKind::time, higher,
      "(t_hybrid - t_predicted) / (t_hybrid - t_oracle), by medians of the paired differences; empty where "
      "the interval of the denominator includes 0");
  add_interval(c, "predictor_efficiency_single", ColumnKind::time, higher, "the same against single rays");
  c.push_back({"t_partitioned_ms", "ms", ColumnKind::time, lower,
               "estimate alpha T_SS + (1 - alpha) T_HW (perfect predictor)"});
  c.push_back(
      {"t_partitioned_single_ms", "ms", ColumnKind::time, lower, "the same with T_HW of single rays"});
  add_ratio(c, "oracle_partitioned_ratio", "t_oracle / t_partitioned", lower);
  add_ratio(c, "oracle_partitioned_single_ratio", "t_oracle_single / t_partitioned_single", lower);
  add_repeats(c);
  return c;
}

double memory_bytes(const Point& point) {
  constexpr double kPixel = 300.0;  // buffers, rays, hits and lists of every design
  return kSceneBytes + kPixel * pixels_of(point);
}

double cost_seconds(const Point& point, const SceneFacts& scene) {
  const double pixels = pixels_of(point);
  const double triangles = static_cast<double>(scene.triangles), depth = std::log2(triangles + 2.0);
  const double round = 0.25e-6 * depth * pixels + 4e-6 * triangles;
  return 1e-6 * pixels + round * (static_cast<double>(point.integer("repeats")) + 1.0);
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  return {scene_cost(point, scene)};
}

}  // namespace
}  // namespace ssrm_speed_parts

const Experiment& ssrm_speed_experiment() {
  static const Experiment experiment{
      "ssrm_speed",
      "What the hybrid of screen-space marching and a general ray tracer costs and "
      "saves, every design in one interleaved run.",
      ssrm_speed_parts::parameters(),
      ssrm_speed_parts::columns(),
      ssrm_speed_parts::run,
      ssrm_speed_parts::memory_bytes,
      ssrm_speed_parts::cost_seconds,
      ssrm_speed_parts::shared_costs};
  return experiment;
}

}  // namespace hybray
