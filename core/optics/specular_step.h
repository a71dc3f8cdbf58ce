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

// The same for refraction; `eta_cos` as the Fresnel equations gave it for the shading normal. Returns false
// where neither normal lets light through.
inline bool refraction(const SurfaceOptics& s, const Facing& f, const dvec3& direction, double eta_cos,
                       dvec3& out) {
  const double inverse_eta = s.crossing[!f.from_inner];
  if (eta_cos > 0.0) {
    out = refracted(direction, f.shading, f.cos_incident, inverse_eta, eta_cos);
    if (glm::dot(out, f.geometric) < 0.0) return true;
  }
  return refracted(direction, f.geometric, s.crossing[f.from_inner], out);
}

// A path's weight that a surface mirrors and lets through, by channel, with their means.
struct SpecularShares {
  SpecularShares(const SpecularSplit& split, const dvec3& weight)
      : back(weight * split.reflectance),
        through(weight * split.transmittance),
        mean_back(mean(back)),
        mean_through(mean(through)),
        eta_cos(split.eta_cos) {}
  dvec3 back, through;
  double mean_back, mean_through;
  double eta_cos;  // of refraction_at
};

// Reflection with probability mean(weight * reflectance) / mean(weight * (reflectance + transmittance)), and
// the weight divided by the probability of what was chosen; `u` is uniform in [0, 1). A direction that the
// shading normal would send to the wrong side of the surface is taken from the geometric normal instead. The
// weight of flux and of importance alike: radiance carries the squared ratio of indices in addition. The mean
// weight stays what the shares are together.
inline SpecularChoice choose_specular(const SurfaceOptics& s, const SurfacePoint& point, const Facing& f,
                                      const SpecularShares& shares, const dvec3& direction, uint16_t medium,
                                      double u) {
  SpecularChoice c;
  const double b = shares.mean_back, t = shares.mean_through;
  if (!(b + t > 0.0)) return c;
  c.reflected = u * (b + t) < b;
  c.medium = medium;
  if (!c.reflected) {
    if (s.thin) {
      c.direction = direction;
    } else if (refraction(s, f, direction, shares.eta_cos, c.direction)) {
      c.medium = f.from_inner ? s.outer_medium : s.inner_medium;
    } else {
      c.reflected = true;  // total reflection about both normals: rounding at the critical angle
    }
    c.weight = shares.through * ((b + t) / t);
  } else {
    c.weight = shares.back * ((b + t) / b);
  }
  if (c.reflected) c.direction = reflection(f, direction);
  c.origin = point.position + f.geometric * (c.reflected ? point.offset : -point.offset);
  return c;
}

}  // namespace hybray::optics
