// Marcher `layers` without its machinery: every pixel along the ray, in double precision, no pyramids and no
// skipping. What march_layers must agree with, but for rays within rounding of a decision.
#pragma once

#include "core/ssrm/march_layers.h"

namespace hybray::truth {

// One ray (a float ray, promoted).
ssrm::LayerHit march_layers_level0(const ssrm::LayeredView& view, const ssrm::ScreenRay<double>& ray,
                                   uint32_t pixel, const ssrm::LayerOptions& options);

}  // namespace hybray::truth
