// One specular event of a path, the same for light paths and camera paths: which way the surface faces, the
// choice between reflection and refraction by importance, and where the path goes on.
#pragma once

#include "core/optics/fresnel.h"
#include "core/optics/surface_optics.h"
#include "core/scene/surface_point.h"

namespace hybray::optics {

// Normals on the side that the path arrives from.
struct Facing {
  dvec3 geometric{0.0}, shading{0.0};
  bool from_inner = false;    // the path arrives from the side that the geometric normal turns away from
  double cos_incident = 0.0;  // with the shading normal, in (0, 1]
};

// Where the shading normal turns away from the path, the geometric normal stands in for it.
inline Facing facing(const SurfacePoint& point, const dvec3& direction) {
  Facing f;
  f.from_inner = glm::dot(direction, point.geometric_normal) > 0.0;
  f.geometric = f.from_inner ? -point.geometric_normal : point.geometric_normal;
  f.shading = f.from_inner ? -point.shading_normal : point.shading_normal;
  f.cos_incident = -glm::dot(direction, f.shading);
  if (!(f.cos_incident > 0.0)) {
    f.shading = f.geometric;
    f.cos_incident = -glm::dot(direction, f.geometric);
  }
  return f;
}

struct SpecularChoice {
  dvec3 weight{0.0};     // of the path after the event, by channel; zero: nothing goes on
  dvec3 origin{0.0};     // off the surface, on the side that the path goes on
  dvec3 direction{0.0};  // unit
  uint16_t medium = 0;   // that the path goes on in
  bool reflected = false;
};

inline double mean(const dvec3& v) {
  return (v.x + v.y + v.z) * (1.0 / 3.0);
}

// Reflection by the shading normal, or by the geometric one where that would end below the surface.
inline dvec3 reflection(const Facing& f, const dvec3& direction) {
  const dvec3 out = reflected(direction, f.shading);
  return glm::dot(out, f.geometric) > 0.0 ? out : reflected(direction, f.geometric);
}

// The same for refraction. Returns false where neither normal lets light through.
inline bool refraction(const Facing& f, const dvec3& direction, double eta, dvec3& out) {
  if (refracted(direction, f.shading, eta, out) && glm::dot(out, f.geometric) < 0.0) return true;
  return refracted(direction, f.geometric, eta, out);
}

// Reflection with probability mean(weight * reflectance) / mean(weight * (reflectance + transmittance)), and
// the weight divided by the probability of what was chosen; `u` is uniform in [0, 1). A direction that the
// shading normal would send to the wrong side of the surface is taken from the geometric normal instead. The
// weight of flux and of importance alike: radiance carries the squared ratio of indices in addition.
inline SpecularChoice choose_specular(const SurfaceOptics& s, const SurfacePoint& point, const Facing& f,
                                      const SpecularSplit& shares, const dvec3& direction,
                                      const dvec3& weight, uint16_t medium, double u) {
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
