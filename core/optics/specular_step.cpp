#include "core/optics/specular_step.h"

#include "core/optics/fresnel.h"

namespace hybray::optics {
namespace {

// Reflection by the shading normal, or by the geometric one where that would end below the surface.
dvec3 reflection(const Facing& f, const dvec3& direction) {
  const dvec3 out = reflected(direction, f.shading);
  return glm::dot(out, f.geometric) > 0.0 ? out : reflected(direction, f.geometric);
}

// The same for refraction. Returns false where neither normal lets light through.
bool refraction(const Facing& f, const dvec3& direction, double eta, dvec3& out) {
  if (refracted(direction, f.shading, eta, out) && glm::dot(out, f.geometric) < 0.0) return true;
  return refracted(direction, f.geometric, eta, out);
}

}  // namespace

SpecularChoice choose_specular(const SurfaceOptics& s, const SurfacePoint& point, const Facing& f,
                               const SpecularSplit& shares, const dvec3& direction, const dvec3& weight,
                               uint16_t medium, double u) {
  SpecularChoice c;
  const dvec3 back = weight * shares.reflectance, through = weight * shares.transmittance;
  const double b = mean(back), t = mean(through);
  if (!(b + t > 0.0)) return c;
  const double p_reflect = b / (b + t);
  c.reflected = u < p_reflect;
  c.medium = medium;
  if (!c.reflected) {
    if (s.thin) {
      c.direction = direction;
    } else if (refraction(f, direction, crossing_eta(s, f.from_inner), c.direction)) {
      c.medium = f.from_inner ? s.outer_medium : s.inner_medium;
    } else {
      c.reflected = true;  // total reflection about both normals: rounding at the critical angle
    }
    c.weight = through / (1.0 - p_reflect);
  } else {
    c.weight = back / p_reflect;
  }
  if (c.reflected) c.direction = reflection(f, direction);
  c.origin = point.position + f.geometric * (c.reflected ? point.offset : -point.offset);
  return c;
}

}  // namespace hybray::optics
