// Quadrature for the closed forms: how much of the flux of a family of paths lands in given regions. Error
// estimates compare a step with its half; both rules are of second order, so that the finer result is better
// than the difference by a factor of about three.
#pragma once

#include "core/truth/closed_forms.h"

#include <vector>

namespace hybray::truth {

struct Interval {
  double low = 0.0, high = 0.0;
};

// Flux and its error estimate, W.
struct FluxSum {
  double flux = 0.0, error = 0.0;
};

// Share of the straight way from a to b that lies in `interval`.
double share_inside(double a, double b, const Interval& interval);

// Where one path of an axially symmetric family lands: signed distance from the axis (NaN: nowhere), and the
// flux it carries a unit of the parameter, W.
struct RadialLanding {
  double radius = 0.0, density = 0.0;
};
// The landings at one parameter value, one an order (0, 1, ... internal reflections), the same orders in the
// same places for all parameters; the list may end where the rest is negligible.
using RadialPaths = std::function<void(double parameter, std::vector<RadialLanding>& landings)>;

// Flux into each ring of radii, of all paths with a parameter in `range`.
std::vector<FluxSum> flux_into_rings(const RadialPaths& paths, const Interval& range,
                                     const std::vector<Interval>& rings);

// Integral by Simpson's rule.
FluxSum integral(const std::function<double(double)>& f, const Interval& range);

// Regions of a horizontal receiver: a ring about the origin, and a rectangle of x and z.
Region ring_region(const Interval& radii, const FluxSum& sum);
Region floor_rectangle(const std::string& name, const Interval& x, const Interval& z, const FluxSum& sum);

// Sets irradiance and error of a region of that area.
void set_irradiance(Region& region, double area, const FluxSum& sum);

}  // namespace hybray::truth
