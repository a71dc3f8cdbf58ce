#include "core/caustics/fixed_point_image.h"

#include "core/base/check.h"

#include <algorithm>

namespace hybray::caustics {

FixedPointImage::FixedPointImage(int width, int height, double largest)
    : width_(width), height_(height), scale_(0x1p61 / largest) {
  HYBRAY_CHECK_LT(0.0, largest);
  sums_.assign(3 * static_cast<size_t>(width) * static_cast<size_t>(height), 0);
}

Image2D<vec3> FixedPointImage::image(double factor) const {
  Image2D<vec3> result(width_, height_);
  const double unit = factor / scale_;
  for (size_t i = 0; i < result.size(); ++i)
    for (size_t c = 0; c < 3; ++c)
      result[i][static_cast<int>(c)] = static_cast<float>(static_cast<double>(sums_[3 * i + c]) * unit);
  return result;
}

double FixedPointImage::peak_fraction() const {
  const auto peak = std::max_element(sums_.begin(), sums_.end());
  return peak == sums_.end() ? 0.0 : static_cast<double>(*peak) / kLimit;
}

}  // namespace hybray::caustics
