#include "core/metrics/image_error.h"

#include "core/base/error.h"
#include "core/metrics/radiance_check.h"
#include "core/metrics/row_sums.h"
#include "core/metrics/statistics.h"

#include <cmath>
#include <vector>

namespace hybray::metrics {
namespace {

double total(const dvec3& v) {
  return v.x + v.y + v.z;
}

void require_mask(const Image2D<uint8_t>& mask, const Image2D<vec3>& image) {
  if (mask.width() != image.width() || mask.height() != image.height())
    throw InputError("mask", "it must be of the image's size");
}

}  // namespace

double relative_floor(const Image2D<vec3>& reference) {
  require_radiance(reference, "reference");
  const auto [sum] = sum_rows<1>(reference.height(), [&](int y) {
    double row = 0.0;
    for (int x = 0; x < reference.width(); ++x) row += total(dvec3(reference(x, y)));
    return std::array{row};
  });
  if (!(sum > 0.0)) throw InputError("reference", "it is black: no error is relative to it");
  const double root = kFloorFraction * sum / (3.0 * static_cast<double>(reference.size()));
  return root * root;
}

ImageError image_error(const Image2D<vec3>& image, const ReferenceImage& reference,
                       const Image2D<uint8_t>* mask) {
  const Image2D<vec3>&r = reference.mean, &variance = reference.variance;
  const double e = relative_floor(r), lit_above = std::sqrt(e);
  require_size(image, "image", r.width(), r.height(), "the reference");
  require_radiance(image, "image");
  if (!variance.empty()) {
    require_size(variance, "reference variance", r.width(), r.height(), "the reference");
    require_radiance(variance, "reference variance");
  }
  if (mask) require_mask(*mask, image);

  const auto sums = sum_rows<7>(r.height(), [&](int y) {
    double relative = 0.0, own = 0.0, sum_x = 0.0, sum_r = 0.0, square = 0.0, symmetric = 0.0, pixels = 0.0;
    for (int x = 0; x < r.width(); ++x) {
      if (mask && !(*mask)(x, y)) continue;
      const dvec3 a(image(x, y)), b(r(x, y)), weight = 1.0 / (b * b + e), apart = (a - b) * (a - b);
      relative += total(weight * apart);
      if (!variance.empty()) own += total(weight * dvec3(variance(x, y)));
      sum_x += total(a);
      sum_r += total(b);
      square += total(apart);
      for (int c = 0; c < 3; ++c)
        if (a[c] != b[c]) symmetric += std::abs(a[c] - b[c]) / (a[c] + b[c]);
      pixels += 1.0;
    }
    return std::array{relative, own, sum_x, sum_r, square, symmetric, pixels};
  });
  const auto [relative, own, sum_x, sum_r, square, symmetric, pixels] = sums;
  if (pixels == 0.0) throw InputError("mask", "it leaves no pixel to compare");
  if (!(sum_r > 0.0)) throw InputError("reference", "it is black in the mask: no error is relative to it");

  std::vector<double> errors;  // of lit pixels
  for (size_t i = 0; i < r.size(); ++i) {
    const double mean_r = total(dvec3(r[i])) / 3.0;
    if ((!mask || (*mask)[i]) && mean_r > lit_above)
      errors.push_back(std::abs(total(dvec3(image[i])) / 3.0 - mean_r) / mean_r);
  }
  ImageError result;
  result.relmse = relative / (3.0 * pixels);
  result.reference_relmse = own / (3.0 * pixels);
  result.energy_ratio = sum_x / sum_r;
  result.rmse = std::sqrt(square / (3.0 * pixels));
  result.smape = symmetric / (3.0 * pixels);
  result.lit_fraction = static_cast<double>(errors.size()) / pixels;
  result.median_relative_error = errors.empty() ? 0.0 : median(errors);
  return result;
}

}  // namespace hybray::metrics
