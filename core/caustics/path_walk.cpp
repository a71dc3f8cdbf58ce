#include "core/caustics/path_walk.h"

#include "core/base/check.h"
#include "core/base/exponential.h"
#include "core/base/hash.h"
#include "core/optics/specular_step.h"

namespace hybray::caustics {
namespace {

Photon photon_of(const SurfacePoint& point, const optics::Facing& facing, const dvec3& direction,
                 const Path& path) {
  Photon photon;
  photon.position = vec3(point.position), photon.cos_in = static_cast<float>(facing.cos_incident);
  photon.normal = vec3(facing.geometric), photon.material = point.material;
  photon.direction = vec3(direction), photon.primitive = point.primitive;
  photon.flux = vec3(path.weight);
  photon.events = path.events, photon.missed_by_map = !path.in_map;
  return photon;
}

// Chooses the event, then whether the path survives it. Returns its mean weight afterwards.
double go_on(const WalkOptions& options, const SurfacePoint& point, const optics::SurfaceOptics& surface,
             const optics::Facing& facing, const optics::SpecularShares& shares, dvec3& origin,
             dvec3& direction, Path& path) {
  const uint32_t dimension = kFirstWalkDimension + 2u * path.events;
  const optics::SpecularChoice next =
      optics::choose_specular(surface, point, facing, shares, direction, path.medium,
                              random_unit(path.number, dimension, 0, options.seed));
  double after = shares.mean_back + shares.mean_through;
  path.weight = next.weight;
  const double wanted = options.roulette_threshold * path.initial;
  if (after < wanted) {
    if (!(random_unit(path.number, dimension + 1, 0, options.seed) * wanted < after)) return 0.0;
    path.weight *= wanted / after;
    after = optics::mean(path.weight);
  }
  path.medium = next.medium;
  ++path.events;
  origin = next.origin, direction = next.direction;
  return after;
}

}  // namespace

PathWalk::PathWalk(const Tracer& tracer, const optics::OpticsTable& optics, const WalkOptions& options,
                   WalkCounts& counts)
    : tracer_(tracer), optics_(optics), options_(options), counts_(counts) {
  HYBRAY_CHECK_LE(1, options.max_events);
  HYBRAY_CHECK_LT(options.max_events, static_cast<int>(path_tag::kEvents));
}

void PathWalk::advance(WalkMemory& memory) const {
  PathFront& front = memory.front();
  tracer_.intersect_batch(front.rays.lanes(), front.count, front.hits.lanes(), options_.mode);
  counts_.rays += front.count;
  meet_hits(memory);
}

void PathWalk::meet_hits(WalkMemory& memory) const {
  PathFront& front = memory.front();
  memory.arrivals.count = 0, memory.left.count = 0;
  meet_triangles(optics_, options_, front, memory.next(), memory.arrivals, memory.left, counts_);
  for (size_t j = 0; j < memory.left.count; ++j) {
    const size_t i = memory.left.index[j];
    const Hit hit = front.hits[i];
    const double t = static_cast<double>(hit.t);
    dvec3 direction(front.rays.direction(i)), origin = dvec3(front.rays.origin(i)) + t * direction;
    const SurfacePoint point = optics_.surfaces.point(hit.primitive, hit.u, hit.v, origin, options_.leaving);
    Path path = front.path(i);
    travel(t, path);
    if (meet(point, origin, direction, path, memory.arrivals)) memory.next().push(origin, direction, path);
  }
  front.count = 0;
  memory.swap();
}

void PathWalk::travel(double length, Path& path) const {
  path.length += length;
  const dvec3& a = optics_.media[path.medium].absorption;
  if (a == dvec3(0.0)) return;
  const auto kept_of = [&](double coefficient) {
    return static_cast<double>(exp_of_negative(static_cast<float>(-coefficient * length)));
  };
  const dvec3 kept = path.weight * dvec3(kept_of(a.x), kept_of(a.y), kept_of(a.z));
  counts_.ledger.absorbed += optics::mean(path.weight) - optics::mean(kept);
  path.weight = kept;
}

bool PathWalk::meet(const SurfacePoint& point, dvec3& origin, dvec3& direction, Path& path,
                    Arrivals& arrivals) const {
  FluxLedger& ledger = counts_.ledger;
  const optics::SurfaceOptics& surface = optics_.materials[point.material];
  const optics::Facing facing = optics::facing(point, direction);
  if (surface.interface)
    counts_.medium_mismatches +=
        path.medium != (facing.from_inner ? surface.inner_medium : surface.outer_medium);

  const double arriving = optics::mean(path.weight);
  const optics::SpecularSplit split = optics::split(surface, facing.cos_incident, facing.from_inner);
  const double entry = surface.diffuse ? arriving * split.base_entry : 0.0;
  if (entry > 0.0) {
    (path.events == 0 ? ledger.direct : ledger.deposited) += entry;
    if (path.events > 0) arrivals.push(photon_of(point, facing, direction, path), path);
  }
  const optics::SpecularShares shares(split, path.weight);
  const double specular = shares.mean_back + shares.mean_through;
  ledger.absorbed += arriving - entry - specular;
  if (!(specular > 0.0)) return false;
  if (path.events >= options_.max_events) {
    ledger.truncated += specular;
    return false;
  }
  const double after = go_on(options_, point, surface, facing, shares, origin, direction, path);
  ledger.balance += specular - after;
  return after > 0.0;
}

}  // namespace hybray::caustics
