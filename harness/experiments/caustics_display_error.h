// How far the frames are from the reference as people see them on a display: PSNR, SSIM and HDR-FLIP, at
// exposures that the reference fixes.
#pragma once

#include "core/metrics/hdr_flip.h"
#include "harness/experiments/experiment.h"

namespace hybray::caustics_parts {

class DisplayErrors {
 public:
  // The reference, W/(sr m^2), stays alive.
  DisplayErrors(const Image2D<vec3>& reference, const metrics::FlipExposures& exposures);

  // One independent frame. HDR-FLIP, which takes as long as ten to twenty of the others, is made of the first
  // alone.
  void add(const Image2D<vec3>& frame);

  // Error map of the first frame.
  const Image2D<float>& flip() const { return flip_; }

  // Cells psnr, ssim, flip, flip_exposure_start and flip_exposure_stop. At least one frame.
  void report(Row& row) const;

 private:
  float display_factor() const;

  const Image2D<vec3>& reference_;
  metrics::FlipExposures exposures_;
  Image2D<vec3> shown_;  // the reference on a display
  Image2D<float> flip_;
  double frames_ = 0.0, psnr_ = 0.0, ssim_ = 0.0;  // sums
};

}  // namespace hybray::caustics_parts
