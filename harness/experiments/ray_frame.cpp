#include "harness/experiments/ray_frame.h"

#include "core/base/error.h"
#include "core/metrics/occlusion_verdicts.h"
#include "core/ssrm/hybrid.h"
#include "core/ssrm/next_bounce.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

namespace hybray {
namespace {

RayKind kind_of(const Point& point) {
  const std::string& name = point.text("ray_kind");
  return name == "rough"     ? RayKind::rough
         : name == "ambient" ? RayKind::ambient
         : name == "shadow"  ? RayKind::shadow
                             : RayKind::mirror;
}

dvec3 toward_sun(const Point& point) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double e = kDegree * point.number("sun_elevation"), a = kDegree * point.number("sun_azimuth");
  return {std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)};
}

PixelRaySettings ray_settings(const Point& point, const Scene& scene, uint64_t seed) {
  PixelRaySettings s;
  s.kind = kind_of(point);
  s.rays_per_pixel = static_cast<int>(point.integer("rays_per_pixel"));
  s.roughness = point.number("roughness");
  s.length = point.number("length");
  if (point.text("light") == "sun") s.to_sun = toward_sun(point);
  s.seed = seed;
  if (s.kind == RayKind::shadow && s.to_sun == dvec3(0.0) && scene.lights.empty())
    throw InputError("scene " + scene.name, "it has no light for shadow rays; give \"light\": \"sun\"");
  return s;
}

}  // namespace

RayFrame::RayFrame(const Point& point, const SsrmSetup& setup, uint64_t seed)
    : gbuffer(setup.make_buffers()), pyramid(pyramid_of(gbuffer)), kind(kind_of(point)) {
  march.code = point.text("march_code") == "lanes" ? ssrm::MarchCode::lanes : ssrm::MarchCode::scalar;
  if (point.text("marcher") == "plane") {
    march.marcher = ssrm::Marcher::plane;
    slanted.emplace(setup.view.width(), setup.view.height());
    slanted->build(gbuffer.depth, gbuffer.depth_derivatives, setup.view.depth_sign(),
                   setup.view.background_depth());
  }
  PixelRays first = make_pixel_rays(gbuffer, setup.scene, ray_settings(point, setup.scene, seed));
  about_geometric_normal = first.about_geometric_normal;
  rays_skipped = first.skipped;
  const int depth_wanted = kind == RayKind::mirror ? static_cast<int>(point.integer("mirror_depth")) : 1;
  RayBounce next;
  next.rays = std::move(first.rays), next.lengths = std::move(first.lengths);
  next.screen_rays = ssrm::project_rays(next.rays, setup.view, setup.scene.bounds, next.lengths);
  for (int bounce = 0; bounce < depth_wanted; ++bounce) {
    RayBounce& b = bounces.emplace_back(std::move(next));
    b.results.resize(b.rays.size());
    ssrm::march(depth(), b.screen_rays, b.rays.pixel, march, b.results);
    ssrm::compact_unresolved(b.results, b.unresolved);
    const truth::RayTruth truth = truth::trace_truth(setup.robust, b.rays, setup.view, b.lengths);
    b.table = occlusion() ? metrics::judge_occlusion(b.results, truth, &b.classes)
                          : metrics::judge(b.results, depth(), b.screen_rays, b.rays, truth, gbuffer,
                                           setup.scene, {point.number("footprint_factor")}, &b.classes);
    table = bounce == 0 ? b.table : metrics::sum(table, b.table);
    rays += b.rays.size(), unresolved += b.unresolved.size(), steps += b.results.steps;
    for (uint32_t primitive : truth.hits.primitive) truly_hit += primitive != kNoPrimitive;
    if (bounce + 1 == depth_wanted) break;
    ssrm::NextBounce reflected =
        ssrm::next_bounce(gbuffer, setup.scene, depth(), b.rays, b.screen_rays, b.results, truth.hits);
    next = {};
    next.rays = std::move(reflected.rays), next.screen_rays = std::move(reflected.screen_rays);
    next.unseen = reflected.unseen;
    about_geometric_normal += reflected.about_geometric_normal;
    unseen += reflected.unseen;
  }
}

const RayFrame& shared_ray_frame(const Point& point, Workspace& workspace, const SsrmSetup& setup) {
  std::string key;
  for (const Parameter& p : ray_parameters()) key += to_text(point.parameters.at(p.name)) + ' ';
  return workspace.newest<RayFrame>(point.text("scene"), "ray frame", key, [&] {
    return std::make_shared<RayFrame>(point, setup, workspace.settings().seed);
  });
}

}  // namespace hybray
