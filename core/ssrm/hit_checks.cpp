#include "core/ssrm/hit_checks.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/scene/primitive_hit.h"
#include "core/scene/surface_point.h"
#include "core/ssrm/cell_walk.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace hybray::ssrm {
namespace {

ivec2 place_of(const DepthView& depth, uint32_t pixel) {
  const auto width = static_cast<uint32_t>(depth.width());
  return {static_cast<int>(pixel % width), static_cast<int>(pixel / width)};
}

bool continuous_around(const DepthView& depth, ivec2 a) {
  for (const ivec2& step : {ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1)}) {
    const ivec2 n = a + step;
    if (n.x < 0 || n.y < 0 || n.x >= depth.width() || n.y >= depth.height()) continue;
    if (!continuous_or_behind(depth, a, n)) return false;
  }
  return true;
}

// How far apart two places along a ray may be and still be the same: as far as a HIT may be off.
double tolerance(const SurfaceView& surfaces, const RayStream& rays, size_t i, uint32_t pixel, double t) {
  const View& view = surfaces.gbuffer.view;
  const dvec3 direction(rays.direction(i)), point = dvec3(rays.origin(i)) + t * direction;
  const dvec3 normal = geometric_normal(surfaces.scene, surfaces.gbuffer.primitive[pixel], point);
  return view.view_depth(point) / view.focal() / std::max(0.1, std::abs(glm::dot(normal, direction)));
}

// Whether all pixels around one put a HIT at the same place as its own plane does: one flat surface, of which
// a primitive smaller than a pixel may be stored nowhere. Flat: to a sixteenth of what a HIT may be off. Up
// to all of that, curved surfaces would pass as well, and twice as many false hits.
bool agreed_around(const SurfaceView& surfaces, const RayStream& rays, const ScreenRays& screen_rays,
                   size_t i, uint32_t pixel, double t) {
  const DepthView& depth = surfaces.depth;
  const ivec2 a = place_of(depth, pixel);
  const auto ray = screen_rays.get<double>(i);
  const double most = tolerance(surfaces, rays, i, pixel, t) / 16.0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const ivec2 n = a + ivec2(dx, dy);
      if (n.x < 0 || n.y < 0 || n.x >= depth.width() || n.y >= depth.height()) continue;
      if (surfaces.gbuffer.primitive(n.x, n.y) == kNoPrimitive) return false;
      const double there =
          distance_of(rays, i, surfaces.gbuffer.view, plane_gap(depth, ray, n.x, n.y).crossing());
      if (!(std::abs(there - t) <= most)) return false;
    }
  return true;
}

struct Checker {
  const SurfaceView& surfaces;
  const DepthPyramid* neighbourhood;
  const RayStream& rays;
  const ScreenRays& screen_rays;

  PathFindings search(size_t i, double t, bool with_primitives) const {
    const double l = parameter_of(rays, i, surfaces.gbuffer.view, t);
    return search_path(surfaces, *neighbourhood, rays, screen_rays, i, l, with_primitives);
  }
  bool free_of_doubt(const PathFindings& found, size_t i, uint32_t pixel, double t) const {
    return !found.doubtful || t - *found.doubtful <= tolerance(surfaces, rays, i, pixel, t);
  }

  bool passes_conservative(size_t i, uint32_t pixel, uint64_t& steps) const {
    const double t = plane_distance(surfaces.depth, screen_rays, rays, surfaces.gbuffer.view, i, pixel);
    const PathFindings found = search(i, t, false);
    steps += found.steps;
    return free_of_doubt(found, i, pixel, t);
  }
  std::optional<SurfaceCrossing> triangle_hit(size_t i, uint32_t pixel) const {
    if (const auto hit = block_hit(surfaces, rays, i, pixel)) return hit;
    const double t = plane_distance(surfaces.depth, screen_rays, rays, surfaces.gbuffer.view, i, pixel);
    if (!agreed_around(surfaces, rays, screen_rays, i, pixel, t)) return std::nullopt;
    return SurfaceCrossing{t, pixel};
  }
  std::optional<SurfaceCrossing> strict_hit(size_t i, uint32_t pixel, uint64_t& steps) const {
    const auto last = triangle_hit(i, pixel);
    if (!last) return last;
    const PathFindings found = search(i, last->distance, true);
    steps += found.steps;
    const SurfaceCrossing first = found.met && found.met->distance < last->distance ? *found.met : *last;
    if (!free_of_doubt(found, i, first.pixel, first.distance)) return std::nullopt;
    return first;
  }
};

}  // namespace

