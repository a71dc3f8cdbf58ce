// What `ssrm` can be asked and what it answers. Exact definitions of the metrics: docs/metrics.md.
#include "harness/experiments/columns.h"
#include "harness/experiments/resolution.h"
#include "harness/experiments/ssrm.h"

namespace hybray {
namespace ssrm_parts {
std::vector<Parameter> parameters() {
  using enum ParameterType;
  const auto none = std::monostate{};
  return {
      {"scene", scene, "", none, {}, {}, {}, "Scene by name (hybray scene list)."},
      {"camera",
       camera,
       "",
       std::string("*"),
       {},
       {},
       {},
       "Camera of the scene by name; \"*\" stands for each of them."},
      {"resolution",
       resolution,
       "px",
       std::string("1920x1080"),
       1,
       16384,
       {},
       "Width and height of the main view."},
      {"near", number, "m", 0.1, 1e-9, 1e9, {}, "Distance of the near plane."},
      {"far", number, "m", 0.0, 0.0, 1e12, {}, "Distance of the far plane; 0: just beyond the scene."},
      {"depth_convention",
       choice,
       "",
       std::string("reversed"),
       {},
       {},
       {"standard", "reversed"},
       "Device depth that grows with distance (standard) or falls (reversed)."},
      {"derivatives",
       choice,
       "",
       std::string("plane"),
       {},
       {},
       {"plane", "difference"},
       "Depth derivatives from the triangle's plane, or by differences inside 2x2 quads as graphics hardware "
       "makes them."},
      {"marcher", choice, "", std::string("paper"), {}, {}, {"paper"}, "Screen-space marcher."},
      {"mirror_depth", integer, "", int64_t{1}, 1, 1, {}, "Number of mirror reflections along a path."},
      {"step_budget",
       integer,
       "",
       int64_t{0},
       0,
       1e9,
       {},
       "Depth samples that one ray may read; 0: no limit."},
      {"footprint_factor", number, "", 1.0, 1e-3, 1e3, {}, "k of the tolerance that makes a HIT right."},
      {"level0_every",
       integer,
       "",
       int64_t{1},
       0,
       1e6,
       {},
       "March every so-manieth ray also with the exhaustive double-precision marcher; 0: none."},
      {"repeats", integer, "", int64_t{7}, 1, 1000, {}, "Timed rounds after one that is not counted."},
      {"picture",
       boolean,
       "",
       false,
       {},
       {},
       {},
       "Write the verdict picture: grey = resolved, blue = unknown, light blue = miss, red = false hit, "
       "black = background."},
  };
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  std::vector<Column> c{
      key("scene", "scene"),
      key("camera", "camera"),
      key("width", "width of the main view", "px"),
      key("height", "height of the main view", "px"),
      key("marcher", "screen-space marcher"),
      key("near_m", "near plane", "m"),
      key("far_m", "far plane in use", "m"),
      key("depth_convention", "depth convention"),
      key("derivatives", "origin of the depth derivatives"),
      key("mirror_depth", "mirror reflections along a path"),
      key("step_budget", "depth samples a ray may read; 0 = no limit"),
      key("footprint_factor", "k of the tolerance"),
      counted("triangles", "triangles of the scene"),
      counted("rays", "reflection rays, one a covered pixel"),
      fraction("alpha", higher, "HIT / rays"),
      fraction("miss_fraction", none, "MISS / rays"),
      fraction("false_miss_fraction", lower, "share of MISS whose ray truly hits something"),
      fraction("resolved_fraction", higher, "rays not sent to the general tracer / rays"),
      fraction("unknown_offscreen_fraction", none,
               "rays that left the view volume at the side or the far plane / rays"),
      fraction("unknown_behind_fraction", none,
               "rays already behind the failing pixel's plane where they enter it / rays"),
      fraction("unknown_viewer_fraction", none, "rays that left through the near plane / rays"),
      fraction("unknown_correction_fraction", none, "rays that failed the correction otherwise / rays"),
      fraction("unknown_budget_fraction", none, "rays whose step budget was exhausted / rays"),
      fraction("precision", higher, "right HITs / HITs"),
      fraction("precision_loose", higher, "HITs within max(1 % of t*, 1.5 footprints) / HITs"),
      fraction("recall", higher, "right HITs / rays whose true hit the main view sees"),
      fraction("alpha_max", none, "rays whose true hit the main view sees / rays"),
      fraction("false_hit_fraction", lower, "false HITs / HITs; phantom + early + through"),
      fraction("phantom_fraction", lower, "HITs of rays that truly hit nothing / HITs"),
      fraction("early_fraction", lower, "HITs claimed before the true hit / HITs"),
      fraction("through_fraction", lower, "HITs claimed beyond the true hit / HITs"),
      fraction("level0_disagreement_fraction", lower,
               "rays labelled differently by the exhaustive double-precision marcher / rays compared"),
      {"level0_margin_ulp", "ulp", ColumnKind::metric, lower,
       "widest decision margin of a ray labelled differently, in float ulps"},
      {"steps_per_ray", "1", ColumnKind::metric, lower, "depth samples read / rays"},
      counted("geometric_mirror_rays",
              "rays mirrored about the geometric normal instead of the shading normal"),
  };
  add_time(c, "gbuffer", "depth, derivatives and normals of the main view");
  add_time(c, "pyramid", "depth pyramid");
  add_time(c, "raygen", "world-space reflection rays");
  add_time(c, "projection", "rays into screen space; the paper's ray buffers already are");
  add_time(c, "compaction", "list of the unresolved rays");
  add_time(c, "t_ss", "SSRM on all rays");
  add_time(c, "t_hw", "general tracer on all rays in its fastest mode");
  c.push_back(key("hw_mode", "fastest mode of the general tracer for all rays, by measurement"));
  c.push_back(key("hw_mode_unresolved", "fastest mode for the unresolved rays, by measurement"));
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
  c.push_back(counted("paths_skipped", "background pixels, for which no ray was made"));
  c.push_back(counted("buffers_skipped", "kinds of geometry buffer that this point did not need"));
  c.push_back(
      {"buffer_bytes", "bytes", ColumnKind::metric, lower, "geometry buffers, pyramid and ray lists"});
  c.push_back(counted("threads", "threads in use"));
  c.push_back(counted("repeats", "timed rounds"));
  return c;
}

double memory_bytes(const Point& point) {
  // Bytes a pixel, all arrays of a run together: geometry buffers (held, and once more while they are timed),
  // pyramid, world and screen rays (twice as well), verdicts of two marchers, four lists of hits, indices.
  constexpr double kPixel = 2 * 32 + 5.4 + 2 * (28 + 29) + 2 * 5 + 4 * 8 + 10;
  constexpr double kScene = 1.0e9;  // the largest of the known scenes with both acceleration structures
  const auto size = *parse_resolution(point.text("resolution"));
  return kScene + kPixel * size.width * size.height;
}

double cost_seconds(const Point& point) {
  const auto size = *parse_resolution(point.text("resolution"));
  const double rounds = static_cast<double>(point.integer("repeats")) + 1.0;
  // On two cores about 1.2 microseconds a pixel and round for all timed variants, and 3 for truth and the
  // exhaustive marcher.
  return 1e-6 * size.width * size.height * (1.2 * rounds + 3.0);
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
                                     ssrm_parts::cost_seconds};
  return experiment;
}

}  // namespace hybray
