// One scale of the edge-avoiding a-trous wavelet transform (wavelet_filter.h), row by row so that the loop
// over a row's pixels is vectorised.
#pragma once

#include "core/caustics/wavelet_filter.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybray::caustics {

// What the weights read, by pixel: a plane of the image each.
struct FilterGuide {
  FilterGuide(const GBuffer& gbuffer, const WaveletFilterSettings& settings);

  size_t size() const { return material.size(); }

  int width, height;
  float normal_power;
  bool gather;
  std::vector<float> point_x, point_y, point_z;     // relative to the eye, in world directions, metres
  std::vector<float> plane_x, plane_y, plane_z;     // geometric normal
  std::vector<float> normal_x, normal_y, normal_z;  // shading normal
  std::vector<float> inverse_sigma;                 // 1 / (plane_sigma * footprint), 1/m
  std::vector<uint32_t> material;                   // kNoPrimitive: background
};

// An image to compare brightness in, and its precision.
struct LuminanceGuide {
  std::vector<float> luminance;
  std::vector<float> allowed;  // luminance_sigma^2 * variance of `luminance`
};

template <size_t Channels>
using Planes = std::array<std::vector<float>, Channels>;

// The image one scale on, from taps 2^level pixels apart. `luminance` may be null. Defined for 1 to 3
// channels.
template <size_t Channels>
Planes<Channels> wavelet_level(const Planes<Channels>& image, const FilterGuide& guide,
                               const LuminanceGuide* luminance, int level);

}  // namespace hybray::caustics
