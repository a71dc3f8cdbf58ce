// What `caustics` can be asked and what it answers. Exact definitions of the metrics: docs/metrics.md.
#include "harness/experiments/caustics.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/resolution.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace caustics_parts {
namespace {

// What another instruction set may change. The general tracer's answers differ in their last bits then: a
// path within rounding of an edge goes another way, and where a texel of a map comes or goes, all paths after
// it draw other numbers. Embree held to SSE4.2, AVX and AVX2 moved configs/caustics_quickstart.json against
// AVX-512 by at most 0.6 of each of these.
constexpr Tolerance kRelmse{0.0, 0.5};  // hangs on the few photons that land where it is dark
constexpr Tolerance kError{0.0, 0.03};  // any other error of an image
constexpr Tolerance kStops{0.02, 0.0};
constexpr Tolerance kTexels{1e-4, 0.0};  // shares of the maps
constexpr Tolerance kFlux{0.0, 1e-3};
constexpr Tolerance kShareOfFlux{1e-3, 0.0};
constexpr Tolerance kMissed{3e-3, 0.0};    // the little that a map misses
constexpr Tolerance kRounding{1e-9, 0.0};  // differences that are nothing but rounding
constexpr Tolerance kPaths{2.0, 0.01};     // numbers of paths, and of what they leave
constexpr Tolerance kPeak{0.0, 0.1};
constexpr Tolerance kStandardError{0.0, 0.01};

Column flux_share(const char* name, Better better, const char* text) {
  return column::within(kShareOfFlux, column::fraction(name, better, text));
}
Column path_count(const char* name, const char* text) {
  return column::within(kPaths, column::counted(name, text));
}
// A deviation in standard errors, which says how likely it is: another draw has another. Bounds hold it.
Column deviation(const char* name, const char* text) {
  return {name, "1", ColumnKind::metric, Better::none, text, Comparison::none};
}

double megapixels_of(const Point& point) {
  const auto size = *parse_resolution(point.text("resolution"));
  return 1e-6 * size.width * size.height;
}

// Which lights a camera sees is not known here: half of them, where all of one kind are used.
double lights_in_use(const Point& point, const SceneFacts& scene) {
  const auto all = static_cast<double>(scene.lights);
  const auto asked = [&](const char* parameter) {
    const auto count = static_cast<double>(point.integer(parameter));
    return count < 0.0 ? 0.5 * all : count;
  };
  return std::min(all, asked("lights_visible") + asked("lights_invisible"));
}

}  // namespace

