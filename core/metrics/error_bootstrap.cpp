#include "core/metrics/error_bootstrap.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/metrics/image_batches.h"
#include "core/metrics/image_error.h"
#include "core/metrics/radiance_check.h"
#include "core/metrics/row_sums.h"

#include <utility>

namespace hybray::metrics {
namespace {

Image2D<vec3> mean_of(std::span<const Image2D<vec3>> batches) {
  if (batches.size() < 2) throw InputError("reference", "it needs at least 2 independent batches");
  ImageBatches sum(batches[0].width(), batches[0].height());
  for (const Image2D<vec3>& batch : batches) sum.add(batch);
  return sum.mean();
}

// How often each of n things is drawn in n draws with replacement.
std::vector<double> draw_counts(size_t n, uint32_t dimension, uint32_t resample, uint64_t seed) {
  std::vector<double> counts(n, 0.0);
  for (size_t i = 0; i < n; ++i) counts[random_bits(i, dimension, resample, seed) % n] += 1.0;
  return counts;
}

Interval interval(double value, std::span<const double> resampled, double shift) {
  return {value + shift, quantile(resampled, 0.025) + shift, quantile(resampled, 0.975) + shift};
}

}  // namespace

ErrorBootstrap::ErrorBootstrap(std::span<const Image2D<vec3>> batches, const Image2D<uint8_t>* mask)
    : ErrorBootstrap(mean_of(batches), batches, mask) {}

ErrorBootstrap ErrorBootstrap::against_exact(const Image2D<vec3>& reference, const Image2D<uint8_t>* mask) {
  return {reference, {}, mask};
}

ErrorBootstrap::ErrorBootstrap(Image2D<vec3> reference, std::span<const Image2D<vec3>> batches,
                               const Image2D<uint8_t>* mask)
    : reference_(std::move(reference)), batches_(batches), floor_(relative_floor(reference_)) {
  if (mask) {
    mask_ = *mask;
    if (mask_.width() != reference_.width() || mask_.height() != reference_.height())
      throw InputError("mask", "it must be of the reference's size");
  }
  const auto [pixels] = sum_rows<1>(reference_.height(), [&](int y) {
    double row = 0.0;
    for (int x = 0; x < reference_.width(); ++x) row += counts(x, y) ? 1.0 : 0.0;
    return std::array{row};
  });
  if (pixels == 0.0) throw InputError("mask", "it leaves no pixel to compare");
  entries_ = 3.0 * pixels;
  reference_energy_ = energy(reference_);
  if (!(reference_energy_ > 0.0))
    throw InputError("reference", "it is black in the mask: no error is relative to it");

  const size_t r = batches_.size();
  gram_.resize(r * r);
  for (size_t k = 0; k < r; ++k) {
    batch_energy_.push_back(energy(batches_[k]));
    if (!(batch_energy_[k] > 0.0))
      throw InputError("reference", "a batch is black: it holds too few paths to tell how sure the mean is");
    for (size_t l = 0; l <= k; ++l) gram_[k * r + l] = gram_[l * r + k] = product(batches_[k], batches_[l]);
  }
}

double ErrorBootstrap::product(const Image2D<vec3>& a, const Image2D<vec3>& b) const {
  const auto [sum] = sum_rows<1>(reference_.height(), [&](int y) {
    double row = 0.0;
    for (int x = 0; x < reference_.width(); ++x) {
      if (!counts(x, y)) continue;
      const dvec3 r(reference_(x, y)), p = (dvec3(a(x, y)) - r) * (dvec3(b(x, y)) - r) / (r * r + floor_);
      row += p.x + p.y + p.z;
    }
    return std::array{row};
  });
  return sum / entries_;
}

double ErrorBootstrap::energy(const Image2D<vec3>& image) const {
  const auto [sum] = sum_rows<1>(image.height(), [&](int y) {
    double row = 0.0;
    for (int x = 0; x < image.width(); ++x) {
      const dvec3 v(image(x, y));
      if (counts(x, y)) row += v.x + v.y + v.z;
    }
    return std::array{row};
  });
  return sum;
}

void ErrorBootstrap::add(const Image2D<vec3>& image) {
  require_size(image, "image", reference_.width(), reference_.height(), "the reference");
  require_radiance(image, "image");
  MethodImage reduced{product(image, image), {}, energy(image)};
  for (const Image2D<vec3>& batch : batches_) reduced.cross.push_back(product(image, batch));
  images_.push_back(std::move(reduced));
}

ErrorIntervals ErrorBootstrap::intervals(uint64_t seed, int resamples) const {
  const size_t b = images_.size(), r = batches_.size();
  if (b < 2) throw InputError("images", "an interval over images needs at least 2 of them");
  const double nb = static_cast<double>(b), nr = static_cast<double>(r);

  double relmse = 0.0, image_energy = 0.0, own = 0.0;
  for (const MethodImage& image : images_) relmse += image.square / nb, image_energy += image.energy / nb;
  for (size_t k = 0; k < r; ++k) own += gram_[k * r + k] / (nr * (nr - 1.0));

  std::vector<double> errors, ratios;
  for (uint32_t resample = 0; resample < static_cast<uint32_t>(resamples); ++resample) {
    const std::vector<double> of_images = draw_counts(b, 0, resample, seed);
    const std::vector<double> of_batches = draw_counts(r, 1, resample, seed);
    double square = 0.0, cross = 0.0, drawn_energy = 0.0;
    for (size_t i = 0; i < b; ++i) {
      square += of_images[i] * images_[i].square / nb;
      drawn_energy += of_images[i] * images_[i].energy / nb;
      for (size_t k = 0; k < r; ++k) cross += of_images[i] * of_batches[k] * images_[i].cross[k] / (nb * nr);
    }
    // d = sum c_k d_k / R is how far the resampled reference lies from r.
    double d_square = 0.0, batch_square = 0.0, reference_energy = r == 0 ? reference_energy_ : 0.0;
    for (size_t k = 0; k < r; ++k) {
      batch_square += of_batches[k] * gram_[k * r + k];
      reference_energy += of_batches[k] * batch_energy_[k] / nr;
      for (size_t l = 0; l < r; ++l) d_square += of_batches[k] * of_batches[l] * gram_[k * r + l] / (nr * nr);
    }
    // The resampled reference's own error, by the same formula as `own`: its expectation is that of d_square.
    const double drawn_own = r == 0 ? 0.0 : (batch_square - nr * d_square) / (nr * (nr - 1.0));
    errors.push_back(square - 2.0 * cross + d_square - drawn_own);
    ratios.push_back(drawn_energy / reference_energy);
  }
  return {interval(relmse, errors, 0.0), interval(relmse, errors, -own),
          interval(image_energy / reference_energy_, ratios, 0.0), own};
}

}  // namespace hybray::metrics
