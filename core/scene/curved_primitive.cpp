#include "core/scene/curved_primitive.h"

namespace hybray {
namespace {

template <class Function>
auto visit(const Scene& scene, uint32_t primitive, const Function& function) {
  return scene.is_curve(primitive) ? function(scene.curve(primitive))
                                   : function(scene.analytic_surface(primitive));
}

}  // namespace

std::optional<double> nearest_hit(const Scene& scene, uint32_t primitive, const dvec3& o, const dvec3& d,
                                  double t_near, double t_far) {
  return visit(scene, primitive, [&](const auto& s) { return nearest_hit(s, o, d, t_near, t_far); });
}

dvec3 outward_normal(const Scene& scene, uint32_t primitive, const dvec3& point) {
  return visit(scene, primitive, [&](const auto& s) { return outward_normal(s, point); });
}

dvec3 moved_onto(const Scene& scene, uint32_t primitive, const dvec3& point) {
  return visit(scene, primitive, [&](const auto& s) { return moved_onto(s, point); });
}

double extent(const Scene& scene, uint32_t primitive) {
  return visit(scene, primitive, [&](const auto& s) { return extent(s); });
}

dvec3 beside(const Scene& scene, uint32_t primitive, const dvec3& o, const dvec3& d) {
  if (scene.is_curve(primitive)) return beside(scene.curve(primitive), o, d);
  const AnalyticSurface& surface = scene.analytic_surface(primitive);
  if (surface.kind == AnalyticSurface::Kind::field)
    return surface.center + beside(surface.field, o - surface.center, d);
  const double nearest = glm::dot(surface.center - o, d) / glm::dot(d, d);
  return moved_onto(surface, o + nearest * d);
}

}  // namespace hybray
