#include "core/scene/primitive_hit.h"

#include "core/scene/curved_primitive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybray {
namespace {

// Of a triple product a . (b x c) in double, relative to |a| |b| |c|: twelve products and differences of
// 2^-53 each.
constexpr double kTripleRounding = 0x1p-49;

}  // namespace

std::optional<double> primitive_hit(const Scene& scene, uint32_t primitive, const dvec3& o, const dvec3& d) {
  if (!scene.is_triangle(primitive))
    return nearest_hit(scene, primitive, o, d, 0.0, std::numeric_limits<double>::max());
  const uvec3& tri = scene.triangles[primitive];
  const dvec3 a(scene.positions[tri.x]), e1 = dvec3(scene.positions[tri.y]) - a,
                                         e2 = dvec3(scene.positions[tri.z]) - a, s = o - a;
  const dvec3 p = glm::cross(d, e2), q = glm::cross(s, e1);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return std::nullopt;  // in the triangle's plane
  const double side = det > 0.0 ? 1.0 : -1.0;
  const double u = side * glm::dot(s, p), v = side * glm::dot(d, q), size = std::abs(det);
  const double slack = kTripleRounding * std::sqrt(glm::dot(s, s) * glm::dot(d, d) *
                                                   std::max(glm::dot(e1, e1), glm::dot(e2, e2)));
  if (u < -slack || v < -slack || u + v > size + 2.0 * slack) return std::nullopt;
  const double t = glm::dot(e2, q) / det;
  return t >= 0.0 ? std::optional<double>(t) : std::nullopt;
}

}  // namespace hybray
