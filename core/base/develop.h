// From radiance to a picture for people: exposure, filmic curve, sRGB.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <cstdint>
#include <vector>

namespace hybray {

// Factor that brings the geometric mean of the image's luminance to a middle grey.
float automatic_exposure(const Image2D<vec3>& radiance);

// Rec. 709 luminance of linear RGB.
float luminance(const vec3& linear);

// Narkowicz's fit of the ACES curve, clamped to [0, 1]. Any x >= 0, infinity included.
float filmic(float x);

// Coefficients of that curve before the clamp: x (a x + b) / (x (c x + d) + e).
struct FilmicCurve {
  static constexpr float a = 2.51f, b = 0.03f, c = 2.43f, d = 0.59f, e = 0.14f;
};

// What a display shows of radiance times exposure: filmic curve, sRGB encoding; in [0, 1], not rounded to
// bits.
Image2D<vec3> display_image(const Image2D<vec3>& radiance, float exposure);

// The same in width x height pixels of 8-bit sRGB, row by row.
std::vector<uint8_t> develop(const Image2D<vec3>& radiance, float exposure);

}  // namespace hybray
