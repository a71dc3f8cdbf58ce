// One specular event of a path, the same for light paths and camera paths: which way the surface faces, the
// choice between reflection and refraction by importance, and where the path goes on.
#pragma once

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

// Reflection with probability mean(weight * reflectance) / mean(weight * (reflectance + transmittance)), and
// the weight divided by the probability of what was chosen; `u` is uniform in [0, 1). A direction that the
// shading normal would send to the wrong side of the surface is taken from the geometric normal instead. The
// weight of flux and of importance alike: radiance carries the squared ratio of indices in addition.
SpecularChoice choose_specular(const SurfaceOptics& surface, const SurfacePoint& point, const Facing& facing,
                               const SpecularSplit& split, const dvec3& direction, const dvec3& weight,
                               uint16_t medium, double u);

inline double mean(const dvec3& v) {
  return (v.x + v.y + v.z) * (1.0 / 3.0);
}

}  // namespace hybray::optics
