#include "core/metrics/flip_kernels.h"

#include "core/base/error.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace hybray::metrics {
namespace {

constexpr double kPi = std::numbers::pi;

// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees: the paper's table of contrast sensitivities. Each has a
// second Gaussian there, whose height is 0 but for blue-yellow.
struct Sensitivity {
  double height, width;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047}, kRedGreen{1.0, 0.0053},
    kBlueYellow[2]{{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidest = kBlueYellow[0].width;  // sets the radius of all
constexpr double kEdgeWidth = 0.082;              // degrees

// Values f(-radius), ..., f(radius).
template <class F>
std::vector<double> sampled(int radius, const F& f) {
  std::vector<double> values;
  for (int i = -radius; i <= radius; ++i) values.push_back(f(static_cast<double>(i)));
  return values;
}

double sum_of(const std::vector<double>& values, double sign) {
  double sum = 0.0;
  for (const double v : values) sum += sign * v > 0.0 ? sign * v : 0.0;
  return sum;
}

// Positive values divided by one number, negative ones by another; there may be none of either.
Kernel divided(const std::vector<double>& values, double positive, double negative) {
  Kernel kernel;
  for (const double v : values)
    kernel.push_back(static_cast<float>(v > 0.0 ? v / positive : v < 0.0 ? v / negative : 0.0));
  return kernel;
}

Kernel normalized(const std::vector<double>& values) {
  return divided(values, sum_of(values, 1.0), sum_of(values, -1.0));
}

}  // namespace

FlipKernels flip_kernels(double pixels_per_degree) {
  const double ppd = pixels_per_degree;
  if (!(ppd >= 1.0 && ppd <= 1000.0))
    throw InputError("pixels per degree", fmt::format("{} is not in [1, 1000]", ppd));
  FlipKernels kernels;

  const int wide = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * ppd));
  // Square root of the height: the kernel is used in both directions.
  const auto gaussian = [&](const Sensitivity& s) {
    return sampled(wide, [&](double i) {
      return std::sqrt(s.height * std::sqrt(kPi / s.width)) *
             std::exp(-kPi * kPi * (i / ppd) * (i / ppd) / s.width);
    });
  };
  kernels.achromatic = normalized(gaussian(kAchromatic));
  kernels.red_green = normalized(gaussian(kRedGreen));
  const auto first = gaussian(kBlueYellow[0]), second = gaussian(kBlueYellow[1]);
  const double whole = std::hypot(sum_of(first, 1.0), sum_of(second, 1.0));  // its square: over the plane
  kernels.blue_yellow[0] = divided(first, whole, whole);
  kernels.blue_yellow[1] = divided(second, whole, whole);

  const double sigma = 0.5 * kEdgeWidth * ppd;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const auto bell = [&](double i) { return std::exp(-i * i / (2.0 * sigma * sigma)); };
  kernels.smooth = normalized(sampled(radius, bell));
  kernels.edge = normalized(sampled(radius, [&](double i) { return -i * bell(i); }));
  kernels.point =
      normalized(sampled(radius, [&](double i) { return (i * i / (sigma * sigma) - 1.0) * bell(i); }));
  return kernels;
}

}  // namespace hybray::metrics
