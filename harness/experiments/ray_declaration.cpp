// Parameters and columns of the experiments on kinds of rays.
#include "core/base/parallel.h"
#include "harness/experiments/cells.h"
#include "harness/experiments/columns.h"
#include "harness/experiments/parameters.h"
#include "harness/experiments/ray_frame.h"

#include <bit>
#include <cmath>
#include <string>

namespace hybray {
namespace {

double rays_of(const Point& point) {
  const double pixels = pixels_of(point);
  return pixels * static_cast<double>(point.text("ray_kind") == "mirror" ? point.integer("mirror_depth")
                                                                         : point.integer("rays_per_pixel"));
}

}  // namespace

std::vector<Parameter> ray_parameters() {
  using namespace parameter;
  std::vector<Parameter> p = ssrm_view_parameters();
  p.insert(
      p.end(),
      {
          choice("ray_kind", "mirror", {"mirror", "rough", "ambient", "shadow"},
                 "Perfect reflections, GGX-sampled rough ones, short cosine-weighted occlusion rays, or rays "
                 "toward the lights."),
          number("roughness", "", 0.3, 0.0, 1.0,
                 "Roughness of rough reflections; GGX's alpha is its square."),
          integer("rays_per_pixel", "", 1, 1, 64, "Rays of each covered pixel; a mirror has one."),
          number("length", "m", 1.0, 1e-6, 1e6, "Length of ambient rays."),
          choice("light", "scene", {"scene", "sun"},
                 "Shadow rays go to the scene's lights, one picked for each ray, or to a sun."),
          number("sun_elevation", "degrees", 45.0, 0.0, 90.0, "Height of the sun above the horizon."),
          number("sun_azimuth", "degrees", 30.0, 0.0, 360.0, "Direction of the sun, from +x toward +z."),
          integer("mirror_depth", "", 1, 1, kMostBounces,
                  "Reflections along a path of mirror rays; others have one."),
          choice(
              "marcher", "paper", {"paper", "plane"},
              "Screen-space marcher: the paper's, or the one that takes pixels and cells as slanted planes."),
          choice(
              "march_code", "lanes", {"scalar", "lanes"},
              "Marcher as scalar code, or many rays at a time in vector lanes: the same results, less time."),
          footprint_factor_parameter(),
      });
  return p;
}

void add_ray_columns(std::vector<Column>& c) {
  using namespace column;
  using enum Better;
  add_view_columns(c);
  for (Column& column : c) {
    if (column.name == "rays") column.text = "rays, all bounces together";
    if (column.name == "geometric_mirror_rays")
      column.text = "rays made about the geometric normal instead of the shading normal";
  }
  add(c, {
             key("ray_kind", "mirror, rough, ambient or shadow"),
             key("roughness", "roughness of rough reflections; empty for other kinds"),
             key("rays_per_pixel", "rays made for each covered pixel"),
             key("length_m", "length of ambient rays; empty for other kinds", "m"),
             key("light", "what shadow rays go to; empty for other kinds"),
             key("sun_elevation_degrees", "height of the sun, where there is one", "degrees"),
             key("sun_azimuth_degrees", "direction of the sun, where there is one", "degrees"),
             key("mirror_depth", "reflections along a path"),
             key("marcher", "screen-space marcher"),
             key("march_code", "scalar code or vector lanes"),
             key("footprint_factor", "k of the tolerance"),
             follows_rays(counted("rays_skipped",
                                  "rays that could not leave their surface, or do not reach their light")),
             share_of_rays("unseen_fraction", none,
                           "rays that start at a point the view does not show, and are not marched / rays"),
             share_of_rays("truly_hit_fraction", none,
                           "rays that truly hit something (within their length) / rays"),
         });
  add_verdict_columns(c);
  for (int b = 1; b <= kMostBounces; ++b) {
    const std::string n = std::to_string(b);
    Column rays = counted("", "");
    rays.name = "rays_bounce_" + n, rays.text = "rays of bounce " + n;
    Column alpha = share_of_rays("", higher, "");
    alpha.name = "alpha_bounce_" + n, alpha.text = "HIT / rays of bounce " + n;
    Column precision = share_of_rays("", higher, "");
    precision.name = "precision_bounce_" + n, precision.text = "right HITs / HITs of bounce " + n;
    add(c, {follows_rays(rays), alpha, precision});
  }
  c.push_back(samples_read("steps_per_ray", lower, "depth samples read / rays"));
}

void add_ray_cells(Row& row, const Point& point, const SsrmSetup& setup, const RayFrame& f) {
  for (const char* name :
       {"scene", "camera", "depth_convention", "derivatives", "ray_kind", "marcher", "march_code"})
    row[name] = point.text(name);
  row["width"] = int64_t{setup.view.width()};
  row["height"] = int64_t{setup.view.height()};
  row["near_m"] = setup.view.near();
  row["far_m"] = setup.view.far();
  row["triangles"] = static_cast<int64_t>(setup.scene.triangle_count());
  row["rays"] = static_cast<int64_t>(f.rays);
  row["geometric_mirror_rays"] = static_cast<int64_t>(f.about_geometric_normal);
  row["paths_skipped"] = static_cast<int64_t>(f.gbuffer.depth.size() - f.gbuffer.covered_pixels);
  row["buffers_skipped"] = int64_t{kGBufferKinds - std::popcount(setup.bits)};
  row["threads"] = int64_t{thread_count()};
  row["footprint_factor"] = point.number("footprint_factor");
  row["rays_per_pixel"] = f.kind == RayKind::mirror ? int64_t{1} : point.integer("rays_per_pixel");
  row["mirror_depth"] = f.kind == RayKind::mirror ? point.integer("mirror_depth") : int64_t{1};
  if (f.kind == RayKind::rough) row["roughness"] = point.number("roughness");
  if (f.kind == RayKind::ambient) row["length_m"] = point.number("length");
  if (f.kind == RayKind::shadow) {
    row["light"] = point.text("light");
    if (point.text("light") == "sun") {
      row["sun_elevation_degrees"] = point.number("sun_elevation");
      row["sun_azimuth_degrees"] = point.number("sun_azimuth");
    }
  }
  row["rays_skipped"] = static_cast<int64_t>(f.rays_skipped);
  row["unseen_fraction"] = share(f.unseen, f.rays);
  row["truly_hit_fraction"] = share(f.truly_hit, f.rays);
  add_verdict_cells(row, f.table);
  if (f.occlusion())  // these ask where the hit lies
    for (const char* name : {"precision_loose", "recall", "alpha_max", "early_fraction", "through_fraction"})
      row[name] = std::monostate{};
  for (size_t b = 0; b < f.bounces.size(); ++b) {
    const metrics::VerdictTable& t = f.bounces[b].table;
    const std::string n = std::to_string(b + 1);
    row["rays_bounce_" + n] = static_cast<int64_t>(t.rays);
    row["alpha_bounce_" + n] = share(t.hits(), t.rays);
    row["precision_bounce_" + n] = share(t.right, t.hits());
  }
  row["steps_per_ray"] = share(f.steps, f.rays);
}

double ray_memory_bytes(const Point& point) {
  // A ray with its screen ray, length, verdicts (twice while it is timed), truth, answer and place in the
  // lists; a pixel of the geometry buffers and the pyramid; the largest known scene with both acceleration
  // structures.
  constexpr double kRay = 110.0, kPixel = 40.0;
  return kSceneBytes + kPixel * pixels_of(point) + kRay * rays_of(point);
}

double ray_frame_seconds(const Point& point) {
  return 0.2e-6 * pixels_of(point) + 0.7e-6 * rays_of(point);
}

double ray_round_seconds(const Point& point, const SceneFacts& scene, double passes) {
  return 0.004e-6 * passes * std::log2(static_cast<double>(scene.triangles) + 2.0) * rays_of(point);
}

}  // namespace hybray
