// MapEmission::start for many paths at once, in as many lanes as the machine has: the same bits.
#pragma once

#include "core/caustics/emission.h"
#include "core/caustics/path_front.h"

#include <span>

namespace hybray::caustics {

// Appends paths [first, first + count) <= emission.paths to `to`, but those of no
// flux; a front's room limits them. `texels` gets the index of each path's texel in the map, at the path's
// place in the front. Returns the sum of their initial weights, W.
double start_map_paths(const MapEmission& emission, uint64_t first, size_t count, uint16_t medium,
                       PathFront& to, std::span<uint32_t, PathFront::kAllocated> texels);

}  // namespace hybray::caustics
