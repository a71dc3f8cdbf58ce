#include "core/caustics/wavelet_filter.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/caustics/wavelet_level.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hybray::caustics {
namespace {

constexpr float kLeastAlbedo = 1e-4f;  // radiance divided by less would be mostly rounding
constexpr int kMomentLevels = 2, kPilotLevels = 3;
// Variance of an image of unit noise after the first two scales on a plane: sum of the squared taps of the
// two B3 kernels' convolution, (sum of squares in one dimension)^2.
constexpr float kSmoothedVariance = 0.015246f;

void require_settings(const Image2D<vec3>& radiance, const GBuffer& guide,
                      const WaveletFilterSettings& settings, const Image2D<vec3>* albedo) {
  const auto require = [](bool condition, const char* message) {
    if (!condition) throw InputError("filter", message);
  };
  require(settings.iterations >= 0 && settings.iterations <= 10, "iterations must be in [0, 10]");
  require(settings.normal_power >= 0.0f && std::isfinite(settings.normal_power),
          "normal_power must be finite and at least 0");
  require(settings.plane_sigma > 0.0f && std::isfinite(settings.plane_sigma),
          "plane_sigma must be finite and above 0");
  require(settings.luminance_sigma > 0.0f &&
              (settings.luminance_sigma <= 1e6f || std::isinf(settings.luminance_sigma)),
          "luminance_sigma must be above 0 and at most 1e6, or infinity");
  const auto fits = [&](const Image2D<vec3>& image) {
    return image.width() == guide.view.width() && image.height() == guide.view.height();
  };
  require(fits(radiance), "the image and the G-buffer must be of the same size");
  require(!albedo || fits(*albedo), "the albedo and the G-buffer must be of the same size");
  for (size_t size : {guide.depth.size(), guide.geometric_normal.size(), guide.shading_normal.size(),
                      guide.material.size()})
    HYBRAY_CHECK_EQ(size, radiance.size());
}

// Mean of the channels, scaled to [0, 1] so that its square neither overflows nor vanishes.
std::vector<float> scaled_luminance(const Planes<3>& image) {
  std::vector<float> luminance(image[0].size());
  float largest = 0.0f;
  for (size_t i = 0; i < luminance.size(); ++i) {
    luminance[i] = image[0][i] / 3.0f + image[1][i] / 3.0f + image[2][i] / 3.0f;
    largest = std::max(largest, luminance[i]);
  }
  if (largest > 0.0f)
    for (float& l : luminance) l /= largest;
  return luminance;
}

LuminanceGuide pilot(const Planes<3>& image, const FilterGuide& guide, float luminance_sigma) {
  Planes<1> noisy{scaled_luminance(image)};
  Planes<2> moments{noisy[0], noisy[0]};
  for (float& m : moments[1]) m *= m;
  for (int level = 0; level < kMomentLevels; ++level) moments = wavelet_level(moments, guide, nullptr, level);

  LuminanceGuide result{std::move(moments[0]), std::move(moments[1])};
  const float factor = luminance_sigma * luminance_sigma * kSmoothedVariance;
  for (size_t i = 0; i < guide.size(); ++i)
    result.allowed[i] =
        factor * std::max(0.0f, result.allowed[i] - result.luminance[i] * result.luminance[i]);
  for (int level = 0; level < kPilotLevels; ++level) noisy = wavelet_level(noisy, guide, &result, level);
  result.luminance = std::move(noisy[0]);
  return result;
}

}  // namespace

Image2D<vec3> filter_wavelet(const Image2D<vec3>& radiance, const GBuffer& guide,
                             const WaveletFilterSettings& settings, const Image2D<vec3>* albedo) {
  require_settings(radiance, guide, settings, albedo);
  if (settings.iterations == 0 || radiance.empty()) return radiance;

  const FilterGuide filter_guide(guide, settings);
  Planes<3> image;
  for (size_t c = 0; c < 3; ++c) {
    image[c].resize(radiance.size());
    for (size_t i = 0; i < radiance.size(); ++i) {
      const int k = static_cast<int>(c);
      const float a = albedo ? (*albedo)[i][k] : 1.0f;
      image[c][i] = a >= kLeastAlbedo ? radiance[i][k] / a : 0.0f;
    }
  }
  LuminanceGuide brightness;
  const bool compare = std::isfinite(settings.luminance_sigma);
  if (compare) brightness = pilot(image, filter_guide, settings.luminance_sigma);
  for (int level = 0; level < settings.iterations; ++level)
    image = wavelet_level(image, filter_guide, compare ? &brightness : nullptr, level);

  Image2D<vec3> result = radiance;
  for (size_t i = 0; i < result.size(); ++i) {
    if (guide.material[i] == kNoPrimitive) continue;
    for (int c = 0; c < 3; ++c) {
      const float a = albedo ? (*albedo)[i][c] : 1.0f, filtered = image[static_cast<size_t>(c)][i];
      if (a >= kLeastAlbedo) result[i][c] = albedo ? filtered * a : filtered;
    }
  }
  return result;
}

}  // namespace hybray::caustics
