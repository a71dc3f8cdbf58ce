// Forward tracing of caustic light paths, in packets, all threads (caustics paper, "Illumination caustics",
// Figure 4).
#pragma once

#include "core/caustics/emission.h"
#include "core/caustics/path_walk.h"
#include "core/caustics/photon_blocks.h"

namespace hybray::caustics {

// How the first surface of a path that leaves through a map's texel is found.
enum class FirstSurface : uint8_t {
  stored,  // the plane of the triangle that the texel's centre sees, without a ray, as the paper does
  traced,  // one ray more
};

// Photons with their account: block by block of paths, within a block by the segment that left them.
struct PhotonList {
  PhotonBlocks photons;
  WalkCounts counts;
  uint64_t paths = 0;
};

// Traces paths [first, first + count) of `emission` and appends what they leave behind to `out`, the same
// at any number of threads. `start_medium` is the medium that the light lies in
// (medium_at). `map` is the one that the emission was made with.
void trace_photons(const Tracer& tracer, const optics::OpticsTable& optics, const Emission& emission,
                   const VisibilityMap& map, FirstSurface first_surface, uint16_t start_medium,
                   const WalkOptions& options, uint64_t first, uint64_t count, PhotonList& out);

}  // namespace hybray::caustics
