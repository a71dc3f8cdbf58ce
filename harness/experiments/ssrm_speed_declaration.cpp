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
          choice("predictor", "history", {"sample", "history"},
                 "What tells which tiles are worth a march: a sample of the frame, or the frames before, "
                 "looked up where the surface was on the screen."),
          number("least_chance", "", 0.6, 0.0, 10.0,
                 "Chance of a HIT from which on a tile is marched, against the fastest mode; above 1: none "
                 "is."),
          number("least_chance_single", "", 0.38, 0.0, 10.0, "The same against single rays."),
          number("path_step", "m", 0.02, 0.0, 1e6,
                 "How far the camera has gone to the right from frame to frame, for predictor history."),
          integer("path_frames", "", 8, 1, 1000,
                  "Frames before, for predictor history; the first marches all."),
          flag("remaining_segment", true,
               "Also the designs whose trace starts where the march has proved emptiness."),
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
          key("least_chance", "chance from which on a tile is marched, fastest mode"),
          key("least_chance_single", "the same against single rays"),
          key("path_step_m", "distance from frame to frame", "m"),
          key("path_frames", "frames before"),
          key("remaining_segment", "designs with a remaining segment are part of the run"),
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
          share_of_rays(
              "segment_exact_changed_timed_fraction", lower,
              "the same of the tracer that is timed, by more than rounding, in the mode where most change"),
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
  add_time(c, "t_ss_listed", "the same by a list of all rays");
  add_time(c, "t_ss_hits", "march of the rays that a march resolves, by a list");
  add_time(c, "t_ss_others", "march of the others, by a list");
  add_trace_mode_columns(c);
  for (const auto& [end, with] : {std::pair("", "fastest mode"), std::pair("_single", "single rays")}) {
    const auto time = [&](const char* stem, const char* text) {
      add_time(c, std::string(stem) + end, std::string(text) + ", " + with);
    };
    time("t_hw", "general tracer on all rays");
    time("t_hw_listed", "the same by a list of all rays");
    time("t_hw_hits", "general tracer on the rays that a march resolves, by a list");
    time("t_hw_others", "general tracer on the others, by a list");
    time("t_hybrid", "pyramid, march, compaction, trace");
    time("t_predicted", "the same with the predictor, with all that it does");
    time("t_oracle", "the same marching exactly the rays that a march resolves");
    time("t_oracle_runs", "as t_predicted by a predictor that knows each tile's share of HITs, for nothing");
    time("t_free", "compaction and trace alone: a march that costs nothing");
    time("t_centre", "hybrid with the remaining segment by pixel centres");
    time("t_predicted_centre", "the same with the predictor");
    time("t_exact", "hybrid with the exact remaining segment, conservative depth included");
    time("t_exact_given", "the same with the conservative depth given");
  }
  add_ratio(c, "scalar_lanes_ratio", "t_ss_scalar / t_ss");
  add_ratio(c, "speedup_measured", "t_hw / t_hybrid");
  add_ratio(c, "speedup_predicted", "t_hw / t_predicted");
  add_ratio(c, "speedup_oracle", "t_hw / t_oracle");
  add_ratio(c, "speedup_oracle_runs", "t_hw / t_oracle_runs");
  add_ratio(c, "speedup_free", "t_hw / t_free");
  add_ratio(c, "speedup_centre", "t_hw / t_centre");
  add_ratio(c, "speedup_predicted_centre", "t_hw / t_predicted_centre");
  add_ratio(c, "speedup_exact", "t_hw / t_exact");
  add_ratio(c, "speedup_measured_vs_single", "t_hw_single / t_hybrid_single");
  add_ratio(c, "speedup_predicted_vs_single", "t_hw_single / t_predicted_single");
  add_ratio(c, "speedup_oracle_vs_single", "t_hw_single / t_oracle_single");
  add_ratio(c, "speedup_oracle_runs_vs_single", "t_hw_single / t_oracle_runs_single");
  add_ratio(c, "speedup_free_vs_single", "t_hw_single / t_free_single");
  add_ratio(c, "speedup_centre_vs_single", "t_hw_single / t_centre_single");
  add_ratio(c, "speedup_predicted_centre_vs_single", "t_hw_single / t_predicted_centre_single");
  add_ratio(c, "speedup_exact_vs_single", "t_hw_single / t_exact_single");
  add_ratio(c, "speedup_exact_given_vs_single", "t_hw_single / t_exact_given_single");
  add_interval(
      c, "predictor_efficiency", ColumnKind::time, higher,
      "(t_hybrid - t_predicted) / (t_hybrid - t_oracle), by medians of the paired differences; empty where "
      "the interval of the denominator includes 0");
  add_interval(c, "predictor_efficiency_single", ColumnKind::time, higher, "the same against single rays");
  add_interval(c, "runs_efficiency", ColumnKind::time, higher, "predictor_efficiency with t_oracle_runs");
  add_interval(c, "runs_efficiency_single", ColumnKind::time, higher, "the same against single rays");
  for (const auto& [end, with] : {std::pair("", ""), std::pair("_single", ", single rays")}) {
    const auto name = [&](const char* stem) { return std::string(stem) + end; };
    const auto add_gap = [&](const char* stem, const char* text) {
      add_ratio(c, name(stem), std::string(text) + ", / t_partitioned" + with, lower);
    };
    c.push_back(
        {name("break_even_chance"), "1", ColumnKind::time, none,
         std::string("chance of a HIT at which a march and the trace that it may save cost the same") + with +
             "; empty where no chance pays for a march"});
    c.push_back({name("t_partitioned") + "_ms", "ms", ColumnKind::time, lower,
                 std::string("estimate alpha T_SS + (1 - alpha) T_HW (perfect predictor)") + with});
    add_ratio(c, name("oracle_partitioned") + "_ratio", std::string("t_oracle / t_partitioned") + with,
              lower);
    add_gap("gap", "t_oracle - t_partitioned");
    add_gap("gap_pyramid", "of it: the pyramid");
    add_gap("gap_march_listed", "of it: rays are marched by a list");
    add_gap("gap_march_apart", "of it: HITs and others are marched apart");
    add_gap("gap_march_dearer", "of it: the march of a HIT costs more than the mean");
    add_gap("gap_trace_listed", "of it: rays are traced by a list");
    add_gap("gap_trace_apart", "of it: HITs and others are traced apart");
    add_gap("gap_trace_dearer", "of it: the trace of an unresolved ray costs more than the mean");
    add_gap("gap_rest", "what is left of it");
  }
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
  const double round = 0.15e-6 * depth * pixels + 2.5e-6 * triangles;
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