const char* label(HitCheck check) {
  switch (check) {
    case HitCheck::none:
      return "none";
    case HitCheck::triangle:
      return "triangle";
    case HitCheck::continuity:
      return "continuity";
    case HitCheck::conservative:
      return "conservative";
    case HitCheck::strict:
      return "strict";
  }
  return "invalid";
}

std::optional<SurfaceCrossing> block_hit(const SurfaceView& surfaces, const RayStream& rays, size_t i,
                                         uint32_t pixel) {
  const GBuffer& g = surfaces.gbuffer;
  const ivec2 center = place_of(surfaces.depth, pixel);
  const dvec3 origin(rays.origin(i)), direction(rays.direction(i));
  const uint32_t own = g.primitive[rays.pixel[i]];
  std::array<uint32_t, 9> tested{};
  size_t count = 0;
  const auto meets = [&](ivec2 n) -> std::optional<SurfaceCrossing> {
    if (n.x < 0 || n.y < 0 || n.x >= g.view.width() || n.y >= g.view.height()) return std::nullopt;
    const uint32_t primitive = g.primitive(n.x, n.y);
    if (primitive == kNoPrimitive || primitive == own) return std::nullopt;
    if (std::find(tested.begin(), tested.begin() + count, primitive) != tested.begin() + count)
      return std::nullopt;
    tested[count++] = primitive;
    const auto t = primitive_hit(surfaces.scene, primitive, origin, direction);
    if (!t) return std::nullopt;
    const dvec3 point = origin + *t * direction;
    if (!(g.view.view_depth(point) >= g.view.near())) return std::nullopt;
    const dvec2 off = g.view.project(point) - (dvec2(center) + 0.5);
    if (!(std::max(std::abs(off.x), std::abs(off.y)) <= 1.5)) return std::nullopt;
    return SurfaceCrossing{
        *t, static_cast<uint32_t>(n.y) * static_cast<uint32_t>(g.view.width()) + static_cast<uint32_t>(n.x)};
  };
  if (const auto here = meets(center)) return here;
  std::optional<SurfaceCrossing> nearest;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const auto there = meets(center + ivec2(dx, dy));
      if (there && (!nearest || there->distance < nearest->distance)) nearest = there;
    }
  return nearest;
}

CheckCounts check_hits(const SurfaceView& surfaces, const DepthPyramid* neighbourhood, const RayStream& rays,
                       const ScreenRays& screen_rays, HitCheck check, MarchResults& results) {
  HYBRAY_CHECK_EQ(results.size(), rays.size());
  HYBRAY_CHECK(neighbourhood || !needs_neighbourhood(check));
  if (check == HitCheck::none) return {};
  const bool measures = check == HitCheck::triangle || check == HitCheck::strict;
  if (measures) results.distance.assign(rays.size(), kNoDistance);
  const Checker checker{surfaces, neighbourhood, rays, screen_rays};
  std::atomic<uint64_t> checked{0}, rejected{0}, steps{0};
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0, failed = 0, read = 0;
    for (size_t i = begin; i < end; ++i) {
      if (results.verdict[i] != Verdict::hit) continue;
      ++mine;
      const uint32_t pixel = results.pixel[i];
      bool passes = false;
      if (measures) {
        const auto hit =
            check == HitCheck::strict ? checker.strict_hit(i, pixel, read) : checker.triangle_hit(i, pixel);
        passes = hit.has_value();
        if (hit) results.distance[i] = static_cast<float>(hit->distance), results.pixel[i] = hit->pixel;
      } else {
        passes = check == HitCheck::continuity
                     ? continuous_around(surfaces.depth, place_of(surfaces.depth, pixel))
                     : checker.passes_conservative(i, pixel, read);
      }
      if (passes) continue;
      ++failed;
      results.verdict[i] = Verdict::rejected;
      results.pixel[i] = kNoPixel;
    }
    checked += mine, rejected += failed, steps += read;
  });
  return {checked, rejected, steps};
}

}  // namespace hybray::ssrm
