// Depth as a renderer stores it: a number format, and which way it rounds.
#pragma once

#include "core/gbuffer/gbuffer.h"

namespace hybray {

enum class DepthFormat : uint8_t {
  float32,
  unorm24,  // k / (2^24 - 1), k a whole number
  unorm16,  // k / (2^16 - 1)
};

enum class DepthRounding : uint8_t {
  nearest,  // what graphics hardware does
  viewer,   // to the stored value next to the true one on the viewer's side, so that nothing is stored behind
            // where it is
};

struct DepthStorage {
  DepthFormat format = DepthFormat::float32;
  DepthRounding rounding = DepthRounding::nearest;
};

// A device depth in [0, 1] as a shader reads it back from the buffer.
float stored_depth(double device_depth, DepthConvention convention, const DepthStorage& storage);

// Stores all depths of `g` anew, from the planes of what its pixels see, in double. Needs the depth and
// primitive buffers, made for `scene`; pixels whose plane cannot be used, and background, stay as they are.
// All threads.
void store_depths(GBuffer& g, const Scene& scene, const DepthStorage& storage);

}  // namespace hybray
