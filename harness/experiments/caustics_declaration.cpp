// What `caustics` can be asked and what it answers. Exact definitions of the metrics: docs/metrics.md.
#include "harness/experiments/caustics.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/resolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybray {
namespace caustics_parts {
namespace {

using enum ParameterType;

Parameter number_of(const char* name, const char* unit, double standard, double least, double most,
                    const char* text) {
  return {name, number, unit, standard, least, most, {}, text};
}
Parameter integer_of(const char* name, const char* unit, int64_t standard, double least, double most,
                     const char* text) {
  return {name, integer, unit, standard, least, most, {}, text};
}
Parameter choice_of(const char* name, const char* standard, std::vector<std::string> choices,
                    const char* text) {
  return {name, choice, "", std::string(standard), {}, {}, std::move(choices), text};
}

// A metric and its 95 % interval.
void add_interval(std::vector<Column>& c, const std::string& name, Better better, const std::string& text) {
  c.push_back({name, "1", ColumnKind::metric, better, text});
  c.push_back(
      {name + "_low", "1", ColumnKind::metric, Better::none, "lower end of the 95 % interval of " + name});
  c.push_back(
      {name + "_high", "1", ColumnKind::metric, Better::none, "upper end of the 95 % interval of " + name});
}

}  // namespace

std::vector<Parameter> parameters() {
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
       std::string("1280x720"),
       1,
       16384,
       {},
       "Width and height of the main view."},
      number_of("near", "m", 0.05, 1e-9, 1e9, "Distance of the near plane."),
      {"caustics", boolean, "", true, {}, {}, {}, "false: the main view alone, without any caustic pass."},
      integer_of("map_resolution", "texels", 512, 1, 16384,
                 "Texels along one side of a light's map (of each cube face)."),
      number_of("rays_per_texel", "", 1.0, 1e-4, 1e6,
                "Light paths for each active texel of the maps on average; with emission: uniform, for each "
                "texel of a full map."),
      integer_of("mirror_depth", "", 3, 1, 64,
                 "Greatest number of specular events along a path, of light and camera alike."),
      integer_of("lights_visible", "", -1, -1, 1e6,
                 "Lights used of those that the camera sees, first ones first; -1: all."),
      integer_of("lights_invisible", "", -1, -1, 1e6,
                 "Lights used of those that the camera does not see; -1: all."),
      choice_of("emission", "map", {"map", "uniform"},
                "Light paths through the maps' active texels, or everywhere."),
      choice_of("first_surface", "stored", {"stored", "traced"},
                "First surface of a path: as the map stores it, or by one ray more."),
      choice_of("visibility", "depth", {"depth", "shadow"},
                "Whether the camera sees a deposit: by its depth buffer, or by a shadow ray."),
      choice_of("mixed", "backward", {"none", "backward", "forward"},
                "Caustics behind specular surfaces: by backward or forward photon maps, or left out."),
      number_of("gather_radius", "px", 2.0, 0.01, 1000.0,
                "Radius of the integration spheres, in pixels at their distance along the camera's path."),
      integer_of("camera_paths", "", 1, 1, 1024, "Camera paths of a pixel that sees a specular surface."),
      number_of("roulette_threshold", "", 0.25, 0.0, 1.0,
                "Share of its initial weight below which a path plays Russian roulette; 0: never."),
      choice_of("filter", "none", {"none", "wavelet"}, "Edge-avoiding wavelet filter of the caustics."),
      integer_of("frames", "", 8, 2, 1024, "Independent frames, over which errors are averaged."),
      number_of("reference_paths", "", 2e6, 0, 1e12,
                "Light paths of one batch of the reference; 0: no reference."),
      integer_of("reference_batches", "", 8, 2, 1024, "Independent batches of the reference."),
      number_of("reference_radius", "px", 1.5, 0.01, 1000.0,
                "Radius of the reference's integration spheres in its first pass."),
      integer_of("repeats", "", 7, 1, 1000, "Timed rounds after one that is not counted."),
      {"picture",
       boolean,
       "",
       false,
       {},
       {},
       {},
       "Write pictures: without caustics, with them, caustics alone, reference."},
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
      key("caustics", "whether caustics were made"),
      key("map_resolution", "texels along one side of a map", "texels"),
      key("rays_per_texel", "light paths for each texel"),
      key("mirror_depth", "greatest number of specular events"),
      key("lights_visible", "lights in use that the camera sees"),
      key("lights_invisible", "lights in use that the camera does not see"),
      key("emission", "where light paths leave"),
      key("first_surface", "how the first surface is found"),
      key("visibility", "how deposits are found visible"),
      key("mixed", "photon maps of mixed caustics"),
      key("gather_radius", "radius of the integration spheres", "px"),
      key("camera_paths", "camera paths of a pixel"),
      key("roulette_threshold", "share of the weight below which roulette is played"),
      key("filter", "filter"),
      counted("triangles", "triangles of the scene"),
      counted("frames", "independent frames"),
  };
  add_interval(c, "relmse", lower, "mean((x - r)^2 / (r^2 + e)) of one frame, mean over the frames");
  c.push_back({"relmse_debiased", "1", ColumnKind::metric, lower, "relmse less reference_relmse"});
  c.push_back({"reference_relmse", "1", ColumnKind::metric, none,
               "the reference's own, by its batches and the bias of its photon maps"});
  c.push_back({"reference_bias_relmse", "1", ColumnKind::metric, none,
               "part of it that is the bias of photon mapping"});
  c.push_back(
      {"at_floor", "", ColumnKind::key, none, "whether relmse is below three times the reference's own"});
  c.push_back({"rmse", "W/(sr m^2)", ColumnKind::metric, lower,
               "root of the mean squared error of one frame, mean over the frames"});
  c.push_back({"median_relative_error", "1", ColumnKind::metric, lower,
               "median over lit pixels of |x - r| / r, mean over the frames"});
  add_interval(c, "energy_ratio", none, "sum of the image / sum of the reference");
  c.push_back({"reference_rays", "1", ColumnKind::count, none, "rays of the reference"});
  c.push_back({"closed_form_error_fraction", "1", ColumnKind::metric, lower,
               "sum of |flux - exact flux| / sum of exact flux over the regions of the scene's closed form"});
  c.push_back({"closed_form_z", "1", ColumnKind::metric, none,
               "greatest |flux - exact flux| in standard errors of the frames"});
  c.push_back({"closed_form_standard_error_fraction", "1", ColumnKind::metric, none,
               "greatest relative standard error of a region"});
  c.push_back(counted("paths", "light paths of one frame"));
  c.push_back(counted("rays_traced", "rays of one frame, of light and camera paths"));
  c.push_back(counted("photons", "deposits of one frame"));
  c.push_back(counted("visibility_points", "points that camera paths of one frame left"));
  c.push_back(counted("photon_pairs", "photons in integration spheres, one frame"));
  c.push_back(
      fraction("texels_used_fraction", none, "active texels / texels of full maps of all lights in use"));
  c.push_back(
      fraction("texels_traced_fraction", lower, "texels that a ray was traced for / texels of full maps"));
  c.push_back(counted("lights_skipped", "lights in use that see no specular surface, or are dark"));
  c.push_back(counted("mixed_pixels_skipped",
                      "pixels that see no specular surface, for which no camera path was made"));
  c.push_back({"emitted_flux", "W", ColumnKind::metric, none,
               "sum of the initial weights, mean of the channels and frames"});
  c.push_back({"covered_flux", "W", ColumnKind::metric, none,
               "flux through the active texels, from their solid angles"});
  c.push_back(
      {"emitted_flux_z", "1", ColumnKind::metric, none, "their difference in standard errors of the frames"});
  c.push_back(fraction("deposited_fraction", none,
                       "flux that diffuse surfaces received after a specular event / emitted"));
  c.push_back(fraction("direct_fraction", none, "flux that they received before any / emitted"));
  c.push_back(fraction("absorbed_fraction", none, "flux absorbed by metals, tints and media / emitted"));
  c.push_back(fraction("escaped_fraction", none, "flux that left the scene / emitted"));
  c.push_back(fraction("truncated_fraction", lower, "flux cut off by mirror_depth / emitted"));
  c.push_back(fraction("roulette_fraction", none, "balance of the random choices / emitted"));
  c.push_back(fraction("ledger_residual_fraction", lower, "|emitted - all of the above| / emitted"));
  c.push_back(fraction("offscreen_fraction", none, "deposited flux outside the view / deposited"));
  c.push_back(fraction("depth_rejected_fraction", none, "deposited flux hidden from the camera / deposited"));
  c.push_back(
      fraction("missed_by_map_fraction", lower,
               "flux on pixels whose paths left where the map has probability zero; of uniform emission"));
  c.push_back(fraction("reference_missed_by_map_fraction", lower, "the same of the reference's paths"));
  c.push_back(counted("medium_mismatches", "interfaces met from a medium other than theirs"));
  c.push_back(fraction("accumulator_peak_fraction", lower, "greatest sum / what the accumulator holds"));
  c.push_back(counted("accumulator_overflows", "additions that did not fit: the image is wrong unless 0"));
  add_time(c, "gbuffer", "the plain main view");
  add_time(c, "map", "visibility maps of all lights");
  add_time(c, "emit_trace", "emission and tracing of the light paths");
  add_time(c, "splat", "deposit on pixels");
  add_time(c, "photonmap", "camera paths, acceleration structure and density estimation of mixed caustics");
  add_time(c, "filter", "filter");
  add_time(c, "total", "all of the caustic pass, measured as one");
  add_ratio(c, "main_view_ratio", "(main view + caustic pass) / main view", lower);
  c.push_back({"rays_per_second", "1/s", ColumnKind::time, higher, "rays of light paths / emit_trace_ms"});
  c.push_back({"efficiency", "1/s", ColumnKind::time, higher, "1 / (relmse * total seconds)"});
  c.push_back(counted("threads", "threads in use"));
  c.push_back(counted("repeats", "timed rounds"));
  return c;
}

