#include "core/gbuffer/triangle_plane.h"

#include "core/scene/curved_primitive.h"

#include <cmath>

namespace hybray {
namespace {

// Of the plane through `point` with normal n (any length).
TrianglePlane plane_through(const View& view, const dvec3& point, const dvec3& n, double px, double py) {
  const double distance = glm::dot(n, point - view.eye());
  const double per_pixel = 1.0 / (distance * view.focal());
  return {glm::dot(n, view.ray_direction(px, py)) / distance, glm::dot(n, view.right()) * per_pixel,
          glm::dot(n, view.down()) * per_pixel};
}

std::optional<double> seen_depth(const View& view, const Scene& scene, uint32_t primitive, const dvec3& ray) {
  return nearest_hit(scene, primitive, view.eye(), ray, view.near(), view.far());
}

}  // namespace

TrianglePlane triangle_plane(const View& view, const Scene& scene, uint32_t triangle, double px, double py) {
  const uvec3& tri = scene.triangles[triangle];
  const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
  return plane_through(view, a, glm::cross(b - a, c - a), px, py);
}

TrianglePlane tangent_plane(const View& view, const Scene& scene, uint32_t primitive, double px, double py) {
  if (scene.is_triangle(primitive)) return triangle_plane(view, scene, primitive, px, py);
  const dvec3 ray = view.ray_direction(px, py);
  const std::optional<double> w = seen_depth(view, scene, primitive, ray);
  if (!w) return {std::nan(""), std::nan(""), std::nan("")};
  const dvec3 point = view.eye() + *w * ray;
  return plane_through(view, point, outward_normal(scene, primitive, point), px, py);
}

dvec3 seen_point(const View& view, const Scene& scene, uint32_t primitive, double px, double py) {
  const dvec3 ray = view.ray_direction(px, py);
  if (!scene.is_triangle(primitive)) {
    const std::optional<double> w = seen_depth(view, scene, primitive, ray);
    return w ? view.eye() + *w * ray : beside(scene, primitive, view.eye(), ray);
  }
  const double inverse_w = triangle_plane(view, scene, primitive, px, py).inverse_w;
  if (!(inverse_w > 0.0) || !std::isfinite(inverse_w))
    return dvec3(scene.positions[scene.triangles[primitive].x]);
  return view.eye() + ray / inverse_w;
}

}  // namespace hybray
