// Paths of axially symmetric scenes follow a plane through the axis: one angle says where a path lands and
// what it carries, for each number of internal reflections.
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/truth/closed_form_cases.h"
#include "core/truth/closed_form_optics.h"
#include "core/truth/closed_form_quadrature.h"

#include <cmath>
#include <numbers>

namespace hybray::truth {
namespace {

using namespace procedural;
constexpr double kPi = std::numbers::pi;
constexpr double kNegligible = 1e-16;  // share of a path's flux below which higher orders are not followed

// The cone of light from a lamp that a ball fills, by the angle of incidence i on the ball: the angle at the
// lamp (sine rule), and the flux a radian of i.
struct BallCone {
  double radius, distance;  // of the ball; of the lamp from its centre

  double angle(double i) const { return std::asin(radius / distance * std::sin(i)); }
  double density(double i) const {
    const double sine = radius / distance * std::sin(i), slope = radius / distance * std::cos(i);
    return kClosedFormIntensity * 2.0 * kPi * sine * slope / std::sqrt(1.0 - sine * sine);
  }
};

std::vector<Region> regions_in(const RadialPaths& paths, const Interval& range,
                               const std::vector<Interval>& rings) {
  const std::vector<FluxSum> sums = flux_into_rings(paths, range, rings);
  std::vector<Region> regions;
  for (size_t r = 0; r < rings.size(); ++r) regions.push_back(ring_region(rings[r], sums[r]));
  return regions;
}

const std::vector<Interval> kHalfMetreRings{{0.0, 0.5}, {0.5, 1.0}, {1.0, 1.5}, {1.5, 2.0}};

}  // namespace

// Polar angles are from the upward axis, about the ball's centre. A ray meets the ball at polar angle i -
// theta under incidence i; each chord inside advances it by pi - 2 t; and a ray that leaves at polar angle
// phi travels in the direction phi + i. Minus one internal reflection is the reflection at the outside.
std::vector<Region> regions_of(const BallLens& c, int max_events) {
  const BallCone cone{c.radius, c.light_height - c.center_height};
  const RadialPaths paths = [=](double i, std::vector<RadialLanding>& landings) {
    const double t = refraction_angle(i, c.ior), f = unpolarised_reflectance(i, c.ior);
    const double density = cone.density(i);
    for (int k = -1; k + 2 <= max_events; ++k) {
      const double share = k < 0 ? f : (1.0 - f) * (1.0 - f) * std::pow(f, k);
      if (k > 0 && share < kNegligible) break;
      const double phi = i - cone.angle(i) + (k + 1) * (kPi - 2.0 * t), heading = phi + i;
      const double height = c.center_height + c.radius * std::cos(phi);
      const double way = height / -std::cos(heading);
      landings.push_back(
          {way > 0.0 ? c.radius * std::sin(phi) + way * std::sin(heading) : std::nan(""), share * density});
    }
  };
  return regions_in(paths, {0.0, 0.5 * kPi}, {{0.0, 0.1}, {0.1, 0.2}, {0.2, 0.3}, {0.3, 0.4}, {0.5, 0.6}});
}

// r = (H - T) tan theta + (2 k + 1) T tan theta', k double reflections inside the plate.
std::vector<Region> regions_of(const GlassSlab& c, int max_events) {
  const RadialPaths paths = [=](double theta, std::vector<RadialLanding>& landings) {
    const double t = refraction_angle(theta, c.ior), f = unpolarised_reflectance(theta, c.ior);
    const double density = kClosedFormIntensity * 2.0 * kPi * std::sin(theta);
    for (int k = 0; 2 * k + 2 <= max_events; ++k) {
      const double inside = (2 * k + 1) * c.thickness;
      const double share =
          (1.0 - f) * (1.0 - f) * std::pow(f, 2 * k) * std::exp(-c.absorption * inside / std::cos(t));
      if (k > 0 && share < kNegligible) break;
      landings.push_back(
          {(c.light_height - c.thickness) * std::tan(theta) + inside * std::tan(t), share * density});
    }
  };
  // Steeper angles land farther out than the last ring, whatever the order.
  const double last = std::atan(kHalfMetreRings.back().high / (c.light_height - c.thickness));
  return regions_in(paths, {0.0, last}, kHalfMetreRings);
}

// One refraction; what the surface reflects goes up and does not come back.
std::vector<Region> regions_of(const FlatWater& c, int) {
  const RadialPaths paths = [=](double theta, std::vector<RadialLanding>& landings) {
    const double t = refraction_angle(theta, c.ior);
    landings.push_back(
        {(c.light_height - c.depth) * std::tan(theta) + c.depth * std::tan(t),
         (1.0 - unpolarised_reflectance(theta, c.ior)) * kClosedFormIntensity * 2.0 * kPi * std::sin(theta)});
  };
  const double last = std::atan(kHalfMetreRings.back().high / (c.light_height - c.depth));
  return regions_in(paths, {0.0, last}, kHalfMetreRings);
}

// All that the ball receives leaves it toward the walls, but for what is still inside after m events: with
// reflectance F at every meeting, (1 - F) F^(m - 1).
std::vector<Region> regions_of(const Furnace& c, int max_events) {
  const BallCone cone{c.radius, c.light * std::numbers::sqrt3};
  const FluxSum sum = integral(
      [=](double i) {
        const double f = unpolarised_reflectance(i, c.ior);
        return cone.density(i) * (1.0 - (1.0 - f) * std::pow(f, max_events - 1));
      },
      {0.0, 0.5 * kPi});
  Region walls;
  walls.name = "all walls";
  walls.contains = [](const dvec3&) { return true; };
  set_irradiance(walls, 6.0 * 4.0 * c.half_room * c.half_room, sum);
  return {walls};
}

}  // namespace hybray::truth
