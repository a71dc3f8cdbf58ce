#include "core/gbuffer/reflection_rays.h"

#include "core/base/check.h"
#include "core/base/morton.h"
#include "core/base/parallel.h"
#include "core/gbuffer/triangle_plane.h"
#include "core/scene/surface_point.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hybray {
namespace {

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// What the rounding of an intersection with a primitive at point p grows with: the largest of the coordinates
// of p and of its distances to the triangle's vertices, or the size of the analytic surface.
double rounding_scale(const Scene& scene, uint32_t primitive, const dvec3& p) {
  if (scene.is_analytic(primitive)) return std::max(largest(p), extent(scene.analytic_surface(primitive)));
  double scale = largest(p);
  const uvec3& tri = scene.triangles[primitive];
  for (uint32_t v : {tri.x, tri.y, tri.z}) scale = std::max(scale, largest(dvec3(scene.positions[v]) - p));
  return scale;
}

// Writes ray i; returns whether the geometric normal had to stand in for the shading normal.
bool make_ray(const GBuffer& g, const Scene& scene, int x, int y, size_t i, RayStream& rays) {
  const uint32_t primitive = g.primitive(x, y);
  const dvec3 view_direction = glm::normalize(g.view.ray_direction(x + 0.5, y + 0.5));
  const dvec3 p = seen_point(g.view, scene, primitive, x + 0.5, y + 0.5);
  dvec3 ng = geometric_normal(scene, primitive, p);
  dvec3 ns(g.shading_normal(x, y));
  if (glm::dot(ng, view_direction) > 0.0) ng = -ng, ns = -ns;

  const auto mirror = [&](const dvec3& n) { return view_direction - 2.0 * glm::dot(view_direction, n) * n; };
  dvec3 direction = mirror(ns);
  const bool wrong_side = glm::dot(view_direction, ns) >= 0.0 || glm::dot(direction, ng) <= 0.0;
  if (wrong_side) direction = mirror(ng);

  rays.set(i, vec3(p + ng * (rounding_scale(scene, primitive, p) * 0x1p-19)), vec3(glm::normalize(direction)),
           static_cast<uint32_t>(y) * static_cast<uint32_t>(g.view.width()) + static_cast<uint32_t>(x));
  return wrong_side;
}

}  // namespace

ReflectionRays make_reflection_rays(const GBuffer& g, const Scene& scene) {
  HYBRAY_CHECK(!g.primitive.empty() && !g.shading_normal.empty());
  const int w = g.view.width(), h = g.view.height();
  const size_t tiles_x = static_cast<size_t>((w + kMortonTile - 1) / kMortonTile);
  const size_t tiles = tiles_x * static_cast<size_t>((h + kMortonTile - 1) / kMortonTile);
  const auto for_covered = [&](size_t tile, const auto& visit) {
    const int tx = static_cast<int>(tile % tiles_x) * kMortonTile,
              ty = static_cast<int>(tile / tiles_x) * kMortonTile;
    for (uint32_t i = 0; i < kMortonTile * kMortonTile; ++i) {
      const int x = tx + morton_x(i), y = ty + morton_y(i);
      if (x < w && y < h && g.primitive(x, y) != kNoPrimitive) visit(x, y);
    }
  };

  // Two passes: where each tile's rays begin, then the rays.
  std::vector<size_t> first(tiles + 1, 0);
  parallel_blocks(tiles, 256, [&](size_t begin, size_t end) {
    for (size_t tile = begin; tile < end; ++tile) for_covered(tile, [&](int, int) { ++first[tile + 1]; });
  });
  for (size_t tile = 0; tile < tiles; ++tile) first[tile + 1] += first[tile];

  ReflectionRays result;
  result.rays.resize(first[tiles]);
  std::atomic<size_t> wrong_side{0};
  parallel_blocks(tiles, 64, [&](size_t begin, size_t end) {
    size_t mine = 0;
    for (size_t tile = begin; tile < end; ++tile) {
      size_t i = first[tile];
      for_covered(tile, [&](int x, int y) { mine += make_ray(g, scene, x, y, i++, result.rays); });
    }
    wrong_side += mine;
  });
  result.mirrored_about_geometric_normal = wrong_side;
  return result;
}

}  // namespace hybray
