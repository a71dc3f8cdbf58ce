#include "core/ssrm/hit_checks.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/scene/primitive_hit.h"
#include "core/scene/surface_point.h"
#include "core/ssrm/compaction.h"
#include "core/ssrm/march.h"

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

// Calls passes(i, steps) for every HIT; those that do not pass become UNKNOWN.
template <class Test>
CheckCounts test_hits(MarchResults& results, const Test& passes) {
  std::atomic<uint64_t> checked{0}, rejected{0}, steps{0};
  parallel_blocks(results.size(), 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0, failed = 0, read = 0;
    for (size_t i = begin; i < end; ++i) {
      if (results.verdict[i] != Verdict::hit) continue;
      ++mine;
      if (passes(i, read)) continue;
      ++failed;
      results.verdict[i] = Verdict::rejected;
      results.pixel[i] = kNoPixel;
    }
    checked += mine, rejected += failed, steps += read;
  });
  return {checked, rejected, steps};
}

struct Checker {
  const SurfaceView& surfaces;
  const RayStream& rays;
  const ScreenRays& screen_rays;
  MarchResults& results;

  double on_plane(size_t i) const {
    return plane_distance(surfaces.depth, screen_rays, rays, surfaces.gbuffer.view, i, results.pixel[i]);
  }
  std::optional<SurfaceCrossing> triangle_hit(size_t i) const {
    if (const auto hit = block_hit(surfaces, rays, i, results.pixel[i])) return hit;
    const double t = on_plane(i);
    if (!agreed_around(surfaces, rays, screen_rays, i, results.pixel[i], t)) return std::nullopt;
    return SurfaceCrossing{t, results.pixel[i]};
  }
  // `claimed`, where there is one: the distances of those that pass, unrounded.
  CheckCounts check_triangles(std::vector<double>* claimed) const {
    results.distance.assign(results.size(), kNoDistance);
    return test_hits(results, [&](size_t i, uint64_t&) {
      const auto hit = triangle_hit(i);
      if (!hit) return false;
      results.distance[i] = static_cast<float>(hit->distance), results.pixel[i] = hit->pixel;
      if (claimed) (*claimed)[i] = hit->distance;
      return true;
    });
  }
  // With primitives: HITs are at the claimed distances, and a primitive met before is the HIT. Without: they
  // are at their pixels' planes.
  CheckCounts check_paths(PathCheck& path, bool with_primitives) const {
    compact_hits(results, path.which);
    march_some(path.neighbourhood.view(), screen_rays, rays.pixel, path.which,
               {.code = MarchCode::lanes, .marcher = Marcher::plane, .correct = false}, path.marched);
    CheckCounts counts = test_hits(results, [&](size_t i, uint64_t& steps) {
      double t = with_primitives ? path.claimed[i] : on_plane(i);
      std::optional<PathStop> stop;
      if (path.marched.verdict[i] == Verdict::correction)
        stop = {path.marched.pixel[i], path.marched.proved[i]};
      const double l_end = parameter_of(rays, i, surfaces.gbuffer.view, t);
      const PathFindings found =
          search_path(surfaces, path.neighbourhood, rays, screen_rays, i, l_end, stop, with_primitives);
      steps += found.steps;
      if (found.met && found.met->distance < t) {
        t = found.met->distance;
        results.distance[i] = static_cast<float>(t), results.pixel[i] = found.met->pixel;
      }
      return !found.doubtful || t - *found.doubtful <= tolerance(surfaces, rays, i, results.pixel[i], t);
    });
    counts.steps += path.marched.steps;
    return counts;
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

CheckCounts check_hits(const SurfaceView& surfaces, PathCheck* path, const RayStream& rays,
                       const ScreenRays& screen_rays, HitCheck check, MarchResults& results) {
  HYBRAY_CHECK_EQ(results.size(), rays.size());
  HYBRAY_CHECK(path || !checks_path(check));
  const Checker checker{surfaces, rays, screen_rays, results};
  switch (check) {
    case HitCheck::none:
      break;
    case HitCheck::triangle:
      return checker.check_triangles(nullptr);
    case HitCheck::continuity:
      return test_hits(results, [&](size_t i, uint64_t&) {
        return continuous_around(surfaces.depth, place_of(surfaces.depth, results.pixel[i]));
      });
    case HitCheck::conservative:
      return checker.check_paths(*path, false);
    case HitCheck::strict: {
      const CheckCounts triangles = checker.check_triangles(&path->claimed);
      const CheckCounts paths = checker.check_paths(*path, true);
      return {triangles.checked, triangles.rejected + paths.rejected, paths.steps};
    }
  }
  return {};
}

}  // namespace hybray::ssrm
