#include "core/scene/surface_point.h"

#include "core/scene/curved_primitive.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace {

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

SurfacePoint curved_point(const Scene& scene, uint32_t primitive, const dvec3& hit) {
  SurfacePoint p;
  p.primitive = primitive;
  p.position = moved_onto(scene, primitive, hit);
  p.geometric_normal = outward_normal(scene, primitive, p.position);
  p.shading_normal = p.geometric_normal;
  p.material = scene.material_of(primitive);
  p.offset = kSurfaceOffset * std::max(largest(p.position), extent(scene, primitive));
  return p;
}

}  // namespace

SurfacePoint surface_point(const Scene& scene, uint32_t primitive, float u, float v, const dvec3& hit) {
  if (!scene.is_triangle(primitive)) return curved_point(scene, primitive, hit);
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
  p.offset = kSurfaceOffset * std::max({largest(p.position), largest(ab), largest(ac)});
  return p;
}

dvec3 geometric_normal(const Scene& scene, uint32_t primitive, const dvec3& point) {
  return scene.is_triangle(primitive) ? geometric_normal(scene, primitive)
                                      : outward_normal(scene, primitive, point);
}

}  // namespace hybray
