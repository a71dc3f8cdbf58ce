// From radiance to a picture for people: exposure, filmic curve, sRGB.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <cstdint>
#include <vector>

namespace hybray {

// Factor that brings the geometric mean of the image's luminance to a middle grey.
float automatic_exposure(const Image2D<vec3>& radiance);

// width x height pixels of 8-bit sRGB, row by row: radiance times exposure through a filmic curve
// (Narkowicz's fit of ACES).
std::vector<uint8_t> develop(const Image2D<vec3>& radiance, float exposure);

}  // namespace hybray
