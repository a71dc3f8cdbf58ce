// What `ssrm_layers` can be asked and what it answers.
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/resolution.h"
#include "harness/experiments/ssrm_frame.h"
#include "harness/experiments/ssrm_layers.h"

#include <cmath>

namespace hybray {
namespace {

std::vector<Parameter> parameters() {
  using namespace parameter;
  std::vector<Parameter> p = ssrm_view_parameters();
  p.insert(
      p.end(),
      {
          integer("layers", "", 3, 1, 8, "Depth layers of each pixel."),
          number(
              "guard_band", "1", 0.1, 0.0, 0.5,
              "Pixels that the buffers reach beyond the screen on each side, as a share of its size; rounded "
              "up to whole tiles of 8."),
          choice(
              "free_space", "closed", {"any", "not_solids", "closed"},
              "Space between two layers that a ray may be in: any (naive), all but that between a front face "
              "and a back face, or that between a back face and a front face alone."),
          flag(
              "march_on", true,
              "A ray that a pixel's centre depth stopped, but that stays in front of its slanted plane, goes "
              "on; false: it is given up, as in the paper."),
          flag("confirm", true,
               "HITs of rays that the paper would have given up must meet a triangle that the pixel or its "
               "neighbours hold."),
          flag(
              "min_max", false,
              "Rays behind the first layer skip cells by the far bound of the first layer and the near bound "
              "of the others: the same results."),
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
  add(c,
      {
          key("layers", "depth layers of each pixel"),
          key("guard_band", "share of the size that the buffers reach beyond the screen on each side", "1"),
          key("free_space", "space between layers that counts as free"),
          key("march_on", "whether rays that stay in front of a slanted plane go on"),
          key("confirm", "whether later HITs must meet a triangle"),
          key("min_max", "whether rays behind the first layer skip cells"),
          counted("band_width_px", "pixels of the band on the left and on the right", "px"),
          counted("band_height_px", "pixels of the band above and below", "px"),
      });
  add_verdict_columns(c);
  add(c, {
             share_of_rays("single_alpha", none, "alpha of marcher `paper` in the same view without band"),
             share_of_rays("single_precision", none, "its precision"),
             share_of_rays("single_alpha_max", none, "its alpha_max"),
             share_of_rays("alpha_gain", higher, "alpha / single_alpha"),
             share_of_rays("further_hit_fraction", none, "HITs on layers beyond the first / HITs"),
             share_of_rays("further_precision", higher,
                           "right HITs on layers beyond the first / all HITs on them"),
             share_of_rays("band_hit_fraction", none, "HITs in the guard band / HITs"),
             share_of_rays("band_precision", higher, "right HITs in the guard band / all HITs in it"),
             samples_read("steps_per_ray", lower, "depths read, of every layer / rays"),
             samples_read("single_steps_per_ray", none, "the same of marcher `paper`"),
         });
  add_time(c, "gbuffer", "depth, derivatives and normals of the main view; outside the hybrid's time");
  add_time(c, "band", "first layer of the guard band");
  add_time(c, "layers", "further layers");
  add_time(c, "pyramid", "depth pyramid");
  add_time(c, "slots", "far and near bounds for min_max");
  add_time(c, "march", "SSRM on all rays");
  add_time(c, "single_march", "marcher `paper` on all rays, one layer, no band");
  add_time(c, "t_hw", "general tracer on all rays in its fastest mode");
  c.push_back(finding("hw_mode", "fastest mode of the general tracer for all rays, by measurement",
                      Comparison::none));
  add_time(c, "t_hybrid", "band, layers, pyramid, bounds, march, compaction, trace, write-back in one");
  add_time(c, "t_hybrid_static", "the same without band, layers and bounds, as if the frame had them anyway");
  add_time(c, "t_hybrid_single_layer", "the hybrid of marcher `paper`, one layer, no band");
  add_ratio(c, "speedup_over_single_layer", "t_hybrid_single_layer / t_hybrid");
  add_ratio(c, "speedup_measured", "T_HW / t_hybrid, both in their fastest modes");
  add_ratio(c, "speedup_static", "T_HW / t_hybrid_static");
  add_ratio(c, "speedup_single_layer", "T_HW / t_hybrid_single_layer");
  add(c,
      {
          follows_rays(
              {"buffer_bytes", "bytes", ColumnKind::metric, lower,
               "depth, derivatives, primitives and orientation of all layers with the band, and pyramids"}),
          follows_rays({"single_buffer_bytes", "bytes", ColumnKind::metric, none,
                        "the same of one layer without band"}),
      });
  add_repeats(c);
  return c;
}

// Pixels of all layers, guard band included.
double layer_pixels(const Point& point) {
  const auto size = *parse_resolution(point.text("resolution"));
  const double grown = 1.0 + 2.0 * point.number("guard_band");
  return grown * grown * (size.width + 16.0) * (size.height + 16.0) *
         static_cast<double>(point.integer("layers"));
}

double memory_bytes(const Point& point) {
  // The shared frame with truth as in `ssrm`; 16 bytes a pixel of each layer and its share of the pyramids.
  constexpr double kPixel = 190.0, kLayerPixel = 24.0;
  return kSceneBytes + kPixel * pixels_of(point) + kLayerPixel * layer_pixels(point);
}

// As measured on two cores, good to a factor of two.
double cost_seconds(const Point& point, const SceneFacts& scene) {
  const double pixels = pixels_of(point);
  const double depth = std::log2(static_cast<double>(scene.triangles) + 2.0);
  const double round = 0.06e-6 * depth * pixels + 0.5e-6 * pixels + 0.02e-6 * depth * layer_pixels(point);
  return 2e-6 * pixels + 0.08 * depth + round * (static_cast<double>(point.integer("repeats")) + 1.0);
}

std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  return {scene_cost(point, scene)};
}

}  // namespace

const Experiment& ssrm_layers_experiment() {
  static const Experiment experiment{
      "ssrm_layers",
      "Screen space ray marching over several depth layers with a guard band: what it "
      "resolves beyond one layer, how precisely, and at what cost.",
      parameters(),
      columns(),
      ssrm_layers_parts::run,
      memory_bytes,
      cost_seconds,
      shared_costs};
  return experiment;
}

}  // namespace hybray
