#include "core/truth/closed_form_quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace hybray::truth {
namespace {

constexpr int kCells = 1 << 16;
constexpr double kRounding = 1e-13;  // of sums of so many terms, relative

std::vector<double> ring_fluxes(const RadialPaths& paths, const Interval& range,
                                const std::vector<Interval>& rings, int cells) {
  std::vector<double> flux(rings.size(), 0.0);
  const double step = (range.high - range.low) / cells;
  std::vector<RadialLanding> a, b;
  paths(range.low, a);
  for (int i = 1; i <= cells; ++i) {
    b.clear();
    paths(range.low + step * i, b);
    for (size_t order = 0; order < std::min(a.size(), b.size()); ++order) {
      if (std::isnan(a[order].radius) || std::isnan(b[order].radius)) continue;
      const double cell = 0.5 * step * (a[order].density + b[order].density);
      for (size_t r = 0; r < rings.size(); ++r)
        flux[r] += cell * (share_inside(a[order].radius, b[order].radius, rings[r]) +
                           share_inside(-a[order].radius, -b[order].radius, rings[r]));
    }
    std::swap(a, b);
  }
  return flux;
}

double simpson(const std::function<double(double)>& f, const Interval& range, int cells) {
  const double step = (range.high - range.low) / cells;
  double sum = f(range.low) + f(range.high);
  for (int i = 1; i < cells; ++i) sum += (i % 2 ? 4.0 : 2.0) * f(range.low + step * i);
  return sum * step / 3.0;
}

FluxSum compared(double coarse, double fine) {
  return {fine, std::abs(fine - coarse) + kRounding * std::abs(fine)};
}

}  // namespace

double share_inside(double a, double b, const Interval& interval) {
  const double low = std::min(a, b), high = std::max(a, b);
  if (high == low) return low >= interval.low && low < interval.high ? 1.0 : 0.0;
  return std::max(0.0, std::min(high, interval.high) - std::max(low, interval.low)) / (high - low);
}

std::vector<FluxSum> flux_into_rings(const RadialPaths& paths, const Interval& range,
                                     const std::vector<Interval>& rings) {
  const auto coarse = ring_fluxes(paths, range, rings, kCells),
             fine = ring_fluxes(paths, range, rings, 2 * kCells);
  std::vector<FluxSum> sums;
  for (size_t r = 0; r < rings.size(); ++r) sums.push_back(compared(coarse[r], fine[r]));
  return sums;
}

FluxSum integral(const std::function<double(double)>& f, const Interval& range) {
  return compared(simpson(f, range, kCells), simpson(f, range, 2 * kCells));
}

void set_irradiance(Region& region, double area, const FluxSum& sum) {
  region.area = area;
  region.irradiance = sum.flux / area;
  region.quadrature_error = sum.error / area;
}

Region ring_region(const Interval& radii, const FluxSum& sum) {
  Region region;
  region.name = fmt::format("ring {:.3g} to {:.3g} m", radii.low, radii.high);
  region.contains = [radii](const dvec3& p) {
    const double r = std::hypot(p.x, p.z);
    return r >= radii.low && r < radii.high;
  };
  set_irradiance(region, std::numbers::pi * (radii.high * radii.high - radii.low * radii.low), sum);
  return region;
}

Region floor_rectangle(const std::string& name, const Interval& x, const Interval& z, const FluxSum& sum) {
  Region region;
  region.name = name;
  region.contains = [x, z](const dvec3& p) {
    return p.x >= x.low && p.x < x.high && p.z >= z.low && p.z < z.high;
  };
  set_irradiance(region, (x.high - x.low) * (z.high - z.low), sum);
  return region;
}

}  // namespace hybray::truth
