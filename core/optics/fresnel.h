// Reflection and refraction of unpolarised light at a smooth interface: exact Fresnel equations (Born and
// Wolf, Principles of Optics, 1.5 and 14.2), never an approximation of them.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace hybray::optics {

// Reflectance of an interface between dielectrics, in [0, 1]; 1 at total internal reflection. `cos_incident`
// in [0, 1]; `eta` = index of the medium beyond / index of the medium that the light comes from.
inline double fresnel_dielectric(double cos_incident, double eta) {
  const double cos_i = std::min(1.0, std::max(0.0, cos_incident));
  // cos of the refracted angle times eta, squared. Rounding must not turn a grazing zero into NaN.
  const double g2 = eta * eta - (1.0 - cos_i * cos_i);
  if (g2 <= 0.0) return 1.0;
  const double eta_cos_t = std::sqrt(g2);
  const double rs = (cos_i - eta_cos_t) / (cos_i + eta_cos_t);
  const double ee = eta * eta * cos_i;
  const double rp = (ee - eta_cos_t) / (ee + eta_cos_t);
  return 0.5 * (rs * rs + rp * rp);
}

// Reflectance of a metal seen from a medium: `eta` and `k` are the real and imaginary part of the metal's
// index divided by the medium's.
double fresnel_conductor(double cos_incident, double eta, double k);

// Mean of fresnel_dielectric over a cosine-weighted hemisphere of incidence: share of diffuse light that the
// interface sends back, in [0, 1]. By quadrature to about 1e-6; meant to be computed once a material.
double hemispherical_reflectance(double eta);

// Reflectance of a thin sheet of a medium of relative index `eta`, all bounces between its two faces summed:
// 2 R / (1 + R).
double thin_sheet_reflectance(double cos_incident, double eta);

// Direction of travel after a mirror reflection of `direction` about unit normal `n` (either side).
inline dvec3 reflected(const dvec3& direction, const dvec3& n) {
  return direction - 2.0 * glm::dot(direction, n) * n;
}

// Direction of travel after refraction (Snell). `n` is unit and faces the incoming light: dot(direction, n)
// <= 0. Returns false at total internal reflection and leaves `out` alone.
inline bool refracted(const dvec3& direction, const dvec3& n, double eta, dvec3& out) {
  const double cos_i = -glm::dot(direction, n);
  const double g2 = eta * eta - (1.0 - cos_i * cos_i);
  if (g2 <= 0.0) return false;
  // Normalised again, so that rounding does not grow along a chain of refractions.
  out = glm::normalize(direction + (cos_i - std::sqrt(g2)) * n);
  return true;
}

}  // namespace hybray::optics
