#include "core/scene/surface_point.h"

#include "core/scene/curved_primitive.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace {

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Smallest radius of curvature.
double curvature_radius(const AnalyticSurface& surface) {
  return surface.kind == AnalyticSurface::Kind::paraboloid ? 2.0 * std::abs(surface.focal_length)
                                                           : surface.radius;
}

SurfacePoint curved_point(const Scene& scene, uint32_t primitive, const dvec3& hit, LeavingOffset leaving) {
  SurfacePoint p;
  p.primitive = primitive;
  p.position = moved_onto(scene, primitive, hit);
  p.geometric_normal = outward_normal(scene, primitive, p.position);
  p.shading_normal = p.geometric_normal;
  p.material = scene.material_of(primitive);
  const double all = std::max(largest(p.position), extent(scene, primitive));
  p.offset = kSurfaceOffset * all;
  if (leaving == LeavingOffset::along_normal && scene.is_analytic(primitive)) {
    // Rounding along the surface by e leaves it by e^2 / (2 r); e is at most 2^-24 sqrt(3) of a coordinate.
    const double bend = 0x1p-25 * all * all / curvature_radius(scene.analytic_surface(primitive));
    p.offset = kNormalOffset * std::max(glm::dot(glm::abs(p.geometric_normal), glm::abs(p.position)) + bend,
                                        kLeastOfPosition * all);
  }
  return p;
}

}  // namespace

double leaving_offset(const dvec3& position, const dvec3& normal, const dvec3& reach, LeavingOffset leaving) {
  if (leaving == LeavingOffset::largest) return kSurfaceOffset * std::max(largest(position), largest(reach));
  const dvec3 n = glm::abs(normal);
  return kNormalOffset * std::max({glm::dot(n, glm::abs(position)), glm::dot(n, reach),
                                   kLeastOfEdge * largest(reach), kLeastOfPosition * largest(position)});
}

SurfacePoint surface_point(const Scene& scene, uint32_t primitive, float u, float v, const dvec3& hit,
                           LeavingOffset leaving) {
  if (!scene.is_triangle(primitive)) return curved_point(scene, primitive, hit, leaving);
  const uvec3& tri = scene.triangles[primitive];
  const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
  const dvec3 ab = b - a, ac = c - a;
  SurfacePoint p;
  p.primitive = primitive;
  p.position = a + static_cast<double>(u) * ab + static_cast<double>(v) * ac;
  p.geometric_normal = glm::normalize(glm::cross(ab, ac));
  const vec3 n = (1.0f - u - v) * scene.normals[tri.x] + u * scene.normals[tri.y] + v * scene.normals[tri.z];
  const float length = glm::length(n);
  // Opposite vertex normals can cancel: the triangle's own normal is then the only one there is.
  p.shading_normal = length > 1e-6f ? dvec3(n * (1.0f / length)) : p.geometric_normal;
  p.material = scene.triangle_material[primitive];
  p.offset = leaving_offset(p.position, p.geometric_normal, glm::max(glm::abs(ab), glm::abs(ac)), leaving);
  return p;
}

dvec3 geometric_normal(const Scene& scene, uint32_t primitive, const dvec3& point) {
  return scene.is_triangle(primitive) ? geometric_normal(scene, primitive)
                                      : outward_normal(scene, primitive, point);
}

}  // namespace hybray
