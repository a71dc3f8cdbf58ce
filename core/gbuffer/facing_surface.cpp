#include "core/gbuffer/facing_surface.h"

#include "core/gbuffer/triangle_plane.h"
#include "core/scene/curved_primitive.h"
#include "core/scene/surface_point.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace {

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// What the rounding of an intersection with a primitive at point p grows with: the largest of the coordinates
// of p and of its distances to the triangle's vertices, or the size of the analytic surface or curve.
double rounding_scale(const Scene& scene, uint32_t primitive, const dvec3& p) {
  if (!scene.is_triangle(primitive)) return std::max(largest(p), extent(scene, primitive));
  double scale = largest(p);
  const uvec3& tri = scene.triangles[primitive];
  for (uint32_t v : {tri.x, tri.y, tri.z}) scale = std::max(scale, largest(dvec3(scene.positions[v]) - p));
  return scale;
}

}  // namespace

FacingSurface facing_surface(const Scene& scene, uint32_t primitive, const dvec3& point,
                             const dvec3& shading_normal, const dvec3& incoming) {
  dvec3 ng = geometric_normal(scene, primitive, point), ns = shading_normal;
  if (glm::dot(ng, incoming) > 0.0) ng = -ng, ns = -ns;
  return {point, incoming, ng, ns, vec3(point + ng * (rounding_scale(scene, primitive, point) * 0x1p-19))};
}

FacingSurface seen_surface(const GBuffer& g, const Scene& scene, int x, int y) {
  const uint32_t primitive = g.primitive(x, y);
  return facing_surface(scene, primitive, seen_point(g.view, scene, primitive, x + 0.5, y + 0.5),
                        dvec3(g.shading_normal(x, y)),
                        glm::normalize(g.view.ray_direction(x + 0.5, y + 0.5)));
}

MirrorDirection mirror_direction(const FacingSurface& s) {
  const auto mirror = [&](const dvec3& n) { return s.incoming - 2.0 * glm::dot(s.incoming, n) * n; };
  dvec3 direction = mirror(s.shading);
  const bool wrong_side = glm::dot(s.incoming, s.shading) >= 0.0 || glm::dot(direction, s.geometric) <= 0.0;
  if (wrong_side) direction = mirror(s.geometric);
  return {glm::normalize(direction), wrong_side};
}

}  // namespace hybray
