// What `ssrm` can be asked and what it answers. Exact definitions of the metrics: docs/metrics.md.
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ssrm.h"
#include "harness/experiments/ssrm_frame.h"

#include <cmath>

namespace hybray {
namespace ssrm_parts {
std::vector<Parameter> parameters() {
  using namespace parameter;
  std::vector<Parameter> p = ssrm_view_parameters();
  p.insert(
      p.end(),
      {
          choice(
              "marcher", "paper", {"paper", "plane"},
              "Screen-space marcher: the paper's, or the one that takes pixels and cells as slanted planes."),
          choice("bounds", "slanted", {"slanted", "flat"},
                 "Depth pyramid of marcher `plane`: slanted planes, or flat ones."),
          choice("ascent", "parent", {"parent", "iteration"},
                 "When marcher `plane` goes a level up: where it leaves the cell of that level, or after "
                 "four samples "
                 "without intersection as the paper's does."),
          choice(
              "march_code", "lanes", {"scalar", "lanes"},
              "Marcher as scalar code, or many rays at a time in vector lanes: the same results, less time."),
          integer("mirror_depth", "", 1, 1, 1, "Number of mirror reflections along a path."),
          step_budget_parameter("Depth samples that one ray may read; 0: no limit."),
          footprint_factor_parameter(),
          integer("level0_every", "", 1, 0, 1e6,
                  "March every so-manieth ray also with the exhaustive double-precision marcher; 0: none."),
          repeats(),
          verdict_picture_parameter(),
      });
  return p;
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  std::vector<Column> c;
  add_view_columns(c);
  add(c, {
             key("marcher", "screen-space marcher"),
             key("bounds", "depth pyramid of marcher `plane`"),
             key("ascent", "when marcher `plane` goes a level up"),
             key("march_code", "scalar code or vector lanes"),
             key("mirror_depth", "mirror reflections along a path"),
             key("step_budget", "depth samples a ray may read; 0 = no limit"),
             key("footprint_factor", "k of the tolerance"),
         });
  add_verdict_columns(c);
  add(c, {
             share_of_rays("resolved_fraction", higher, "rays not sent to the general tracer / rays"),
             share_of_rays(
                 "level0_disagreement_fraction", lower,
                 "rays labelled differently by the exhaustive double-precision marcher / rays compared"),
             {"level0_margin_ulp", "ulp", ColumnKind::metric, lower,
              "widest decision margin of a ray labelled differently, in float ulps", Comparison::none},
             samples_read("steps_per_ray", lower, "depth samples read / rays"),
         });
  add_time(c, "gbuffer", "depth, derivatives and normals of the main view");
  add_time(c, "pyramid", "depth pyramid that the marcher needs");
  add_time(c, "raygen", "world-space reflection rays");
  add_time(c, "projection", "rays into screen space; the paper's ray buffers already are");
  add_time(c, "compaction", "list of the unresolved rays");
  add_time(c, "t_ss", "SSRM on all rays");
  add_time(c, "t_hw", "general tracer on all rays in its fastest mode");
  add_trace_mode_columns(c);
  add_time(c, "t_hw_single", "general tracer on all rays, one ray at a time");
  add_time(c, "t_unresolved", "general tracer on the unresolved rays in their fastest mode");
  add_time(c, "t_hybrid", "measured hybrid: pyramid, march, compaction, trace, write-back");
  add_time(c, "t_hybrid_single", "the same with the unresolved rays traced one at a time");
  c.push_back(
      {"t_sequential_ms", "ms", ColumnKind::time, lower, "estimate T_SS + (1 - alpha) T_HW (SSRM paper)"});
  c.push_back({"t_partitioned_ms", "ms", ColumnKind::time, lower,
               "estimate alpha T_SS + (1 - alpha) T_HW (perfect predictor)"});
  add_ratio(c, "speedup_sequential", "T_HW / t_sequential");
  add_ratio(c, "speedup_partitioned", "T_HW / t_partitioned");
  add_ratio(c, "speedup_measured", "T_HW / t_hybrid, both in their fastest modes");
  add_ratio(c, "speedup_measured_vs_single", "t_hw_single / t_hybrid_single: like against like");
  add_ratio(c, "unresolved_cost_ratio",
            "cost of an unresolved ray relative to the mean ray; the paper assumes 1");
  c.push_back({"break_even_alpha", "1", ColumnKind::time, lower,
               "T_SS / T_HW: alpha from which the paper's formula gains"});
  c.push_back(follows_rays(
      {"buffer_bytes", "bytes", ColumnKind::metric, lower, "geometry buffers, pyramid and ray lists"}));
  add_repeats(c);
  return c;
}

double memory_bytes(const Point& point) {
  // Bytes a pixel where it is most, while times are taken: 141 as measured, and some in reserve. Geometry
  // buffers and rays are there twice, with four lists of hits.
  constexpr double kPixel = 165.0;
  return kSceneBytes + kPixel * pixels_of(point);
}

// Measured as processor time on two cores; good to a factor of two for the sum over a config, while a single
// point of it may be further off.
double cost_seconds(const Point& point, const SceneFacts& scene) {
  const double pixels = pixels_of(point);
  // A round traces all rays twice and the unresolved ones three times, for which the tracer needs the longer
  // the deeper its tree is, and marches all of them three times.
  const double depth = std::log2(static_cast<double>(scene.triangles) + 2.0);
  const double round = 0.05e-6 * depth * pixels;
  const double verdicts = 0.5e-6 * pixels;
  const double modes = 0.04 * depth;  // finding the fastest ones takes a fixed number of rays
  // The exhaustive marcher visits the pixels along a ray, a number that grows with the width.
  const auto stride = static_cast<double>(point.integer("level0_every"));
  const double level0 = stride > 0.0 ? 0.7e-9 * pixels * width_of(point) / stride : 0.0;
  return verdicts + level0 + modes + round * (static_cast<double>(point.integer("repeats")) + 1.0);
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  return {scene_cost(point, scene)};
}

}  // namespace ssrm_parts

const Experiment& ssrm_experiment() {
  static const Experiment experiment{"ssrm",
                                     "Strict screen space ray marching of mirror reflections, judged against "
                                     "traced truth, and the hybrid with a general ray tracer.",
                                     ssrm_parts::parameters(),
                                     ssrm_parts::columns(),
                                     ssrm_parts::run,
                                     ssrm_parts::memory_bytes,
                                     ssrm_parts::cost_seconds,
                                     ssrm_parts::shared_costs};
  return experiment;
}

}  // namespace hybray
