// Through how many surfaces a view would have to look to see what rays truly hit.
#pragma once

#include "core/truth/ray_truth.h"

namespace hybray::truth {

constexpr uint8_t kNotSeen = 255;

// For each ray the number of surfaces between the eye and its true hit, or kNotSeen where there are `layers`
// of them or more, where the hit lies outside the view volume, or where there is none. With one layer, 0 is
// RayTruth::visible by the same rule. `tracer`: built with Tracer::Config::layers; all threads.
std::vector<uint8_t> layers_of_hits(const Tracer& tracer, const RayStream& rays, const HitStream& hits,
                                    const View& view, int layers);

}  // namespace hybray::truth
