#include "harness/experiments/caustics_display_error.h"

#include "core/base/develop.h"
#include "core/metrics/ssim.h"

#include <algorithm>
#include <cmath>

namespace hybray::caustics_parts {

DisplayErrors::DisplayErrors(const Image2D<vec3>& reference, const metrics::FlipExposures& exposures)
    : reference_(reference), exposures_(exposures), shown_(display_image(reference, display_factor())) {}

float DisplayErrors::display_factor() const {
  return metrics::exposure_factor(0.5 * (exposures_.start + exposures_.stop));
}

void DisplayErrors::add(const Image2D<vec3>& frame) {
  if (frames_ == 0.0) flip_ = metrics::hdr_flip(frame, reference_, exposures_);
  const Image2D<vec3> shown = display_image(frame, display_factor());
  psnr_ += metrics::psnr(shown, shown_);
  if (std::min(shown.width(), shown.height()) >= metrics::kSsimWindow) ssim_ += metrics::ssim(shown, shown_);
  frames_ += 1.0;
}

void DisplayErrors::report(Row& row) const {
  // A frame that cannot be told from the reference has no finite ratio.
  if (std::isfinite(psnr_)) row["psnr"] = psnr_ / frames_;
  if (std::min(shown_.width(), shown_.height()) >= metrics::kSsimWindow) row["ssim"] = ssim_ / frames_;
  row["flip"] = metrics::mean_error(flip_);
  row["flip_exposure_start"] = exposures_.start;
  row["flip_exposure_stop"] = exposures_.stop;
}

}  // namespace hybray::caustics_parts
