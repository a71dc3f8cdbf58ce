#include "core/optics/ggx.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

double ggx_density(const dvec3& h, double alpha) {
  if (h.z <= 0.0) return 0.0;
  const double s = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
  return 1.0 / (kPi * alpha * alpha * s * s);
}

double ggx_visible_share(const dvec3& v, double alpha) {
  if (v.z <= 0.0) return 0.0;
  const double slope = alpha * alpha * (v.x * v.x + v.y * v.y) / (v.z * v.z);
  return 2.0 / (1.0 + std::sqrt(1.0 + slope));
}

dvec3 sample_visible_normal(const dvec3& v, double alpha, double a, double b) {
  // Seen from the stretched direction, the ellipsoid of normals is a hemisphere: pick a point of its
  // projected disc, of which one half is foreshortened.
  const dvec3 stretched = glm::normalize(dvec3(alpha * v.x, alpha * v.y, v.z));
  const double across = stretched.x * stretched.x + stretched.y * stretched.y;
  const dvec3 t1 = across > 0.0 ? dvec3(-stretched.y, stretched.x, 0.0) / std::sqrt(across) : dvec3(1, 0, 0);
  const dvec3 t2 = glm::cross(stretched, t1);
  const double r = std::sqrt(a), phi = 2.0 * kPi * b, s = 0.5 * (1.0 + stretched.z);
  const double p1 = r * std::cos(phi);
  const double p2 = (1.0 - s) * std::sqrt(1.0 - p1 * p1) + s * r * std::sin(phi);
  const dvec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1.0 - p1 * p1 - p2 * p2)) * stretched;
  return glm::normalize(dvec3(alpha * n.x, alpha * n.y, std::max(1e-12, n.z)));
}

double visible_normal_pdf(const dvec3& h, const dvec3& v, double alpha) {
  return ggx_density(h, alpha) * ggx_visible_share(v, alpha) * std::max(0.0, glm::dot(v, h)) / v.z;
}

dvec3 sample_cosine_hemisphere(double a, double b) {
  const double r = std::sqrt(a), phi = 2.0 * kPi * b;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - a)};
}

}  // namespace hybray
