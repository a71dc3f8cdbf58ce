#include "core/gbuffer/triangle_plane.h"

namespace hybray {

TrianglePlane triangle_plane(const View& view, const Scene& scene, uint32_t triangle, double px, double py) {
  const uvec3& tri = scene.triangles[triangle];
  const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
  const dvec3 n = glm::cross(b - a, c - a);
  const double distance = glm::dot(n, a - view.eye());
  const double per_pixel = 1.0 / (distance * view.focal());
  return {glm::dot(n, view.ray_direction(px, py)) / distance, glm::dot(n, view.right()) * per_pixel,
          glm::dot(n, view.down()) * per_pixel};
}

}  // namespace hybray
