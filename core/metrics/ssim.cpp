#include "core/metrics/ssim.h"

#include "core/base/error.h"
#include "core/metrics/radiance_check.h"
#include "core/metrics/row_sums.h"

#include <cmath>

#include <fmt/format.h>

namespace hybray::metrics {
namespace {

constexpr int kTaps = kSsimWindow, kRadius = kTaps / 2;
constexpr double kSigma = 1.5, kK1 = 0.01, kK2 = 0.03;

std::array<double, kTaps> window() {
  std::array<double, kTaps> weights{};
  double sum = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    const double x = (i - kRadius) / kSigma;
    sum += weights[static_cast<size_t>(i)] = std::exp(-0.5 * x * x);
  }
  for (double& w : weights) w /= sum;
  return weights;
}

void require_pair(const Image2D<vec3>& image, const Image2D<vec3>& reference, double range) {
  require_radiance(reference, "reference");
  require_size(image, "image", reference.width(), reference.height(), "the reference");
  require_radiance(image, "image");
  if (!(range > 0.0 && std::isfinite(range)))
    throw InputError("range", fmt::format("{} is not positive", range));
}

// Weighted moments of a window about zero.
struct Moments {
  double x = 0.0, r = 0.0, xx = 0.0, rr = 0.0, xr = 0.0;

  void add(double weight, const Moments& m) {
    x += weight * m.x, r += weight * m.r;
    xx += weight * m.xx, rr += weight * m.rr, xr += weight * m.xr;
  }
};

}  // namespace

double ssim(const Image2D<vec3>& image, const Image2D<vec3>& reference, double range) {
  require_pair(image, reference, range);
  const int w = image.width(), h = image.height();
  if (w < kTaps || h < kTaps)
    throw InputError("image", fmt::format("SSIM needs at least {} x {} pixels", kTaps, kTaps));
  const double c1 = kK1 * range * kK1 * range, c2 = kK2 * range * kK2 * range;
  const auto weights = window();
  const int inner_w = w - 2 * kRadius, inner_h = h - 2 * kRadius;
  const auto [sum] = sum_rows<1>(inner_h, [&](int top) {
    double row = 0.0;
    std::vector<Moments> columns(static_cast<size_t>(w));  // of the window's rows, by column
    for (int channel = 0; channel < 3; ++channel) {
      for (int x = 0; x < w; ++x) {
        Moments sums;
        for (int k = 0; k < kTaps; ++k) {
          const double a = image(x, top + k)[channel], b = reference(x, top + k)[channel];
          sums.add(weights[static_cast<size_t>(k)], {a, b, a * a, b * b, a * b});
        }
        columns[static_cast<size_t>(x)] = sums;
      }
      for (int x = 0; x < inner_w; ++x) {
        Moments m;
        for (int k = 0; k < kTaps; ++k)
          m.add(weights[static_cast<size_t>(k)], columns[static_cast<size_t>(x + k)]);
        const double variances = m.xx - m.x * m.x + m.rr - m.r * m.r, covariance = m.xr - m.x * m.r;
        row += (2.0 * m.x * m.r + c1) * (2.0 * covariance + c2) /
               ((m.x * m.x + m.r * m.r + c1) * (variances + c2));
      }
    }
    return std::array{row};
  });
  return sum / (3.0 * inner_w * inner_h);
}

double psnr(const Image2D<vec3>& image, const Image2D<vec3>& reference, double range) {
  require_pair(image, reference, range);
  const auto [square] = sum_rows<1>(image.height(), [&](int y) {
    double row = 0.0;
    for (int x = 0; x < image.width(); ++x) {
      const dvec3 d = dvec3(image(x, y)) - dvec3(reference(x, y));
      row += glm::dot(d, d);
    }
    return std::array{row};
  });
  return 10.0 * std::log10(range * range * 3.0 * static_cast<double>(image.size()) / square);
}

}  // namespace hybray::metrics
