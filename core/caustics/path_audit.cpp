#include "core/caustics/path_audit.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/optics/specular_step.h"

#include <algorithm>
#include <array>
#include <memory>

#include <tbb/enumerable_thread_specific.h>

namespace hybray::caustics {
namespace {

// The primitives that up to a front's paths have left last, by the paths' numbers.
using LastSurfaces = std::array<uint32_t, PathFront::kSize>;

bool returns(const Scene& scene, const PathFront& front, size_t i, uint32_t left) {
  const uint32_t primitive = front.hits.primitive[i];
  if (primitive == kNoPrimitive || primitive != left) return false;
  if (scene.is_triangle(primitive)) return true;
  if (!scene.is_analytic(primitive)) return false;  // curves bend: a path may come back
  const AnalyticSurface& surface = scene.analytic_surface(primitive);
  const dvec3 origin(front.rays.origin(i)), direction(front.rays.direction(i));
  const dvec3 end = origin + static_cast<double>(front.hits.t[i]) * direction;
  return glm::dot(direction, outward_normal(surface, origin)) > 0.0 ||
         glm::dot(direction, outward_normal(surface, end)) < 0.0;
}

}  // namespace

PathAudit audit_paths(const Tracer& tracer, const optics::OpticsTable& optics, const Emission& emission,
                      uint16_t start_medium, const WalkOptions& options, uint64_t first, uint64_t count) {
  HYBRAY_CHECK_LE(first + count, emission.paths());
  constexpr size_t kBlock = 8 * PathFront::kSize;
  std::vector<PathAudit> blocks((count + kBlock - 1) / kBlock);
  tbb::enumerable_thread_specific<std::unique_ptr<WalkMemory>> memories(std::make_unique<WalkMemory>);
  parallel_blocks(count, kBlock, [&](size_t begin, size_t end) {
    PathAudit& mine = blocks[begin / kBlock];
    mine.arrived.assign(optics.media.size(), 0.0);
    WalkMemory& memory = *memories.local();
    WalkCounts counts;
    const PathWalk walk(tracer, optics, options, counts);
    LastSurfaces last;
    for (size_t part = begin; part < end; part += PathFront::kSize) {
      last.fill(kNoPrimitive);
      const uint64_t from = first + part, to = first + std::min(end, part + PathFront::kSize);
      for (uint64_t i = from; i < to; ++i) {
        const PathStart start = emission.start(i);
        Path path;
        path.weight = start.flux, path.initial = optics::mean(start.flux);
        path.number = i, path.medium = start_medium, path.in_map = start.in_map;
        if (path.initial > 0.0) memory.front().push(start.origin, start.direction, path);
      }
      while (const size_t rays = memory.front().count) {
        walk.advance(memory);
        mine.segments += rays;
        // What was the front lies behind the new one, with the hits that it had.
        const PathFront& met = memory.next();
        for (size_t i = 0; i < rays; ++i) {
          uint32_t& left = last[met.number[i] - from];
          mine.self_intersections += returns(tracer.scene(), met, i, left);
          left = met.hits.primitive[i];
        }
        for (size_t i = 0; i < memory.arrivals.count; ++i)
          mine.arrived[path_tag::medium(memory.arrivals.tag[i])] +=
              optics::mean(dvec3(memory.arrivals.photons[i].flux));
      }
    }
  });
  PathAudit all;
  all.arrived.assign(optics.media.size(), 0.0);
  for (const PathAudit& block : blocks) {
    all.segments += block.segments, all.self_intersections += block.self_intersections;
    for (size_t m = 0; m < all.arrived.size(); ++m) all.arrived[m] += block.arrived[m];
  }
  return all;
}

}  // namespace hybray::caustics
