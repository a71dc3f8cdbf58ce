// What `stability` can be asked and what it answers.
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/stability.h"

namespace hybray {
namespace {

std::vector<Parameter> parameters() {
  using namespace parameter;
  return {
      scene(),
      camera(),
      resolution("640x360"),
      choice("marcher", "paper", {"paper", "plane"}, "Screen-space marcher, in vector lanes."),
      near_plane(0.1),
      number("far_near_ratio", "", 0.0, 0.0, 1e12,
             "far / near: the near plane moves toward the eye, the far plane stays just beyond the scene; 0: "
             "`near` counts."),
      choice("far_plane", "finite", {"finite", "infinite"}, "Just beyond the scene, or infinitely far."),
      choice("depth_convention", "reversed", {"standard", "reversed"},
             "Device depth that grows with distance (standard) or falls (reversed)."),
      choice("depth_format", "float32", {"float32", "unorm24", "unorm16"}, "How depth is stored."),
      choice("depth_rounding", "nearest", {"nearest", "viewer"},
             "To the nearest stored depth, or to the one on the viewer's side."),
      choice("derivatives", "plane", {"plane", "difference"},
             "Depth derivatives from the triangle's plane, or by differences of the stored depth."),
      number("scene_scale", "", 1.0, 1e-12, 1e12, "Factor of all lengths, near and far planes included."),
      number("offset", "m", 0.0, 0.0, 1e12,
             "How far the scene is moved from where it was made, aslant to its axes."),
      choice("origin", "world", {"world", "camera"},
             "What float coordinates are relative to: the world, or the eye, subtracted in double before "
             "rounding."),
      number("incidence", "deg", -1.0, -1.0, 89.9999,
             "Angle between the view axis and the normal of what it meets; -1: as the camera has it."),
      number("jitter_x", "px", 0.0, -1.0, 1.0, "Shift of the view axis on the screen."),
      number("jitter_y", "px", 0.0, -1.0, 1.0, "The same downward."),
      choice("ray_offset", "scaled", {"scaled", "fixed", "none", "split"},
             "Where mirror rays start: off the surface by a share of the coordinates, by 0.1 mm, on it, or "
             "on it for the march and off it for the tracer."),
      choice("tracer", "robust", {"robust", "fast"},
             "Flavour of the general tracer that traces the mirror rays."),
      integer("judged_rays", "", 50000, 1, 1e8,
              "Mirror rays that are judged, evenly spread over the pixels."),
      footprint_factor_parameter(),
  };
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  std::vector<Column> c;
  add(c,
      {
          key("scene", "scene"),
          key("camera", "camera"),
          key("width", "width of the main view", "px"),
          key("height", "height of the main view", "px"),
          key("marcher", "screen-space marcher"),
          key("near_m", "near plane, where no ratio is given, before scaling", "m"),
          key("far_near_ratio", "far / near; 0: near_m counts", "1"),
          key("far_plane", "far plane"),
          key("depth_convention", "depth convention"),
          key("depth_format", "how depth is stored"),
          key("depth_rounding", "which way it rounds"),
          key("derivatives", "origin of the depth derivatives"),
          key("scene_scale", "factor of all lengths", "1"),
          key("offset_m", "how far the scene is from where it was made", "m"),
          key("origin", "what coordinates are relative to"),
          key("incidence_deg", "angle of the view axis and the normal; empty: as the camera has it", "deg"),
          key("jitter_x_px", "shift of the view axis to the right", "px"),
          key("jitter_y_px", "shift of the view axis downward", "px"),
          key("ray_offset", "where mirror rays start"),
          key("tracer", "flavour of the general tracer"),
          key("footprint_factor", "k of the tolerance"),
          counted("triangles", "triangles of the scene"),
          counted("judged_rays", "mirror rays judged"),
      });
  add_threads(c);
  add(c,
      {
          share_of_rays("alpha", none, "HIT / judged rays"),
          share_of_rays("exact_alpha", none, "the same in double precision"),
          share_of_rays("labels_flipped_fraction", lower,
                        "rays whose verdict or accepted pixel is not that of double precision / judged rays"),
          share_of_rays("hits_flipped_fraction", lower,
                        "rays that are a HIT in one of the two only / judged rays"),
          share_of_rays(
              "lost_rays_fraction", lower,
              "rays that the disturbed frame does not have, or not in finite numbers / judged rays"),
          {"false_hits", "", ColumnKind::count, lower, "false HITs", {}, {2.0, 0.01}},
          {"exact_false_hits",
           "",
           ColumnKind::count,
           none,
           "false HITs of double precision: those of sampling",
           {},
           {2.0, 0.01}},
          {"further_false_hits",
           "",
           ColumnKind::count,
           lower,
           "false HITs of rays that are none in double precision",
           {},
           {2.0, 0.05}},
          {"march_self_hits",
           "",
           ColumnKind::count,
           lower,
           "HITs on the triangle that the ray starts from, which no mirror ray can meet",
           {},
           {2.0, 0.05}},
          {"hit_distance_error_fraction",
           "1",
           ColumnKind::metric,
           lower,
           "error of a HIT's distance at the same pixel, relative to the larger of the two; 99th percentile",
           {},
           {1e-6, 0.05}},
          share_of_rays("pixels_changed_fraction", lower,
                        "pixels that see another primitive / pixels that see one"),
          {"depth_error_fraction",
           "1",
           ColumnKind::metric,
           lower,
           "error of the stored view depth, relative to the larger of the two; 99th percentile",
           {},
           {1e-7, 0.05}},
          {"depth_error_max_fraction",
           "1",
           ColumnKind::metric,
           lower,
           "the largest of them",
           {},
           {1e-6, 0.2}},
          {"direction_error_deg",
           "deg",
           ColumnKind::metric,
           lower,
           "angle between mirror rays and those of double precision; 99th percentile",
           {},
           {1e-5, 0.05}},
          share_of_rays("trace_wrong_fraction", lower,
                        "rays that the general tracer wrongly hits or misses with, or whose distance it has "
                        "wrong by more "
                        "than 1 % and a pixel's footprint / judged rays"),
          {"trace_self_hits",
           "",
           ColumnKind::count,
           lower,
           "traced rays that meet the triangle they start from",
           {},
           {2.0, 0.05}},
          share_of_rays(
              "jitter_flipped_fraction", none,
              "rays that double precision resolves at this sub-pixel position or without jitter, but "
              "not at both / judged rays; empty without jitter"),
      });
  return c;
}

double memory_bytes(const Point& point) {
  // Buffers and exact planes of every pixel, two tracers of the placed scene; the judged rays with all that
  // is known of them.
  constexpr double kPixel = 80.0, kRay = 300.0;
  return 2.0 * kSceneBytes + kPixel * pixels_of(point) +
         kRay * static_cast<double>(point.integer("judged_rays"));
}

// As measured on two cores, good to a factor of two.
double cost_seconds(const Point& point, const SceneFacts& scene) {
  return 0.4e-6 * pixels_of(point) +
         (1e-6 + 4e-9 * width_of(point)) * static_cast<double>(point.integer("judged_rays")) +
         1e-6 * static_cast<double>(scene.triangles);
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  return {scene_cost(point, scene)};
}

}  // namespace

const Experiment& stability_experiment() {
  static const Experiment experiment{
      "stability",
      "Buffers, march and tracer at extremes of depth format, scale, place, angle, resolution and sub-pixel "
      "position, against double precision: labels flipped, false hits, errors, self-intersections.",
      parameters(),
      columns(),
      stability_parts::run,
      memory_bytes,
      cost_seconds,
      shared_costs};
  return experiment;
}

}  // namespace hybray
