#include "core/base/develop.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace {

float luminance(const vec3& c) {
  return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace

float automatic_exposure(const Image2D<vec3>& radiance) {
  double sum = 0.0;
  for (const vec3& c : radiance) sum += std::log(1e-3 + static_cast<double>(luminance(c)));
  return static_cast<float>(0.11 / std::exp(sum / static_cast<double>(radiance.size())));
}

std::vector<uint8_t> develop(const Image2D<vec3>& radiance, float exposure) {
  std::vector<uint8_t> rgb;
  rgb.reserve(3 * radiance.size());
  for (const vec3& c : radiance)
    for (int k = 0; k < 3; ++k) {
      const float x = exposure * c[k];
      const float y = std::min(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f);
      const float encoded = y <= 0.0031308f ? 12.92f * y : 1.055f * std::pow(y, 1.0f / 2.4f) - 0.055f;
      rgb.push_back(static_cast<uint8_t>(std::lround(255.0f * encoded)));
    }
  return rgb;
}

}  // namespace hybray