std::vector<Parameter> parameters() {
  using namespace parameter;
  return {
      scene(),
      camera(),
      resolution("1280x720"),
      near_plane(0.05),
      flag("caustics", true, "false: the main view alone, without any caustic pass."),
      integer("map_resolution", "texels", 512, 1, 16384,
              "Texels along one side of a light's map (of each cube face)."),
      number("rays_per_texel", "", 1.0, 1e-4, 1e6,
             "Light paths for each active texel of the maps on average; with emission: uniform, for each "
             "texel of a full map."),
      integer("mirror_depth", "", 3, 1, 64,
              "Greatest number of specular events along a path, of light and camera alike."),
      integer("lights_visible", "", -1, -1, 1e6,
              "Lights used of those that the camera sees, first ones first; -1: all."),
      integer("lights_invisible", "", -1, -1, 1e6,
              "Lights used of those that the camera does not see; -1: all."),
      choice("emission", "map", {"map", "uniform"},
             "Light paths through the maps' active texels, or everywhere."),
      choice("first_surface", "stored", {"stored", "traced"},
             "First surface of a path: as the map stores it, or by one ray more."),
      choice("visibility", "depth", {"depth", "shadow"},
             "Whether the camera sees a deposit: by its depth buffer, or by a shadow ray."),
      choice("mixed", "backward", {"none", "backward", "forward"},
             "Caustics behind specular surfaces: by backward or forward photon maps, or left out."),
      number("gather_radius", "px", 2.0, 0.01, 1000.0,
             "Radius of the integration spheres, in pixels at their distance along the camera's path."),
      integer("camera_paths", "", 1, 1, 1024, "Camera paths of a pixel that sees a specular surface."),
      number("roulette_threshold", "", 0.25, 0.0, 1.0,
             "Share of its initial weight below which a path plays Russian roulette; 0: never."),
      choice("filter", "none", {"none", "wavelet"}, "Edge-avoiding wavelet filter of the caustics."),
      integer("frames", "", 8, 2, 1024, "Independent frames, over which errors are averaged."),
      number("reference_paths", "", 2e6, 0, 1e12,
             "Light paths of one batch of the reference; 0: no reference."),
      integer("reference_batches", "", 8, 2, 1024, "Independent batches of the reference."),
      number(
          "reference_relmse_target", "", 0.0, 0.0, 1e12,
          "Own relMSE at which the reference is good enough with fewer batches than reference_batches; 0: it "
          "always has all of them."),
      number("reference_radius", "px", 1.5, 0.01, 1000.0,
             "Radius of the reference's integration spheres in its first pass."),
      repeats(),
      flag("picture", false,
           "Write pictures: without caustics, with them, caustics alone, reference, error map of HDR-FLIP."),
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
      {"frames", "", ColumnKind::count, none, "independent frames", Comparison::identity},
  };
  const auto add = [&](const Tolerance& tolerance, const Column& column) {
    c.push_back(within(tolerance, column));
  };
  add_interval(c, "relmse", ColumnKind::metric, lower,
               "mean((x - r)^2 / (r^2 + e)) of one frame, mean over the frames", kRelmse);
  // Compared are the two that it follows from: near the floor they differ by little.
  c.push_back(
      {"relmse_debiased", "1", ColumnKind::metric, lower, "relmse less reference_relmse", Comparison::none});
  add(kRelmse, {"reference_relmse", "1", ColumnKind::metric, none,
                "the reference's own, by its batches and the bias of its photon maps"});
  add(kRelmse, {"reference_bias_relmse", "1", ColumnKind::metric, none,
                "part of it that is the bias of photon mapping"});
  c.push_back(
      finding("at_floor", "whether relmse is below three times the reference's own", Comparison::value));
  add(kError, {"rmse", "W/(sr m^2)", ColumnKind::metric, lower,
               "root of the mean squared error of one frame, mean over the frames"});
  add(kError, {"smape", "1", ColumnKind::metric, lower,
               "mean of |x - r| / (x + r) of one frame, 0 where both are black; mean over the frames"});
  add(kError, {"median_relative_error", "1", ColumnKind::metric, lower,
               "median over lit pixels of |x - r| / r, mean over the frames"});
  add(kError, {"psnr", "dB", ColumnKind::metric, higher,
               "peak signal-to-noise ratio on a display at the middle exposure, mean over the frames"});
  add(kError, {"ssim", "1", ColumnKind::metric, higher,
               "structural similarity on a display at the middle exposure, mean over the frames"});
  add(kError, {"flip", "1", ColumnKind::metric, lower, "mean of HDR-FLIP's error map of the first frame"});
  add(kStops, {"flip_exposure_start", "stops", ColumnKind::metric, none,
               "lowest exposure of HDR-FLIP, fixed by the reference"});
  add(kStops, {"flip_exposure_stop", "stops", ColumnKind::metric, none,
               "highest exposure of HDR-FLIP, fixed by the reference"});
  add_interval(c, "energy_ratio", ColumnKind::metric, none, "sum of the image / sum of the reference",
               kError);
  c.push_back({"reference_batches", "1", ColumnKind::count, none, "independent batches of the reference"});
  add(kPaths, {"reference_rays", "1", ColumnKind::count, none, "rays of the reference"});
  add(kShareOfFlux,
      {"closed_form_error_fraction", "1", ColumnKind::metric, lower,
       "sum of |flux - exact flux| / sum of exact flux over the regions of the scene's closed form"});
  c.push_back(deviation("closed_form_z", "greatest |flux - exact flux| in standard errors of the frames"));
  add(kStandardError, {"closed_form_standard_error_fraction", "1", ColumnKind::metric, none,
                       "greatest relative standard error of a region"});
  c.push_back(path_count("paths", "light paths of one frame"));
  c.push_back(path_count("rays_traced", "rays of one frame, of light and camera paths"));
  c.push_back(path_count("photons", "deposits of one frame"));
  c.push_back(path_count("visibility_points", "points that camera paths of one frame left"));
  c.push_back(path_count("photon_pairs", "photons in integration spheres, one frame"));
  add(kTexels,
      fraction("texels_used_fraction", none, "active texels / texels of full maps of all lights in use"));
  add(kTexels,
      fraction("texels_traced_fraction", lower, "texels that a ray was traced for / texels of full maps"));
  c.push_back(counted("lights_skipped", "lights in use that see no specular surface, or are dark"));
  c.push_back(path_count("mixed_pixels_skipped",
                         "pixels that see no specular surface, for which no camera path was made"));
  add(kFlux, {"emitted_flux", "W", ColumnKind::metric, none,
              "sum of the initial weights, mean of the channels and frames"});
  add(kFlux, {"covered_flux", "W", ColumnKind::metric, none,
              "flux through the active texels, from their solid angles"});
  c.push_back(deviation("emitted_flux_z", "their difference in standard errors of the frames"));
  c.push_back(flux_share("deposited_fraction", none,
                         "flux that diffuse surfaces received after a specular event / emitted"));
  c.push_back(flux_share("direct_fraction", none, "flux that they received before any / emitted"));
  c.push_back(flux_share("absorbed_fraction", none, "flux absorbed by metals, tints and media / emitted"));
  c.push_back(flux_share("escaped_fraction", none, "flux that left the scene / emitted"));
  c.push_back(flux_share("truncated_fraction", lower, "flux cut off by mirror_depth / emitted"));
  c.push_back(flux_share("roulette_fraction", none, "balance of the random choices / emitted"));
  add(kRounding, fraction("ledger_residual_fraction", lower, "|emitted - all of the above| / emitted"));
  c.push_back(flux_share("offscreen_fraction", none, "deposited flux outside the view / deposited"));
  c.push_back(
      flux_share("depth_rejected_fraction", none, "deposited flux hidden from the camera / deposited"));
  add(kMissed,
      fraction("missed_by_map_fraction", lower,
               "flux on pixels whose paths left where the map has probability zero; of uniform emission"));
  add(kMissed, fraction("reference_missed_by_map_fraction", lower, "the same of the reference's paths"));
  c.push_back(path_count("medium_mismatches", "interfaces met from a medium other than theirs"));
  add(kPeak, fraction("accumulator_peak_fraction", lower, "greatest sum / what the accumulator holds"));
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
  add_threads(c);
  add_repeats(c);
  return c;
}

