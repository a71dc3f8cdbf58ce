#include "core/caustics/light_source.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hybray::caustics {

Intensity::Intensity(const Light& light)
    : full(static_cast<double>(light.intensity) * dvec3(light.color)),
      axis(light.direction),
      spot(light.kind == LightKind::spot) {
  if (!spot) return;
  axis = glm::normalize(axis);
  const double inner = std::cos(static_cast<double>(light.inner_cone_angle));
  outer = std::cos(static_cast<double>(light.outer_cone_angle));
  scale = 1.0 / std::max(1e-3, inner - outer);
}

bool emits(const Light& light) {
  if (light.kind == LightKind::spot && !(light.outer_cone_angle > 0.0f)) return false;
  return light.intensity > 0.0f && (light.color.x > 0.0f || light.color.y > 0.0f || light.color.z > 0.0f);
}

UniformDomain::UniformDomain(const Light& light, const Bounds3& scene)
    : kind_(light.kind), origin_(light.position), axis_(glm::normalize(dvec3(light.direction))) {
  basis_around(axis_, right_, down_);
  switch (kind_) {
    case LightKind::directional:
      plane_ = light_frames(light, {&scene, 1}, scene, 1).front();
      measure_ = plane_.texel_measure(0, 0);
      return;
    case LightKind::spot:
      cos_cone_ = std::cos(static_cast<double>(light.outer_cone_angle));
      break;
    case LightKind::point:
      break;
  }
  measure_ = 2.0 * std::numbers::pi * (1.0 - cos_cone_);
}

void UniformDomain::sample(double u, double v, dvec3& origin, dvec3& direction) const {
  if (kind_ == LightKind::directional) {
    origin = plane_.ray_origin(u, v);
    direction = plane_.forward;
    return;
  }
  const double c = 1.0 - v * (1.0 - cos_cone_);
  const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
  const double phi = 2.0 * std::numbers::pi * u;
  origin = origin_;
  direction = s * std::cos(phi) * right_ + s * std::sin(phi) * down_ + c * axis_;
}

}  // namespace hybray::caustics
