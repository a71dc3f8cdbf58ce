#include "harness/experiments/stability_truth.h"

#include "core/base/parallel.h"
#include "core/gbuffer/facing_surface.h"
#include "core/scene/curved_primitive.h"
#include "core/scene/surface_point.h"

#include <limits>
#include <utility>

namespace hybray::stability_parts {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Distance, in double, to what the tracer found in float.
double refined(const Scene& scene, const Hit& hit, const dvec3& origin, const dvec3& direction) {
  if (!scene.is_triangle(hit.primitive)) {
    const double found = hit.t;
    return nearest_hit(scene, hit.primitive, origin, direction, 0.999 * found, 1.001 * found).value_or(found);
  }
  const dvec3 n = geometric_normal(scene, hit.primitive);
  const dvec3 a(scene.positions[scene.triangles[hit.primitive].x]);
  const double t = glm::dot(n, a - origin) / glm::dot(n, direction);
  return std::isfinite(t) ? t : static_cast<double>(hit.t);
}

}  // namespace

StableRays::StableRays(const Tracer& robust, const View& view, size_t judged)
    : frame(robust.scene(), view, make_gbuffer(robust, view, kPrimitive).primitive) {
  const Scene& scene = robust.scene();
  std::vector<uint32_t> seen;
  for (uint32_t pixel = 0; pixel < frame.primitive().size(); ++pixel)
    if (frame.primitive()[pixel] != kNoPrimitive) seen.push_back(pixel);
  const size_t stride = std::max<size_t>(1, (seen.size() + judged - 1) / judged);
  for (size_t i = stride / 2; i < seen.size(); i += stride)
    if (auto ray = frame.mirror_ray(seen[i])) rays.push_back(*ray);
  true_t.assign(rays.size(), kInfinity);
  true_primitive.assign(rays.size(), kNoPrimitive);
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const truth::ExactFrame::Ray& r = rays[i];
      const uint32_t own = frame.primitive()[r.pixel];
      const dvec3 n = geometric_normal(scene, own, r.origin), incoming = r.origin - frame.view().eye();
      const vec3 from = facing_surface(scene, own, r.origin, n, glm::normalize(incoming)).origin;
      const Hit hit = robust.intersect(from, vec3(r.direction));
      if (!hit.valid()) continue;
      true_primitive[i] = hit.primitive;
      true_t[i] = refined(scene, hit, r.origin, r.direction);
    }
  });
}

metrics::HitClass StableRays::classify(size_t i, uint32_t primitive, double claimed,
                                       const metrics::Tolerance& tolerance) const {
  return metrics::classify_hit(frame.view(), frame.scene(), rays[i].origin, rays[i].direction, primitive,
                               claimed, true_t[i], tolerance);
}

}  // namespace hybray::stability_parts
