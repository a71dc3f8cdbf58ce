// How far an image is from a reference. Exact definitions: docs/metrics.md.
//
// relMSE is the relative mean squared error of Rousselle, Knaus and Zwicker (2011), with the squared floor
// e = (1 % of the reference's mean)^2 in place of a fixed constant, so that it does not depend on the unit.
// SMAPE is the symmetric mean absolute percentage error as Vogels et al. (2018) use it, without their
// constant.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"
#include "core/metrics/image_batches.h"

#include <cstdint>

namespace hybray::metrics {

constexpr double kFloorFraction = 0.01;  // sqrt(e) as a fraction of the reference's mean
constexpr double kFloorOfReference =
    3.0;  // an error below this many times the reference's own is at the floor

// True where `relmse` says more about the reference than about the image.
constexpr bool at_floor(double relmse, double reference_relmse) {
  return relmse < kFloorOfReference * reference_relmse;
}

struct ImageError {
  double relmse = 0.0;                 // mean((x - r)^2 / (r^2 + e)) over pixels and channels
  double reference_relmse = 0.0;       // the reference's own: mean(variance / (r^2 + e))
  double energy_ratio = 0.0;           // sum x / sum r
  double rmse = 0.0;                   // sqrt(mean((x - r)^2)), W/(sr m^2)
  double smape = 0.0;                  // mean(|x - r| / (x + r)), 0 where both are black; in [0, 1]
  double lit_fraction = 0.0;           // pixels whose channel mean in the reference is above sqrt(e) / pixels
  double median_relative_error = 0.0;  // over lit pixels, of |x - r| / r of channel means

  // A reference with errors of its own raises relmse by about reference_relmse. Less that estimate; may be
  // negative where the image is at the floor.
  double relmse_debiased() const { return relmse - reference_relmse; }
  bool at_floor() const { return metrics::at_floor(relmse, reference_relmse); }
};

// e = (kFloorFraction * mean of the reference over all its pixels and channels)^2. Throws InputError for a
// reference that is black everywhere, against which nothing is relative.
double relative_floor(const Image2D<vec3>& reference);

// Compares over the pixels where `mask` is not zero, all pixels without one; e and what is lit come from the
// whole reference in any case. Throws InputError for images of different size, NaN, infinity, negative
// values, a reference that is black in the mask, and a mask that is zero everywhere.
ImageError image_error(const Image2D<vec3>& image, const ReferenceImage& reference,
                       const Image2D<uint8_t>* mask = nullptr);

}  // namespace hybray::metrics