double memory_bytes(const Point& point) {
  const auto size = *parse_resolution(point.text("resolution"));
  const double pixels = static_cast<double>(size.width) * size.height;
  // Buffers, accumulators and images of a frame; the planes of HDR-FLIP; batches of the reference; maps, of
  // which a light's are alive at once; photons of a pass up to its limit.
  const double texels = std::pow(static_cast<double>(point.integer("map_resolution")), 2.0);
  const double batches =
      point.number("reference_paths") > 0.0 ? static_cast<double>(point.integer("reference_batches")) : 0.0;
  const double paths = std::min(caustics::kMostPathsOfPass, 6.0 * texels * point.number("rays_per_texel"));
  return 1.0e9 + pixels * (300.0 + (batches > 0.0 ? 150.0 : 0.0) + 36.0 * batches) + 6.0 * 24.0 * texels +
         100.0 * paths;
}

// Costs were measured as processor time on two cores; the sum over a config is good to a factor of two, a
// single point is not: how many pixels need camera paths, and how far light paths go, depends on the scene.
double cost_seconds(const Point& point, const SceneFacts& scene) {
  const double megapixels = megapixels_of(point);
  const double rounds = static_cast<double>(point.integer("repeats")) + 1.0;
  const double main_view = 0.03 * megapixels;
  const double pictures = point.boolean("picture") ? 0.5 * megapixels : 0.0;
  if (!point.boolean("caustics")) return main_view * (1.0 + rounds) + pictures;

  const double full_map = 6.0 * std::pow(static_cast<double>(point.integer("map_resolution")), 2.0);
  const double lights = lights_in_use(point, scene);
  const double active =
      full_map * scene.specular_share * lights / std::max(1.0, static_cast<double>(scene.lights));
  const double maps = 0.15e-6 * active;
  const double paths =
      point.number("rays_per_texel") * (point.text("emission") == "uniform" ? full_map * lights : active);
  const double filter = point.text("filter") == "none" ? 0.0 : 0.3 * megapixels;
  const bool mixed = point.text("mixed") != "none";
  const double frame = (mixed ? 0.2e-6 : 0.08e-6) * paths + (mixed ? 0.07 : 0.03) * megapixels + filter;
  const bool compared = point.number("reference_paths") > 0.0;
  const double errors = compared ? 0.15 * megapixels : 0.0;  // SSIM most of all
  const double flip = compared ? 1.3 * megapixels : 0.0;     // of the first frame, at about ten exposures
  return main_view + maps + static_cast<double>(point.integer("frames")) * (frame + errors) +
         rounds * (3.0 * (frame + maps) + 2.0 * main_view) + flip + pictures;
}

// The scene, and the reference of a view and its lights.
std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene) {
  const std::string& name = point.text("scene");
  std::vector<SharedCost> costs{{"scene " + name, 0.1 + 1.2e-6 * static_cast<double>(scene.triangles)}};
  const double paths = point.number("reference_paths");
  if (paths > 0.0 && point.boolean("caustics")) {
    std::string key = "reference " + name;
    for (const char* parameter : {"camera", "resolution", "near", "lights_visible", "lights_invisible",
                                  "reference_paths", "reference_batches", "reference_radius"})
      key += " " + to_text(point.parameters.at(parameter));
    key += point.text("mixed") == "none" ? " direct" : " mixed";
    const auto batches = static_cast<double>(point.integer("reference_batches"));
    costs.push_back({key, batches * (0.5e-6 * paths + 0.45 * megapixels_of(point))});
  }
  return costs;
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
                                     caustics_parts::cost_seconds,
                                     caustics_parts::shared_costs};
  return experiment;
}

}  // namespace hybray
