#include "core/caustics/photon_trace.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/caustics/emission_lanes.h"
#include "core/optics/specular_step.h"
#include "core/scene/curved_primitive.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

namespace hybray::caustics {
namespace {

// Where a ray through one of its texels meets the surface, according to the map: on the triangle that the
// texel's centre sees, or at the border of that triangle where the ray passes it by. A point on the
// triangle's plane beyond the border would lie above or below the surface, and paths would pass it twice or
// not at all.
struct StoredHit {
  dvec3 position;
  Hit hit;  // of a ray that starts at the position: t = 0
};
StoredHit stored_hit(const Scene& scene, const LightTexel& texel, const dvec3& origin,
                     const dvec3& direction) {
  const StoredHit centre{origin + static_cast<double>(texel.distance) * direction,
                         {0.0f, texel.primitive, texel.u, texel.v}};
  if (!scene.is_triangle(texel.primitive)) {
    const auto t =
        nearest_hit(scene, texel.primitive, origin, direction, 0.0, std::numeric_limits<double>::infinity());
    return {t ? origin + *t * direction : centre.position, centre.hit};
  }
  const uvec3& tri = scene.triangles[texel.primitive];
  const dvec3 a(scene.positions[tri.x]), ab = dvec3(scene.positions[tri.y]) - a,
                                         ac = dvec3(scene.positions[tri.z]) - a;
  const dvec3 p = glm::cross(direction, ac), from_a = origin - a, q = glm::cross(from_a, ab);
  const double determinant = glm::dot(ab, p);
  const double t = glm::dot(ac, q) / determinant;
  if (!(t > 0.0) || !std::isfinite(t)) return centre;  // edge-on: the centre's own point is all there is
  double u = std::max(0.0, glm::dot(from_a, p) / determinant);
  double v = std::max(0.0, glm::dot(direction, q) / determinant);
  if (const double sum = u + v; sum > 1.0) u /= sum, v /= sum;
  return {a + u * ab + v * ac, {0.0f, texel.primitive, static_cast<float>(u), static_cast<float>(v)}};
}

}  // namespace

void trace_photons(const Tracer& tracer, const optics::OpticsTable& optics, const Emission& emission,
                   const VisibilityMap& map, FirstSurface first_surface, uint16_t start_medium,
                   const WalkOptions& options, uint64_t first, uint64_t count, PhotonList& out) {
  HYBRAY_CHECK_LE(first + count, emission.paths());
  constexpr size_t kBlock = 8 * PathFront::kSize;  // large enough for threads, while a front stays near
  struct Block {
    PhotonBlock photons;
    WalkCounts counts;
  };
  std::vector<Block> blocks((count + kBlock - 1) / kBlock);
  for (Block& block : blocks) block.photons = out.photons.take_spare();
  tbb::enumerable_thread_specific<std::unique_ptr<WalkMemory>> memories(std::make_unique<WalkMemory>);
  parallel_blocks(count, kBlock, [&](size_t begin, size_t end) {
    Block& mine = blocks[begin / kBlock];
    mine.photons.room(end - begin + PathFront::kAllocated);
    WalkMemory& memory = *memories.local();
    PathWalk walk(tracer, optics, options, mine.counts);
    const auto in_place = [&](const auto& step) {
      memory.arrivals.photons = mine.photons.room(PathFront::kAllocated);
      step();
      mine.photons.add(memory.arrivals.count);
    };
    const bool stored = first_surface == FirstSurface::stored;
    const auto stand_at = [&](const LightTexel& texel, PathFront& front, size_t i, const dvec3& origin,
                              const dvec3& direction) {
      const StoredHit at = stored_hit(tracer.scene(), texel, origin, direction);
      Path path = front.path(i);
      walk.travel(glm::length(at.position - origin), path);
      front.hits.set(i, at.hit);
      front.set(i, at.position, direction, path);
    };
    for (size_t part = begin; part < end; part += PathFront::kSize) {
      // Paths through the map come first. Those whose first surface is stored stand there already, in the
      // front; all others are to be traced next.
      const uint64_t from = first + part, to = first + std::min(end, part + PathFront::kSize);
      const uint64_t through_map = std::min(to, emission.from_map().paths);
      if (from < through_map) {
        PathFront& front = stored ? memory.front() : memory.next();
        mine.counts.ledger.emitted += start_map_paths(emission.from_map(), from, through_map - from,
                                                      start_medium, front, memory.texels);
        for (size_t i = 0; stored && i < front.count; ++i) {
          const MapTexel& t = map.texels[memory.texels[i]];
          stand_at(map.frames[t.frame].surface(t.x, t.y), front, i, dvec3(front.rays.origin(i)),
                   dvec3(front.rays.direction(i)));
        }
      }
      for (uint64_t i = std::max(from, through_map); i < to; ++i) {
        const PathStart start = emission.start(i);
        Path path;
        path.weight = start.flux;
        path.initial = optics::mean(start.flux);
        path.number = i;
        path.medium = start_medium;
        path.in_map = start.in_map;
        mine.counts.ledger.emitted += path.initial;
        if (!(path.initial > 0.0)) continue;
        PathFront& front = stored && start.in_map ? memory.front() : memory.next();
        front.push(start.origin, start.direction, path);
        if (stored && start.in_map)
          stand_at(map.frames[start.frame].surface(start.x, start.y), front, front.count - 1, start.origin,
                   start.direction);
      }
      in_place([&] { walk.meet_hits(memory); });
      while (memory.front().count > 0) in_place([&] { walk.advance(memory); });
    }
  });

  for (Block& block : blocks) {
    out.photons.append(std::move(block.photons));
    out.counts.add(block.counts);
  }
  out.paths += count;
}

}  // namespace hybray::caustics
