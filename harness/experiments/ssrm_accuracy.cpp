// What `ssrm_accuracy` can be asked and what it answers.
#include "harness/experiments/ssrm_accuracy.h"

#include "core/ssrm/hit_checks.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ssrm_frame.h"

#include <cmath>

namespace hybray {
namespace {

using ssrm::HitCheck;

std::vector<Parameter> parameters() {
  using namespace parameter;
  std::vector<Parameter> p = ssrm_view_parameters();
  p.insert(
      p.end(),
      {
          choice("marcher", "paper", {"paper", "plane", "level0", "dda", "hiz"},
                 "Screen-space marcher: the strict hierarchical one, the strict one of slanted planes, the "
                 "exhaustive one in double precision, "
                 "the "
                 "linear one with a thickness, the hierarchical one with thickness and confidence."),
          choice("check", "none",
                 {label(HitCheck::none), label(HitCheck::triangle), label(HitCheck::continuity),
                  label(HitCheck::conservative), label(HitCheck::strict)},
                 "Check of the HITs after the march."),
          number("thickness", "m", 0.1, 1e-6, 1e9,
                 "How far behind a stored depth a ray may be and hit it (dda), or at what distance from the "
                 "surface "
                 "confidence reaches 0 (hiz)."),
          number("stride", "px", 1.0, 1.0, 1024.0, "Pixels between the samples of dda."),
          number("confidence", "", 0.1, 0.0, 1.0, "Least confidence of a HIT of hiz."),
          step_budget_parameter("Depth samples that one ray may read in paper, dda or hiz; 0: no limit."),
          footprint_factor_parameter(),
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
             key("check", "check of the HITs after the march"),
             key("thickness_m", "thickness; empty: the marcher has none", "m"),
             key("stride_px", "pixels between samples; empty: the marcher skips none", "px"),
             key("confidence", "least confidence of a HIT; empty: the marcher has none"),
             key("step_budget", "depth samples a ray may read; 0 = no limit"),
             key("footprint_factor", "k of the tolerance"),
         });
  add_verdict_columns(c);
  add(c,
      {
          share_of_rays("alpha_unchecked", none, "HITs before the check / rays"),
          share_of_rays("rejected_right_fraction", lower, "right HITs that the check rejected / rays"),
          share_of_rays("precision_own_depth", higher,
                        "precision where a HIT lies at the marcher's own depth instead of the pixel's plane"),
          samples_read("steps_per_ray", lower, "depth samples read in the march / rays"),
          samples_read("check_steps_per_hit", lower,
                       "samples of the neighbourhood pyramid read by the check / HITs before it"),
      });
  add_time(c, "march", "march of all rays; dda, hiz and level0 are scalar code, paper is in vector lanes");
  add_time(c, "neighbourhood", "neighbourhood pyramid of the check");
  add_time(c, "check", "check of all HITs, with a fresh copy of the verdicts");
  add_time(c, "paper_march", "march of the same rays by paper in vector lanes");
  add_ratio(c, "march_cost_ratio", "march_ms / paper_march_ms", lower);
  add_ratio(c, "checked_march_cost_ratio", "(march + neighbourhood + check) / paper_march_ms", lower);
  add_repeats(c);
  return c;
}

double memory_bytes(const Point& point) {
  constexpr double kPixel = 190.0;  // as `ssrm`, with another pyramid and normals, one list of hits fewer
  return kSceneBytes + kPixel * pixels_of(point);
}

// As in `ssrm`; a point of the same view as the one before it shares its frame and truth, which is not known
// here.
double cost_seconds(const Point& point, const SceneFacts& scene) {
  const double pixels = pixels_of(point);
  const double frame = (0.3e-6 + 0.02e-6 * std::log2(static_cast<double>(scene.triangles) + 2.0)) * pixels;
  const std::string& marcher = point.text("marcher");
  const double per_pixel = marcher == "level0" ? 0.7e-9 * width_of(point)
                           : marcher == "dda"  ? 0.5e-6
                                               : 0.15e-6;
  const double check = point.text("check") == "none" ? 0.0 : 0.2e-6;
  return frame +
         (static_cast<double>(point.integer("repeats")) + 2.0) * (per_pixel + check + 0.04e-6) * pixels;
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  return {scene_cost(point, scene)};
}

}  // namespace

const Experiment& ssrm_accuracy_experiment() {
  static const Experiment experiment{
      "ssrm_accuracy",
      "Strict and heuristic screen-space marchers on the same rays, and checks that turn doubtful HITs into "
      "UNKNOWN: alpha against false hits.",
      parameters(),
      columns(),
      ssrm_accuracy_parts::run,
      memory_bytes,
      cost_seconds,
      shared_costs};
  return experiment;
}

}  // namespace hybray