double memory_bytes(const Point& point) {
  const auto size = *parse_resolution(point.text("resolution"));
  const double pixels = static_cast<double>(size.width) * size.height;
  // Buffers, accumulators and images of a frame; batches of the reference; maps, of which a light's are alive
  // at once; photons of a pass up to its limit.
  const double texels = std::pow(static_cast<double>(point.integer("map_resolution")), 2.0);
  const double batches =
      point.number("reference_paths") > 0.0 ? static_cast<double>(point.integer("reference_batches")) : 0.0;
  const double paths = std::min(caustics::kMostPathsOfPass, 6.0 * texels * point.number("rays_per_texel"));
  return 1.0e9 + pixels * (300.0 + 36.0 * batches) + 6.0 * 24.0 * texels + 100.0 * paths;
}

double cost_seconds(const Point& point) {
  const double frames = static_cast<double>(point.integer("frames") + 2 * point.integer("repeats"));
  const double texels = std::pow(static_cast<double>(point.integer("map_resolution")), 2.0);
  // On two cores about a microsecond a path; a tenth of a map is active in the scenes here.
  const double paths = 0.1 * texels * point.number("rays_per_texel");
  return 1e-6 * (frames * paths +
                 point.number("reference_paths") * static_cast<double>(point.integer("reference_batches")));
}

}  // namespace caustics_parts

const Experiment& caustics_experiment() {
  static const Experiment experiment{"caustics",
                                     "Caustics by light visibility maps, forward tracing and photon maps, "
                                     "against converged references and closed forms.",
                                     caustics_parts::parameters(),
                                     caustics_parts::columns(),
                                     caustics_parts::run,
                                     caustics_parts::memory_bytes,
                                     caustics_parts::cost_seconds};
  return experiment;
}

}  // namespace hybray
