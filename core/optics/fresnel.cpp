#include "core/optics/fresnel.h"

#include <algorithm>
#include <cmath>

namespace hybray::optics {

double fresnel_conductor(double cos_i, double eta, double k) {
  cos_i = std::min(1.0, std::max(0.0, cos_i));
  const double cos2 = cos_i * cos_i, sin2 = 1.0 - cos2;
  const double difference = eta * eta - k * k - sin2;
  const double a2_b2 = std::sqrt(difference * difference + 4.0 * eta * eta * k * k);
  const double a = std::sqrt(std::max(0.0, 0.5 * (a2_b2 + difference)));
  const double s_sum = a2_b2 + cos2, s_mix = 2.0 * a * cos_i;
  const double rs = (s_sum - s_mix) / (s_sum + s_mix);
  const double p_sum = cos2 * a2_b2 + sin2 * sin2, p_mix = s_mix * sin2;
  const double ratio = p_sum + p_mix > 0.0 ? (p_sum - p_mix) / (p_sum + p_mix) : 1.0;
  return 0.5 * rs * (1.0 + ratio);
}

double hemispherical_reflectance(double eta) {
  // 2 int F(c) c dc over [0, 1]. Inside the denser medium F is 1 up to the critical cosine and has a square
  // root there; substituting c = c0 + (1 - c0) s^2 removes it, and midpoints then converge fast.
  const double c0 = eta < 1.0 ? std::sqrt(1.0 - eta * eta) : 0.0;
  constexpr int kSteps = 4096;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = (i + 0.5) / kSteps;
    const double c = c0 + (1.0 - c0) * s * s;
    sum += fresnel_dielectric(c, eta) * c * 2.0 * s;
  }
  return c0 * c0 + 2.0 * (1.0 - c0) * sum / kSteps;
}

double thin_sheet_reflectance(double cos_i, double eta) {
  const double r = fresnel_dielectric(cos_i, eta);
  return 2.0 * r / (1.0 + r);
}

}  // namespace hybray::optics
