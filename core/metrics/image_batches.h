// A converged image from independent batches: its mean and, pixel by pixel, how sure that mean is.
// Welford's recurrence for single batches; Chan, Golub and LeVeque (1979) for merging two sets.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <cstdint>

namespace hybray::metrics {

// An image that others are held against.
struct ReferenceImage {
  Image2D<vec3> mean;      // radiance, W/(sr m^2)
  Image2D<vec3> variance;  // of that mean, by pixel and channel; empty: exact (a closed form)
};

class ImageBatches {
 public:
  // Throws InputError for a size below 1 x 1.
  ImageBatches(int width, int height);

  int width() const { return mean_.width(); }
  int height() const { return mean_.height(); }
  int64_t count() const { return count_; }

  // Adds one batch: an independent estimate of the same image, every batch with the same expectation and
  // variance. Throws InputError for another size, NaN, infinity and negative values.
  void add(const Image2D<vec3>& batch);

  // Adds the batches of `later` after the own ones. Throws InputError for another size.
  void merge(const ImageBatches& later);

  // At least 1 batch.
  Image2D<vec3> mean() const;
  // Variance of that mean: the batches' sample variance / count. At least 2 batches.
  Image2D<vec3> variance_of_mean() const;
  ReferenceImage reference() const { return {mean(), variance_of_mean()}; }

 private:
  Image2D<dvec3> mean_, squares_;  // squares_: sum of squared deviations from the mean
  int64_t count_ = 0;
};

}  // namespace hybray::metrics
