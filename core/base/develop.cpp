#include "core/base/develop.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace hybray {
namespace {

float encoded(float x) {
  const float y = filmic(x);
  return y <= 0.0031308f ? 12.92f * y : 1.055f * std::pow(y, 1.0f / 2.4f) - 0.055f;
}

}  // namespace

float luminance(const vec3& linear) {
  return glm::dot(linear, vec3(0.2126f, 0.7152f, 0.0722f));
}

float filmic(float x) {
  using F = FilmicCurve;
  x = std::min(x, 1e6f);  // white long before; the squares of greater values overflow
  return std::min(x * (F::a * x + F::b) / (x * (F::c * x + F::d) + F::e), 1.0f);
}

float automatic_exposure(const Image2D<vec3>& radiance) {
  double sum = 0.0;
  for (const vec3& c : radiance) sum += std::log(1e-3 + static_cast<double>(luminance(c)));
  return static_cast<float>(0.11 / std::exp(sum / static_cast<double>(radiance.size())));
}

Image2D<vec3> display_image(const Image2D<vec3>& radiance, float exposure) {
  Image2D<vec3> display(radiance.width(), radiance.height());
  parallel_blocks(display.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) display[i][k] = encoded(exposure * radiance[i][k]);
  });
  return display;
}

std::vector<uint8_t> develop(const Image2D<vec3>& radiance, float exposure) {
  std::vector<uint8_t> rgb;
  rgb.reserve(3 * radiance.size());
  for (const vec3& c : display_image(radiance, exposure))
    for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<uint8_t>(std::lround(255.0f * c[k])));
  return rgb;
}

}  // namespace hybray
