#include "core/truth/ray_truth.h"

#include "core/base/parallel.h"

namespace hybray::truth {
namespace {

bool seen_from_eye(const Tracer& tracer, const View& view, const dvec3& point, uint32_t primitive) {
  const double w = view.view_depth(point);
  if (!(w >= view.near() && w <= view.far())) return false;
  const dvec2 p = view.project(point);
  if (!(p.x >= 0.0 && p.x < view.width() && p.y >= 0.0 && p.y < view.height())) return false;
  // Along a direction of unit view depth, distances are view depths; the view begins at its near plane.
  const vec3 direction((point - view.eye()) / w);
  const Hit first = tracer.intersect(vec3(view.eye()), direction, static_cast<float>(view.near()));
  // A triangle hides no part of itself.
  return !first.valid() || (first.primitive == primitive && tracer.scene().is_triangle(primitive)) ||
         first.t >= w * (1.0 - kVisibilityTolerance);
}

}  // namespace

RayTruth trace_truth(const Tracer& robust, const RayStream& rays, const View& view,
                     std::span<const float> lengths) {
  RayTruth truth;
  truth.hits.resize(rays.size());
  truth.visible.assign(rays.size(), 0);
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Hit hit = lengths.empty() ? robust.intersect(rays.origin(i), rays.direction(i))
                                      : robust.intersect(rays.origin(i), rays.direction(i), 0.0f, lengths[i]);
      truth.hits.t[i] = hit.t;
      truth.hits.primitive[i] = hit.primitive;
      if (!hit.valid()) continue;
      const dvec3 point = dvec3(rays.origin(i)) + static_cast<double>(hit.t) * dvec3(rays.direction(i));
      truth.visible[i] = seen_from_eye(robust, view, point, hit.primitive);
    }
  });
  return truth;
}

}  // namespace hybray::truth
