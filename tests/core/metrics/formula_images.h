// Images by a formula in whole numbers, whose values are floats exactly, so that another program computes the
// same ones. What published implementations say of them stands in the tests.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hybray::test {

constexpr int kFormulaWidth = 64, kFormulaHeight = 48;

// Ramps that rise and fall, with steps at the borders of tiles of 16 x 12 pixels; 0 to 240.
inline int formula_reference(int x, int y, int channel) {
  const int at = (2 * x + (channel + 1) * y) % 200;
  return (at < 100 ? at : 200 - at) + (x / 16 + y / 12) % 2 * (90 + 20 * channel);
}

// The same with noise on the left, in eight levels in the middle, untouched on the right but for a white
// spot.
inline int formula_test(int x, int y, int channel) {
  const int value = formula_reference(x, y, channel);
  if (std::abs(x - 52) <= 1 && std::abs(y - 24) <= 1) return 255;
  if (x < 22)
    return std::clamp(value + (7 * x * x + 13 * y * y + 3 * x * y + 29 * channel) % 32 - 16, 0, 255);
  return x < 44 ? value - value % 32 : value;
}

// value / 256 times 2^stops(x).
template <class Formula, class Stops>
Image2D<vec3> formula_image(const Formula& value, const Stops& stops) {
  Image2D<vec3> image(kFormulaWidth, kFormulaHeight);
  for (int y = 0; y < kFormulaHeight; ++y)
    for (int x = 0; x < kFormulaWidth; ++x)
      for (int c = 0; c < 3; ++c)
        image(x, y)[c] = std::ldexp(static_cast<float>(value(x, y, c)), stops(x) - 8);
  return image;
}

// In [0, 1).
template <class Formula>
Image2D<vec3> display_range(const Formula& value) {
  return formula_image(value, [](int) { return 0; });
}

// Stripes of 8 pixels that are 2^-2 to 2^4 times as bright; 0 to 15.
template <class Formula>
Image2D<vec3> high_range(const Formula& value) {
  return formula_image(value, [](int x) { return x / 8 % 7 - 2; });
}

// The same, black from x = 24 on: 62.5 % of the image.
template <class Formula>
Image2D<vec3> mostly_black(const Formula& value) {
  return high_range([&](int x, int y, int c) { return x < 24 ? value(x, y, c) : 0; });
}

}  // namespace hybray::test
