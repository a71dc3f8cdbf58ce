#include "core/truth/closed_form_optics.h"

#include <cmath>

namespace hybray::truth {

double refraction_angle(double incidence, double n) {
  return std::asin(std::sin(incidence) / n);
}

double unpolarised_reflectance(double i, double n) {
  // Close to the normal both formulas are 0 / 0; the limit is then off by the square of the angle.
  if (i < 1e-5) return (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
  const double t = refraction_angle(i, n);
  if (std::isnan(t)) return 1.0;
  const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return 0.5 * (s * s + p * p);
}

}  // namespace hybray::truth
