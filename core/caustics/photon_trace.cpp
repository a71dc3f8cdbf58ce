#include "core/caustics/photon_trace.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

namespace hybray::caustics {
namespace {

// The point that the map has for a ray through one of its texels: where the ray meets the triangle that the
// texel's centre sees, or the border of that triangle where it passes it by. A point on the triangle's plane
// beyond the border would lie above or below the surface, and paths would pass it twice or not at all.
SurfacePoint stored_surface(const Scene& scene, const MapFrame& frame, const PathStart& s) {
  const LightTexel& texel = frame.surface(s.x, s.y);
  const dvec3 centre = s.origin + static_cast<double>(texel.distance) * s.direction;
  if (scene.is_analytic(texel.primitive)) {
    const auto t = nearest_hit(scene.analytic_surface(texel.primitive), s.origin, s.direction, 0.0,
                               std::numeric_limits<double>::infinity());
    return surface_point(scene, texel.primitive, 0.0f, 0.0f, t ? s.origin + *t * s.direction : centre);
  }
  const uvec3& tri = scene.triangles[texel.primitive];
  const dvec3 a(scene.positions[tri.x]), ab = dvec3(scene.positions[tri.y]) - a,
                                         ac = dvec3(scene.positions[tri.z]) - a;
  const dvec3 p = glm::cross(s.direction, ac), from_a = s.origin - a, q = glm::cross(from_a, ab);
  const double determinant = glm::dot(ab, p);
  const double t = glm::dot(ac, q) / determinant;
  if (!(t > 0.0) || !std::isfinite(t))  // edge-on: the centre's own point is all there is
    return surface_point(scene, texel.primitive, texel.u, texel.v, centre);
  double u = std::max(0.0, glm::dot(from_a, p) / determinant);
  double v = std::max(0.0, glm::dot(s.direction, q) / determinant);
  if (const double sum = u + v; sum > 1.0) u /= sum, v /= sum;
  return surface_point(scene, texel.primitive, static_cast<float>(u), static_cast<float>(v),
                       s.origin + t * s.direction);
}

Photon make_photon(const SurfacePoint& point, const optics::Facing& facing, const dvec3& direction,
                   const Path& path) {
  const double cos_geometric = -glm::dot(direction, facing.geometric);
  Photon photon;
  photon.position = vec3(point.position);
  photon.normal = vec3(facing.geometric);
  photon.direction = vec3(direction);
  photon.flux = vec3(path.weight);
  photon.cos_in = static_cast<float>(facing.cos_incident);
  photon.shading_ratio = cos_geometric > 0.0 ? static_cast<float>(facing.cos_incident / cos_geometric) : 0.0f;
  photon.material = point.material;
  photon.primitive = point.primitive;
  photon.missed_by_map = !path.in_map;
  photon.events = path.events;
  return photon;
}

}  // namespace

void trace_photons(const Tracer& tracer, const optics::OpticsTable& optics, const Emission& emission,
                   const VisibilityMap& map, FirstSurface first_surface, uint16_t start_medium,
                   const WalkOptions& options, uint64_t first, uint64_t count, PhotonList& out) {
  HYBRAY_CHECK_LE(1, options.max_events);
  HYBRAY_CHECK_LE(first + count, emission.paths());
  constexpr size_t kBlock = PathFront::kSize;
  struct Block {
    std::vector<Photon> photons;
    WalkCounts counts;
  };
  std::vector<Block> blocks((count + kBlock - 1) / kBlock);
  for (Block& block : blocks) block.photons = out.photons.take_spare();
  tbb::enumerable_thread_specific<PathFront> fronts;
  parallel_blocks(count, kBlock, [&](size_t begin, size_t end) {
    Block& mine = blocks[begin / kBlock];
    mine.photons.reserve(end - begin);
    PathFront& front = fronts.local();
    PathWalk walk(tracer, optics, options, mine.counts);
    const auto deposit = [&](const SurfacePoint& point, const optics::Facing& facing, const dvec3& direction,
                             const Path& path, const optics::SurfaceOptics&) {
      if (path.events > 0) mine.photons.push_back(make_photon(point, facing, direction, path));
    };
    for (size_t i = begin; i < end; ++i) {
      const PathStart start = emission.start(first + i);
      Path path;
      path.weight = start.flux;
      path.initial = optics::mean(start.flux);
      path.number = first + i;
      path.medium = start_medium;
      path.in_map = start.in_map;
      mine.counts.ledger.emitted += path.initial;
      dvec3 origin = start.origin, direction = start.direction;
      bool goes_on = path.initial > 0.0;
      if (goes_on && start.in_map && first_surface == FirstSurface::stored) {
        const SurfacePoint point = stored_surface(tracer.scene(), map.frames[start.frame], start);
        goes_on = walk.meet(point, glm::length(point.position - origin), origin, direction, path, deposit);
      }
      if (goes_on) front.push(origin, direction, path);
    }
    while (front.count > 0) walk.advance(front, deposit);
  });

  for (Block& block : blocks) {
    out.photons.append(std::move(block.photons));
    out.counts.add(block.counts);
  }
  out.paths += count;
}

}  // namespace hybray::caustics
