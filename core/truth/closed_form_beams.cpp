// Parallel light through or off one plane: irradiance is the light's times what the plane lets on, times the
// cosine of arrival.
#include "core/truth/closed_form_cases.h"
#include "core/truth/closed_form_optics.h"
#include "core/truth/closed_form_quadrature.h"

#include <cmath>

namespace hybray::truth {

using namespace procedural;

// E cos(i) (1 - F(i)): refraction changes the direction of the beam, not the horizontal area that it falls
// on. Light that meets a side of the water stays within depth * tan(t) of it on its way down.
std::vector<Region> regions_of(const SunlitPool& c, int) {
  const double irradiance =
      kClosedFormIrradiance * std::cos(c.incidence) * (1.0 - unpolarised_reflectance(c.incidence, c.ior));
  const double a = c.half_width * 2.0 / 3.0;
  return {floor_rectangle("middle of the floor", {-a, a}, {-a, a}, {irradiance * 4.0 * a * a, 0.0})};
}

// E rho cos(i) on the lit square.
std::vector<Region> regions_of(const GrazedReceiver& c, int) {
  const double irradiance = kClosedFormIrradiance * kMirrorReflectance * std::cos(c.incidence);
  const dvec3 center = c.center(), along = c.along();
  const auto square = [&](const char* name, double half, double lit) {
    Region region;
    region.name = name;
    region.contains = [=](const dvec3& p) {
      return std::abs(glm::dot(p - center, along)) < half && std::abs(p.z) < half;
    };
    set_irradiance(region, 4.0 * half * half, {irradiance * 4.0 * lit * lit, 0.0});
    return region;
  };
  const double half = c.half_length();
  return {square("middle of the lit square", 0.5 * half, 0.5 * half),
          square("all of the receiver", 1.25 * half, half)};
}

}  // namespace hybray::truth
