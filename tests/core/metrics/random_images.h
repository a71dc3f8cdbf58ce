// Images of noise whose moments are known.
#pragma once

#include "core/base/hash.h"
#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <cmath>
#include <numbers>

namespace hybray::test {

// Standard normal number of a counter, by Box and Muller.
inline double random_normal(uint64_t item, uint32_t sample, uint64_t seed) {
  const double u = 1.0 - random_unit(item, 0, sample, seed), v = random_unit(item, 1, sample, seed);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

// Every channel of every pixel is mean + sigma * (standard normal), independent. mean is many sigma above
// zero.
inline Image2D<vec3> gaussian_image(int width, int height, double mean, double sigma, uint32_t sample,
                                    uint64_t seed) {
  Image2D<vec3> image(width, height);
  for (size_t i = 0; i < image.size(); ++i)
    for (int c = 0; c < 3; ++c)
      image[i][c] =
          static_cast<float>(mean + sigma * random_normal(3 * i + static_cast<uint64_t>(c), sample, seed));
  return image;
}

}  // namespace hybray::test
