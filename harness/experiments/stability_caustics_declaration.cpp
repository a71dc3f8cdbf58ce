// What `stability_caustics` can be asked and what it answers.
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/stability_caustics.h"

#include <cmath>

namespace hybray {
namespace {

std::vector<Parameter> parameters() {
  using namespace parameter;
  return {
      choice(
          "body", "glass_slab",
          {"ball_lens", "glass_slab", "flat_water", "furnace", "sunlit_pool", "grazed_receiver", "sealed_box",
           "interface"},
          "What light goes through: the closed-form scenes of that name; still water under parallel light; "
          "a mirror's beam on a receiver; a lamp in a closed box of mirrors; or optics alone."),
      number("ior", "", 1.5, 1.0 + 1e-9, 1000.0, "Index of refraction of glass and water."),
      number("thickness", "m", 0.5, 1e-12, 2.0, "Of the glass slab."),
      number("incidence", "degrees", 0.0, 0.0, 89.999999,
             "Angle from the normal: of light on the sunlit pool, on the grazed receiver, on the interface."),
      number(
          "scale", "", 1.0, 1e-15, 1e10,
          "Of all lengths; applied first. Floats of the general tracer must hold products of three of them."),
      number("turn", "degrees", 0.0, -360.0, 360.0,
             "Rotation of everything about an axis along none of the coordinates; applied second."),
      number("offset", "m", 0.0, 0.0, 1e9, "Added to every coordinate of everything; applied last."),
      choice("origin", "world", {"world", "rebased"},
             "Where light is traced: at the place itself, or moved to the origin first."),
      choice("leaving_offset", "largest", {"largest", "along_normal"},
             "What decides how far off a surface a path goes on: the largest coordinate or edge, or their "
             "parts along the normal."),
      flag("robust", true, "Watertight traversal of the general tracer."),
      choice("emission", "map", {"map", "uniform"},
             "Light paths through the map's active texels, or everywhere."),
      integer("map_resolution", "texels", 128, 1, 16384,
              "Texels along one side of a light's map (of each cube face)."),
      number("rays_per_texel", "", 2.0, 1e-4, 1e6,
             "Light paths for each active texel on average; with emission: uniform, for each texel of a full "
             "map."),
      integer("mirror_depth", "", 32, 1, 1000, "Greatest number of specular events along a path."),
      integer("frames", "", 8, 2, 1024, "Independent frames, whose spread gives the standard errors."),
  };
}

std::vector<Column> columns() {
  using namespace column;
  using enum Better;
  // Another instruction set may send paths within rounding of an edge another way; where rounding decides
  // everything, all is free to change.
  constexpr Tolerance kShare{1e-3, 0.02}, kDirection{1e-6, 0.02}, kPaths{2.0, 0.01}, kRare{8.0, 0.2};
  const auto share_of = [&](const char* name, Better better, const char* text) {
    return within(kShare, fraction(name, better, text));
  };
  const auto error_of = [&](const char* name, const char* text) { return share_of(name, lower, text); };
  return {
      key("body", "what light goes through"),
      key("ior", "index of refraction"),
      key("thickness_m", "thickness of the slab", "m"),
      key("incidence_degrees", "angle of incidence from the normal", "degrees"),
      key("scale", "of all lengths"),
      key("turn_degrees", "rotation of everything", "degrees"),
      key("offset_m", "added to every coordinate", "m"),
      key("origin", "where light is traced"),
      key("leaving_offset", "what decides the offset off a surface"),
      key("robust", "watertight traversal"),
      key("emission", "where light paths leave"),
      key("map_resolution", "texels along one side of a map", "texels"),
      key("rays_per_texel", "light paths for each texel"),
      key("mirror_depth", "greatest number of specular events"),
      {"frames", "", ColumnKind::count, none, "independent frames", Comparison::identity},
      finding("refused",
              "why rounding left a scene that is none, such as a body that does not close; empty: it did not",
              Comparison::value),
      counted("collapsed_triangles", "triangles that rounding left without area"),
      within(kPaths, counted("paths", "light paths of one frame")),
      error_of("error_fraction", "largest |flux - exact flux| / exact flux of a region of the closed form"),
      {"error_standard_error_fraction", "1", ColumnKind::metric, none,
       "standard error of that flux, by the frames / exact flux: error_fraction is noise up to a few of it",
       Comparison::none},
      {"closed_form_z", "1", ColumnKind::metric, none,
       "greatest |flux - exact flux| of a region in standard errors, float positions included",
       Comparison::none},
      finding(
          "holds",
          "yes: every region is within 1 % by four standard errors; no: some region is beyond by as many; "
          "unclear: else",
          Comparison::none),
      share_of("lost_fraction", none, "1 - flux that arrived in the regions / exact flux; below 0: gained"),
      error_of("leaked_fraction", "flux that arrived or escaped where none can / emitted; of closed rooms"),
      error_of("wrong_medium_fraction",
               "flux that arrived in a medium other than the receiver's / all that arrived; first frame"),
      within(kRare,
             counted("medium_mismatches", "interfaces met from a medium other than theirs; all frames")),
      error_of("medium_mismatch_fraction", "the same / paths"),
      within(kRare, counted("self_intersections",
                            "segments that end where no straight line does: on the triangle that they start "
                            "from, or on the convex side of the analytic surface; first frame")),
      error_of("self_intersection_fraction", "the same / segments"),
      share_of("escaped_fraction", none, "flux that left the scene / emitted"),
      share_of("truncated_fraction", none, "flux cut off by mirror_depth / emitted"),
      within({1e-9, 0.0},
             fraction("ledger_residual_fraction", lower, "|emitted - all that became of it| / emitted")),
      counted("negative_or_nan",
              "photons with a flux that is negative, or with a number that is not finite; of the interface: "
              "reflectances outside [0, 1]"),
      error_of("splat_error_fraction",
               "|irradiance by splatting / exact - 1| of the middle of the grazed receiver"),
      {"splat_standard_error_fraction", "1", ColumnKind::metric, none, "standard error of that ratio",
       Comparison::none},
      error_of("photon_map_error_fraction", "the same by photon maps at 64 places"),
      {"photon_map_standard_error_fraction", "1", ColumnKind::metric, none, "standard error of that ratio",
       Comparison::none},
      error_of("reflectance_error_fraction",
               "greatest |reflectance / exact - 1| over 1024 attitudes of the interface"),
      error_of("transmittance_error_fraction", "the same of what goes through"),
      within(kDirection, {"reflected_direction_error_radians", "radians", ColumnKind::metric, lower,
                          "greatest angle between the reflected ray and the exact direction"}),
      within(kDirection, {"refracted_direction_error_radians", "radians", ColumnKind::metric, lower,
                          "the same of the refracted ray"}),
  };
}

// Light paths of one frame, at most: a full map of a point light has six faces.
double paths_of(const Point& point) {
  const double faces = point.text("body") == "sunlit_pool" || point.text("body") == "grazed_receiver" ? 1 : 6;
  return faces * std::pow(static_cast<double>(point.integer("map_resolution")), 2.0) *
         point.number("rays_per_texel");
}

double memory_bytes(const Point& point) {
  const double texels = std::pow(static_cast<double>(point.integer("map_resolution")), 2.0);
  return 2e8 + 6.0 * 24.0 * texels + 100.0 * std::min(caustics::kMostPathsOfPass, paths_of(point));
}

// As measured on two cores, good to a factor of two.
double cost_seconds(const Point& point, const SceneFacts&) {
  if (point.text("body") == "interface") return 0.01;
  const double bounces = point.text("body") == "sealed_box" ? 10.0 : 1.0;
  return 0.05 + 0.2e-6 * bounces * paths_of(point) * (static_cast<double>(point.integer("frames")) + 2.0);
}

}  // namespace

const Experiment& stability_caustics_experiment() {
  static const Experiment experiment{"stability_caustics",
                                     "Where light tracing breaks numerically: index of refraction, thin "
                                     "sheets, grazing incidence, scale and "
                                     "distance from the origin, against closed forms.",
                                     parameters(),
                                     columns(),
                                     stability_caustics_parts::run,
                                     memory_bytes,
                                     cost_seconds};
  return experiment;
}

}  // namespace hybray
