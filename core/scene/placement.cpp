#include "core/scene/placement.h"

#include "core/base/check.h"

namespace hybray {

Camera placed_camera(const Camera& camera, const Placement& placement) {
  Camera placed = camera;
  placed.eye = vec3(placement(dvec3(camera.eye)));
  placed.target = vec3(placement(dvec3(camera.target)));
  return placed;
}

Scene placed_scene(const Scene& scene, const Placement& placement) {
  HYBRAY_CHECK(placement.scale > 0.0);
  const auto scale = static_cast<float>(placement.scale);
  Scene placed = scene;
  for (vec3& p : placed.positions) p = vec3(placement(dvec3(p)));
  for (AnalyticSurface& s : placed.analytic) {
    s.center = placement(s.center);
    s.radius *= placement.scale, s.focal_length *= placement.scale;
    s.y0 = placement.scale * s.y0 + placement.offset.y, s.y1 = placement.scale * s.y1 + placement.offset.y;
  }
  for (Material& m : placed.materials) m.absorption /= scale, m.outer_absorption /= scale;
  for (Light& l : placed.lights) l.position = vec3(placement(dvec3(l.position))), l.range *= scale;
  for (Camera& c : placed.cameras) c = placed_camera(c, placement);

  placed.bounds = {};
  for (const uvec3& tri : placed.triangles)
    for (const uint32_t v : {tri.x, tri.y, tri.z}) placed.bounds.extend(placed.positions[v]);
  for (const AnalyticSurface& s : placed.analytic) {
    const Bounds3 box = bounds(s);
    placed.bounds.extend(box.lower), placed.bounds.extend(box.upper);
  }
  update_content_hash(placed);
  return placed;
}

}  // namespace hybray
