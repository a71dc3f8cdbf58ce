#include "core/ssrm/next_bounce.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/base/ray_compaction.h"
#include "core/gbuffer/facing_surface.h"
#include "core/scene/curved_primitive.h"
#include "core/scene/surface_point.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

namespace hybray::ssrm {
namespace {

// Point of a primitive next to `p`.
dvec3 onto_primitive(const Scene& scene, uint32_t primitive, const dvec3& p) {
  if (!scene.is_triangle(primitive)) return moved_onto(scene, primitive, p);
  const dvec3 n = geometric_normal(scene, primitive), a(scene.positions[scene.triangles[primitive].x]);
  return p - glm::dot(p - a, n) * n;
}

// Shading normal of a primitive at a point on it.
dvec3 shading_normal_at(const Scene& scene, uint32_t primitive, const dvec3& p) {
  if (!scene.is_triangle(primitive)) return surface_point(scene, primitive, 0.0f, 0.0f, p).shading_normal;
  const uvec3& tri = scene.triangles[primitive];
  const dvec3 a(scene.positions[tri.x]), ab = dvec3(scene.positions[tri.y]) - a,
                                         ac = dvec3(scene.positions[tri.z]) - a;
  const dvec3 n = glm::cross(ab, ac);
  const double area = glm::dot(n, n);
  const double u = glm::dot(glm::cross(p - a, ac), n) / area, v = glm::dot(glm::cross(ab, p - a), n) / area;
  return surface_point(scene, primitive, static_cast<float>(u), static_cast<float>(v), p).shading_normal;
}

// The pixel that shows this point of a primitive, if there is one.
std::optional<uint32_t> pixel_that_shows(const GBuffer& g, const Scene& scene, uint32_t primitive,
                                         const dvec3& p) {
  const double w = g.view.view_depth(p);
  if (!(w >= g.view.near() && w <= g.view.far())) return {};
  const dvec2 at = g.view.project(p);
  if (!(at.x >= 0.0 && at.x < g.view.width() && at.y >= 0.0 && at.y < g.view.height())) return {};
  const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
  if (g.primitive(x, y) != primitive) return {};
  // Of a curved surface the pixel may show the near side and `p` lie on the far one.
  constexpr double kSameDepth = 1e-3;
  if (!scene.is_triangle(primitive) &&
      std::abs(g.view.view_depth_of(static_cast<double>(g.depth(x, y))) - w) > kSameDepth * w)
    return {};
  // Of a curve, its two sides may be nearer together than that.
  if (scene.is_curve(primitive) && glm::dot(outward_normal(scene, primitive, p), p - g.view.eye()) > 0.0)
    return {};
  return g.view.pixel_index(x, y);
}

// A ray that ends in the first comparison of its march.
void set_unmarched(ScreenRays& rays, size_t i) {
  rays.ox[i] = rays.oy[i] = 0.5f, rays.oz[i] = 0.0f;
  rays.dx[i] = rays.dy[i] = 1.0f, rays.dz[i] = 0.0f;
  rays.l_end[i] = -std::numeric_limits<float>::infinity();
  rays.end[i] = Verdict::offscreen;
}

}  // namespace

NextBounce next_bounce(const GBuffer& g, const Scene& scene, const DepthView& depth, const RayStream& rays,
                       const ScreenRays& screen_rays, const MarchResults& results, const HitStream& hits) {
  HYBRAY_CHECK_EQ(results.size(), rays.size());
  HYBRAY_CHECK_EQ(hits.size(), rays.size());
  NextBounce next;
  next.rays.resize(rays.size());
  std::vector<uint8_t> shown(rays.size(), 0);
  std::atomic<size_t> about_geometric{0};
  parallel_blocks(rays.size(), 4096, [&](size_t begin, size_t end) {
    size_t mine = 0;
    for (size_t i = begin; i < end; ++i) {
      const bool resolved = results.verdict[i] == Verdict::hit;
      const uint32_t primitive = resolved ? g.primitive[results.pixel[i]] : hits.primitive[i];
      if (primitive == kNoPrimitive) {
        next.rays.pixel[i] = kNoRay;
        continue;
      }
      const dvec3 direction(rays.direction(i));
      const double t = resolved ? plane_distance(depth, screen_rays, rays, g.view, i, results.pixel[i])
                                : static_cast<double>(hits.t[i]);
      const dvec3 p = onto_primitive(scene, primitive, dvec3(rays.origin(i)) + t * direction);
      const std::optional<uint32_t> pixel =
          resolved ? results.pixel[i] : pixel_that_shows(g, scene, primitive, p);
      const FacingSurface surface = facing_surface(
          scene, primitive, p,
          resolved ? dvec3(g.shading_normal[*pixel]) : shading_normal_at(scene, primitive, p), direction);
      const MirrorDirection mirror = mirror_direction(surface);
      next.rays.set(i, surface.origin, vec3(mirror.direction), pixel.value_or(0));
      shown[i] = pixel.has_value();
      mine += mirror.about_geometric;
    }
    about_geometric += mine;
  });
  remove_gaps(next.rays, shown);
  next.about_geometric_normal = about_geometric;
  next.screen_rays = project_rays(next.rays, g.view, scene.bounds);
  for (size_t i = 0; i < next.rays.size(); ++i) {
    if (shown[i]) continue;
    set_unmarched(next.screen_rays, i);
    ++next.unseen;
  }
  return next;
}

}  // namespace hybray::ssrm
