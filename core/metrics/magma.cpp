#include "core/metrics/magma.h"

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace hybray::metrics {
namespace {

// Every 17th of the published 256 colours, rounded; between them it is close to straight lines.
constexpr int kKnots = 16;
constexpr float kColors[kKnots][3] = {
    {0.001f, 0.000f, 0.014f}, {0.044f, 0.034f, 0.142f}, {0.124f, 0.067f, 0.296f}, {0.232f, 0.060f, 0.438f},
    {0.341f, 0.081f, 0.493f}, {0.445f, 0.123f, 0.507f}, {0.550f, 0.161f, 0.506f}, {0.658f, 0.196f, 0.490f},
    {0.767f, 0.234f, 0.458f}, {0.869f, 0.288f, 0.409f}, {0.944f, 0.378f, 0.365f}, {0.981f, 0.498f, 0.370f},
    {0.995f, 0.624f, 0.427f}, {0.997f, 0.748f, 0.517f}, {0.993f, 0.870f, 0.626f}, {0.987f, 0.991f, 0.750f}};

}  // namespace

std::vector<uint8_t> magma(const Image2D<float>& values) {
  std::vector<uint8_t> rgb;
  rgb.reserve(3 * values.size());
  for (const float value : values) {
    const float at = std::clamp(value, 0.0f, 1.0f) * (kKnots - 1);
    const int below = std::min(static_cast<int>(at), kKnots - 2);
    for (int c = 0; c < 3; ++c) {
      const float color = glm::mix(kColors[below][c], kColors[below + 1][c], at - static_cast<float>(below));
      rgb.push_back(static_cast<uint8_t>(std::lround(255.0f * color)));
    }
  }
  return rgb;
}

}  // namespace hybray::metrics
