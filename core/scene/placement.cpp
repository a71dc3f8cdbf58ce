#include "core/scene/placement.h"

#include "core/base/check.h"

namespace hybray {

Camera placed_camera(const Camera& camera, const Placement& placement) {
  Camera placed = camera;
  placed.eye = vec3(placement(dvec3(camera.eye)));
  placed.target = vec3(placement(dvec3(camera.target)));
  return placed;
}

namespace {

AnalyticSurface placed_surface(const AnalyticSurface& surface, const Placement& placement) {
  AnalyticSurface s = surface;
  const double scale = placement.scale;
  s.center = placement(s.center);
  s.radius *= scale, s.focal_length *= scale;
  s.y0 = scale * s.y0 + placement.offset.y, s.y1 = scale * s.y1 + placement.offset.y;
  s.field.radius *= scale, s.field.period *= scale;
  if (s.field.shape != DistanceField::Shape::gyroid) s.field.thickness *= scale;  // a gyroid's is no length
  return s;
}

void extend(Bounds3& bounds, const Bounds3& box) {
  bounds.extend(box.lower);
  bounds.extend(box.upper);
}

}  // namespace

Scene placed_scene(const Scene& scene, const Placement& placement) {
  HYBRAY_CHECK(placement.scale > 0.0);
  const auto scale = static_cast<float>(placement.scale);
  Scene placed = scene;
  for (vec3& p : placed.positions) p = vec3(placement(dvec3(p)));
  for (AnalyticSurface& s : placed.analytic) s = placed_surface(s, placement);
  for (RoundCurve& curve : placed.curves)
    for (vec4& c : curve.control) c = vec4(vec3(placement(dvec3(c))), scale * c.w);
  for (Material& m : placed.materials) m.absorption /= scale, m.outer_absorption /= scale;
  for (Light& l : placed.lights) l.position = vec3(placement(dvec3(l.position))), l.range *= scale;
  for (Camera& c : placed.cameras) c = placed_camera(c, placement);

  placed.bounds = {};
  for (const uvec3& tri : placed.triangles)
    for (const uint32_t v : {tri.x, tri.y, tri.z}) placed.bounds.extend(placed.positions[v]);
  for (const AnalyticSurface& s : placed.analytic) extend(placed.bounds, bounds(s));
  for (const RoundCurve& c : placed.curves) extend(placed.bounds, bounds(c));
  update_content_hash(placed);
  return placed;
}

}  // namespace hybray
