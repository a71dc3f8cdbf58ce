// A closer look at the same light paths as photon_trace.h's, segment by segment: what the counts of a walk do
// not tell.
#pragma once

#include "core/caustics/emission.h"
#include "core/caustics/path_walk.h"

#include <vector>

namespace hybray::caustics {

struct PathAudit {
  uint64_t segments = 0;
  // Segments that end where no straight line does: on the triangle that they start from; on the analytic
  // surface that they start from, though they leave it on its convex side, or reach it from there.
  uint64_t self_intersections = 0;
  // Flux that arrived at diffuse surfaces after a specular event, by the medium that its path was in, W.
  std::vector<double> arrived;
};

// Walks paths [first, first + count) of `emission`, their first surfaces traced; the same at any number of
// threads.
PathAudit audit_paths(const Tracer& tracer, const optics::OpticsTable& optics, const Emission& emission,
                      uint16_t start_medium, const WalkOptions& options, uint64_t first, uint64_t count);

}  // namespace hybray::caustics
