#include "core/metrics/hdr_flip.h"

#include "core/base/develop.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/metrics/image_error.h"
#include "core/metrics/radiance_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace hybray::metrics {
namespace {

// The fit's own exposure, so that its curve begins where others do.
constexpr float kPreExposure = 0.6f;

Image2D<vec3> shown(const Image2D<vec3>& radiance, double stops) {
  const float factor = exposure_factor(stops);
  Image2D<vec3> image(radiance.width(), radiance.height());
  parallel_blocks(image.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) image[i][k] = filmic(factor * radiance[i][k]);
  });
  return image;
}

// The radiance that comes out as `white`: the positive root of the curve's quadratic.
double radiance_shown_as(double white) {
  using F = FilmicCurve;
  const double a = double{F::a} - white * double{F::c}, b = double{F::b} - white * double{F::d},
               c = -white * double{F::e};
  return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a) / double{kPreExposure};
}

// The upper one of the two in the middle where their number is even, as in the authors' program.
double upper_median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

}  // namespace

float exposure_factor(double stops) {
  return kPreExposure * static_cast<float>(std::exp2(stops));
}

FlipExposures flip_exposures(const Image2D<vec3>& reference) {
  require_radiance(reference, "reference");
  std::vector<float> values;
  double sum = 0.0;
  for (const vec3& v : reference) {
    values.push_back(luminance(v));
    sum += static_cast<double>(values.back());
  }
  const double most = static_cast<double>(*std::max_element(values.begin(), values.end()));
  if (!(most > 0.0)) throw InputError("reference", "it is black: no exposure shows anything of it");
  const double floor = kFloorFraction * sum / static_cast<double>(values.size());
  double median = upper_median(values);
  if (median < floor) {
    std::erase_if(values, [&](float v) { return static_cast<double>(v) < floor; });
    median = upper_median(values);
  }
  const double target = radiance_shown_as(0.85);
  FlipExposures exposures{std::log2(target / most), std::log2(target / median), 2};
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

Image2D<float> hdr_flip(const Image2D<vec3>& image, const Image2D<vec3>& reference,
                        const FlipExposures& exposures, double pixels_per_degree) {
  if (!(std::isfinite(exposures.start) && std::isfinite(exposures.stop) &&
        exposures.start <= exposures.stop && exposures.count >= 1))
    throw InputError("exposures", fmt::format("{} from {} to {} stops are no series that rises",
                                              exposures.count, exposures.start, exposures.stop));
  require_radiance(reference, "reference");
  require_size(image, "image", reference.width(), reference.height(), "the reference");
  require_radiance(image, "image");
  Image2D<float> worst(image.width(), image.height());
  for (int i = 0; i < exposures.count; ++i) {
    const double share = exposures.count > 1 ? static_cast<double>(i) / (exposures.count - 1) : 0.0;
    const double stops = exposures.start + share * (exposures.stop - exposures.start);
    const Image2D<float> error = flip(shown(image, stops), shown(reference, stops), pixels_per_degree);
    for (size_t p = 0; p < worst.size(); ++p) worst[p] = std::max(worst[p], error[p]);
  }
  return worst;
}

}  // namespace hybray::metrics
