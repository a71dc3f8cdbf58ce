#include "core/ssrm/confirm_hits.h"

#include "core/base/parallel.h"
#include "core/scene/curved_primitive.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace hybray::ssrm {
namespace {

// Rounding at the triangle's edges that the test forgives, in barycentric units.
constexpr double kSlack = 1e-4;

// Distance at which the ray meets the triangle (Moeller and Trumbore 1997), or infinity.
double meets(const Scene& scene, uint32_t triangle, const dvec3& o, const dvec3& d) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const uvec3& tri = scene.triangles[triangle];
  const dvec3 a(scene.positions[tri.x]);
  const dvec3 e1 = dvec3(scene.positions[tri.y]) - a, e2 = dvec3(scene.positions[tri.z]) - a;
  const dvec3 p = glm::cross(d, e2), s = o - a, q = glm::cross(s, e1);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return kNever;
  const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
  if (u < -kSlack || v < -kSlack || u + v > 1.0 + kSlack) return kNever;
  return glm::dot(e2, q) / det;
}

}  // namespace

uint64_t confirm_late_hits(const LayeredView& view, const View& main, const Scene& scene,
                           const RayStream& rays, const ScreenRays& screen_rays, LayerResults& results) {
  const std::array<ivec2, 5> places = {ivec2(0, 0), ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1)};
  const int width = view.first.width(), height = view.first.height();
  std::atomic<uint64_t> taken_back{0};
  parallel_blocks(results.layer.size(), 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i) {
      if (results.march.verdict[i] != Verdict::hit || !results.late[i]) continue;
      const int pixel = static_cast<int>(results.march.pixel[i]);
      const ivec2 p(pixel % width, pixel / width);
      const dvec3 o(rays.origin(i)), d(rays.direction(i));
      const double claimed = plane_distance(view.plane(results.layer[i], p.x, p.y), view.first, screen_rays,
                                            rays, main, i, results.march.pixel[i]);
      const auto met = [&](ivec2 q, int layer) {
        const uint32_t primitive = view.primitive_of(
            layer, static_cast<size_t>(q.y) * static_cast<size_t>(width) + static_cast<size_t>(q.x));
        if (primitive == kNoPrimitive) return false;
        if (scene.is_curve(primitive))
          return nearest_hit(scene, primitive, o, d, (1.0 - kConfirmed) * claimed,
                             (1.0 + kConfirmed) * claimed)
              .has_value();
        if (!scene.is_triangle(primitive)) return q == p;
        return std::abs(meets(scene, primitive, o, d) - claimed) <= kConfirmed * claimed;
      };
      bool confirmed = met(p, results.layer[i]);
      for (const ivec2& place : places) {
        const ivec2 q = p + place;
        if (q.x < 0 || q.y < 0 || q.x >= width || q.y >= height) continue;
        for (int layer = 0; layer < view.count() && !confirmed; ++layer) confirmed = met(q, layer);
      }
      if (confirmed) continue;
      results.march.verdict[i] = Verdict::correction;
      results.march.pixel[i] = kNoPixel;
      results.layer[i] = results.late[i] = 0;
      ++mine;
    }
    taken_back += mine;
  });
  return taken_back;
}

}  // namespace hybray::ssrm
