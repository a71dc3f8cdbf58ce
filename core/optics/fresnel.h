// Reflection and refraction of unpolarised light at a smooth interface: exact Fresnel equations (Born and
// Wolf, Principles of Optics, 1.5 and 14.2), never an approximation of them.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace hybray::optics {

// What happens to light at an interface between dielectrics.
struct Refraction {
  double reflectance = 1.0;  // in [0, 1]; 1 at total internal reflection
  double eta_cos = 0.0;      // eta times the cosine of the refracted angle; 0 at total internal reflection
};

// `cos_incident` in [0, 1]; `eta` = index of the medium beyond / index of the medium that the light comes
// from.
inline Refraction refraction_at(double cos_incident, double eta) {
  const double cos_i = std::min(1.0, std::max(0.0, cos_incident));
  // Rounding must not turn a grazing zero into NaN.
  const double g2 = eta * eta - (1.0 - cos_i * cos_i);
  if (g2 <= 0.0) return {};
  // rs = (c - g) / (c + g) and rp = (ee - g) / (ee + g), with one division for both.
  const double g = std::sqrt(g2), ee = eta * eta * cos_i;
  const double s = cos_i + g, p = ee + g;
  const double inverse = 1.0 / (s * p);
  const double rs = (cos_i - g) * p * inverse, rp = (ee - g) * s * inverse;
  return {0.5 * (rs * rs + rp * rp), g};
}

inline double fresnel_dielectric(double cos_incident, double eta) {
  return refraction_at(cos_incident, eta).reflectance;
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

// A vector of nearly unit length (to about 1e-6) brought to it: one Newton step, so that rounding does not
// grow along a chain of events.
inline dvec3 renormalised(const dvec3& v) {
  return v * (1.5 - 0.5 * glm::dot(v, v));
}

// Direction of travel after refraction (Snell). `n` is unit and faces the incoming light, which comes at
// `cos_i` = -dot(direction, n) >= 0; `inverse_eta` = 1 / eta; `eta_cos` > 0 as refraction_at gives it.
inline dvec3 refracted(const dvec3& direction, const dvec3& n, double cos_i, double inverse_eta,
                       double eta_cos) {
  return renormalised(inverse_eta * (direction + (cos_i - eta_cos) * n));
}
// The same where the angle's Fresnel terms are not known yet. Returns false at total internal reflection and
// leaves `out` alone.
inline bool refracted(const dvec3& direction, const dvec3& n, double eta, dvec3& out) {
  const double cos_i = -glm::dot(direction, n);
  const double eta_cos = refraction_at(cos_i, eta).eta_cos;
  if (!(eta_cos > 0.0)) return false;
  out = refracted(direction, n, cos_i, 1.0 / eta, eta_cos);
  return true;
}

}  // namespace hybray::optics
