// The walk of a path from specular surface to specular surface, the same for light paths and camera paths:
// packets of segments, the three outcomes at a surface (specular, diffuse, mixed), Russian roulette, and the
// account of the weight (caustics paper, "Illumination caustics", outcomes 1 to 3, Figure 4a).
#pragma once

#include "core/caustics/path_front.h"
#include "core/caustics/path_walk_lanes.h"
#include "core/caustics/photon.h"
#include "core/scene/surface_point.h"
#include "core/tracer/tracer.h"

namespace hybray::caustics {

// Random numbers of event e of a path have dimensions kFirstWalkDimension + 2 e and the next; those before
// are free for the path's start.
inline constexpr uint32_t kFirstWalkDimension = 8;

struct WalkOptions {
  int max_events = 8;  // greatest number of specular events, >= 1 ("mirror depth")
  // A path whose weight has fallen below this share of its initial weight survives with a probability that
  // brings it back to it (Russian roulette).
  double roulette_threshold = 0.25;
  LeavingOffset leaving = LeavingOffset::largest;  // how far off a surface a path goes on
  TraceMode mode = TraceMode::packet16_coherent;
  uint64_t seed = 1;
};

struct WalkCounts {
  FluxLedger ledger;
  uint64_t rays = 0;
  uint64_t medium_mismatches = 0;  // interfaces met from a medium other than theirs

  void add(const WalkCounts& other) {
    ledger.add(other.ledger);
    rays += other.rays;
    medium_mismatches += other.medium_mismatches;
  }
};

// What one thread needs to walk paths.
class WalkMemory {
 public:
  PathFront& front() { return fronts_[current_]; }
  PathFront& next() { return fronts_[1 - current_]; }
  void swap() { current_ = 1 - current_; }
  Arrivals arrivals;  // of the last segment
  LeftPaths left;
  PathFront::Lanes<uint32_t> texels;  // of paths that start

 private:
  PathFront fronts_[2];
  int current_ = 0;
};

class PathWalk {
 public:
  PathWalk(const Tracer& tracer, const optics::OpticsTable& optics, const WalkOptions& options,
           WalkCounts& counts);

  // Traces every ray of the front one segment further and lets the paths meet what they hit. Paths that go on
  // are the new front, after those that lie in next() already. Those that met a diffuse part after a specular
  // event are the memory's new arrivals, as they were before anything of them went on.
  // What was the front stays where it is, in next(), with its hits, until the next step.
  void advance(WalkMemory& memory) const;

  // The same with the hits that the front has already.
  void meet_hits(WalkMemory& memory) const;

  // The path goes `length` metres through its medium (Beer-Lambert).
  void travel(double length, Path& path) const;

  // The path meets a surface. Returns whether it goes on, from `origin` along `direction`; appends its
  // arrival at a diffuse part, after a specular event, to `arrivals`.
  bool meet(const SurfacePoint& point, dvec3& origin, dvec3& direction, Path& path, Arrivals& arrivals) const;

 private:
  const Tracer& tracer_;
  const optics::OpticsTable& optics_;
  const WalkOptions& options_;
  WalkCounts& counts_;
};

}  // namespace hybray::caustics
