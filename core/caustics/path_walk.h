// The walk of a path from specular surface to specular surface, the same for light paths and camera paths:
// packets of segments, the three outcomes at a surface (specular, diffuse, mixed), Russian roulette, and the
// account of the weight (caustics paper, "Illumination caustics", outcomes 1 to 3, Figure 4a).
#pragma once

#include "core/base/hash.h"
#include "core/caustics/photon.h"
#include "core/optics/specular_step.h"
#include "core/tracer/tracer.h"

#include <array>
#include <cmath>

namespace hybray::caustics {

struct WalkOptions {
  int max_events = 8;  // greatest number of specular events, >= 1 ("mirror depth")
  // A path whose weight has fallen below this share of its initial weight survives with a probability that
  // brings it back to it (Russian roulette).
  double roulette_threshold = 0.25;
  TraceMode mode = TraceMode::packet16_coherent;
  uint64_t seed = 1;
};

struct Path {
  dvec3 weight{0.0};     // flux or importance, by channel
  double initial = 0.0;  // mean weight at the start
  double length = 0.0;   // metres gone
  uint64_t number = 0;   // counter of the random numbers
  uint32_t pixel = 0;    // of camera paths
  uint16_t medium = 0;
  uint16_t events = 0;  // specular events so far
  bool in_map = false;  // of light paths: left through an active texel
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

// Paths of one block under way. Rays stand apart from the rest, as the tracer reads them.
struct PathFront {
  static constexpr size_t kSize = 1024;  // keeps packets well filled for several events
  std::array<vec3, kSize> origins, directions;
  std::array<Hit, kSize> hits;
  std::array<Path, kSize> paths;
  size_t count = 0;

  void push(const dvec3& origin, const dvec3& direction, const Path& path) {
    origins[count] = vec3(origin), directions[count] = vec3(direction);
    paths[count++] = path;
  }
};

class PathWalk {
 public:
  // Random numbers of event e of a path have dimensions kFirstDimension + 2 e and the next; those before are
  // free for the path's start.
  static constexpr uint32_t kFirstDimension = 8;

  PathWalk(const Tracer& tracer, const optics::OpticsTable& optics, const WalkOptions& options,
           WalkCounts& counts)
      : tracer_(tracer), optics_(optics), options_(options), counts_(counts) {}

  // Traces every ray of the front one segment further; paths that go on are moved together, in order.
  // on_diffuse(point, facing, direction, path, surface) is called where a path meets a diffuse part, before
  // anything of it goes on.
  template <class OnDiffuse>
  void advance(PathFront& front, const OnDiffuse& on_diffuse) {
    tracer_.intersect_batch(std::span(front.origins).first(front.count),
                            std::span(front.directions).first(front.count),
                            std::span(front.hits).first(front.count), options_.mode);
    counts_.rays += front.count;
    const size_t before = front.count;
    front.count = 0;
    for (size_t i = 0; i < before; ++i) {
      prefetch(front, i, before);
      Path& path = front.paths[i];
      const Hit& hit = front.hits[i];
      if (!hit.valid()) {
        counts_.ledger.escaped += optics::mean(path.weight);
        continue;
      }
      const double t = static_cast<double>(hit.t);
      dvec3 direction(front.directions[i]), origin = dvec3(front.origins[i]) + t * direction;
      const SurfacePoint point = optics_.surfaces.point(hit.primitive, hit.u, hit.v, origin);
      if (meet(point, t, origin, direction, path, on_diffuse)) front.push(origin, direction, path);
    }
  }

  // The path meets a surface after `length` metres. Returns whether it goes on, from `origin` along
  // `direction`.
  template <class OnDiffuse>
  [[gnu::always_inline]] bool meet(const SurfacePoint& point, double length, dvec3& origin, dvec3& direction,
                                   Path& path, const OnDiffuse& on_diffuse) {
    FluxLedger& ledger = counts_.ledger;
    const optics::SurfaceOptics& surface = optics_.materials[point.material];
    const optics::Facing facing = optics::facing(point, direction);
    path.length += length;
    absorb(length, path);
    if (surface.interface)
      counts_.medium_mismatches +=
          path.medium != (facing.from_inner ? surface.inner_medium : surface.outer_medium);

    const double arriving = optics::mean(path.weight);
    if (!surface.specular) {
      const double entry = surface.diffuse ? arriving * surface.base : 0.0;
      ledger.absorbed += arriving - entry;
      if (entry > 0.0) {
        (path.events == 0 ? ledger.direct : ledger.deposited) += entry;
        on_diffuse(point, facing, direction, path, surface);
      }
      return false;
    }
    const optics::SpecularSplit split = optics::split(surface, facing.cos_incident, facing.from_inner);
    const double entry = surface.diffuse ? arriving * split.base_entry : 0.0;
    if (entry > 0.0) {
      (path.events == 0 ? ledger.direct : ledger.deposited) += entry;
      on_diffuse(point, facing, direction, path, surface);
    }
    const optics::SpecularShares shares(split, path.weight);
    const double specular = shares.mean_back + shares.mean_through;
    ledger.absorbed += arriving - entry - specular;
    if (!(specular > 0.0)) return false;
    if (path.events >= options_.max_events) {
      ledger.truncated += specular;
      return false;
    }
    const double after = go_on(point, surface, facing, shares, origin, direction, path);
    ledger.balance += specular - after;
    return after > 0.0;
  }

 private:
  // Hits are scattered over memory: what the next ones need is on its way while one is worked on.
  void prefetch(const PathFront& front, size_t i, size_t count) const {
    constexpr size_t kEntryAhead = 8, kNormalsAhead = 4;
    if (i + kEntryAhead < count) optics_.surfaces.prefetch_entry(front.hits[i + kEntryAhead].primitive);
    if (i + kNormalsAhead < count) optics_.surfaces.prefetch_normals(front.hits[i + kNormalsAhead].primitive);
  }

  void absorb(double length, Path& path) {
    const dvec3& a = optics_.media[path.medium].absorption;
    if (a == dvec3(0.0)) return;
    const dvec3 kept =
        path.weight * dvec3(std::exp(-a.x * length), std::exp(-a.y * length), std::exp(-a.z * length));
    counts_.ledger.absorbed += optics::mean(path.weight) - optics::mean(kept);
    path.weight = kept;
  }

  // Chooses the event, then whether the path survives it. Returns its mean weight afterwards.
  [[gnu::always_inline]] double go_on(const SurfacePoint& point, const optics::SurfaceOptics& surface,
                                      const optics::Facing& facing, const optics::SpecularShares& shares,
                                      dvec3& origin, dvec3& direction, Path& path) const {
    const uint32_t dimension = kFirstDimension + 2u * path.events;
    const optics::SpecularChoice next =
        optics::choose_specular(surface, point, facing, shares, direction, path.medium,
                                random_unit(path.number, dimension, 0, options_.seed));
    double after = shares.mean_back + shares.mean_through;
    path.weight = next.weight;
    const double wanted = options_.roulette_threshold * path.initial;
    if (after < wanted) {
      if (!(random_unit(path.number, dimension + 1, 0, options_.seed) * wanted < after)) return 0.0;
      path.weight *= wanted / after;
      after = optics::mean(path.weight);
    }
    path.medium = next.medium;
    ++path.events;
    origin = next.origin, direction = next.direction;
    return after;
  }

  const Tracer& tracer_;
  const optics::OpticsTable& optics_;
  const WalkOptions& options_;
  WalkCounts& counts_;
};

}  // namespace hybray::caustics
