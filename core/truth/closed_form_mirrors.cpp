#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_form_cases.h"
#include "core/truth/closed_form_quadrature.h"

#include <cmath>
#include <numbers>

namespace hybray::truth {
namespace {

using namespace procedural;

// Solid angle of the rectangle x by z (relative to the foot of the perpendicular) seen from a height h above
// its plane: the integral of h / (x^2 + z^2 + h^2)^(3/2).
double solid_angle(const Interval& x, const Interval& z, double h) {
  const auto corner = [h](double a, double b) {
    return std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
  };
  return corner(x.high, z.high) - corner(x.low, z.high) - corner(x.high, z.low) + corner(x.low, z.low);
}

}  // namespace

// The mirror image of the lamp lights the floor: flux = I rho times the solid angle of the region from it.
// All regions lie where the line to the image passes through the mirror.
std::vector<Region> plane_mirror_regions(int) {
  using C = PlaneMirror;
  const double image_x = 2.0 * C::x;
  const auto region = [&](const char* name, const Interval& x, const Interval& z) {
    const double omega = solid_angle({x.low - image_x, x.high - image_x}, z, C::light_height);
    return floor_rectangle(name, x, z, {kClosedFormIntensity * kMirrorReflectance * omega, 0.0});
  };
  return {region("beside the mirror", {0.5, 1.5}, {-1.0, 1.0}),
          region("under the lamp", {-1.0, 0.0}, {-0.5, 0.5}),
          region("far from the mirror", {-3.0, -2.0}, {0.5, 1.5})};
}

// A ray at angle a from the axis meets the mirror at rho = 2 f tan(a / 2) and goes on parallel to the axis,
// so the flux inside rho is 2 pi I (1 - cos a) = 4 pi I q / (1 + q), q = (rho / 2 f)^2; its derivative over
// 2 pi rho is the irradiance I / (f (1 + q))^2.
std::vector<Region> paraboloid_regions(int) {
  using C = ParaboloidMirror;
  const auto flux = [](double rho) {
    const double q = std::pow(std::min(rho, C::rim_radius) / (2.0 * C::focal_length), 2);
    return 4.0 * std::numbers::pi * kClosedFormIntensity * kMirrorReflectance * q / (1.0 + q);
  };
  std::vector<Region> regions;
  for (const Interval& r :
       std::vector<Interval>{{0.0, 0.25}, {0.25, 0.5}, {0.5, 0.75}, {0.75, 0.95}, {0.0, 1.2}})
    regions.push_back(ring_region(r, {flux(r.high) - flux(r.low), 0.0}));
  return regions;
}

}  // namespace hybray::truth
