#include "core/scene/pose.h"

#include "core/base/error.h"

#include <cmath>

namespace hybray {
namespace {

bool has_area(const Scene& scene, const uvec3& triangle) {
  const dvec3 a(scene.positions[triangle.x]);
  return glm::cross(dvec3(scene.positions[triangle.y]) - a, dvec3(scene.positions[triangle.z]) - a) !=
         dvec3(0.0);
}

void extend(Bounds3& bounds, const Bounds3& box) {
  bounds.extend(box.lower);
  bounds.extend(box.upper);
}

AnalyticSurface posed(const AnalyticSurface& surface, const Pose& pose) {
  if (surface.kind != AnalyticSurface::Kind::sphere && pose.turn != dmat3(1.0))
    throw InputError("analytic surface '" + surface.name + "'", "it is upright and cannot be turned");
  AnalyticSurface s = surface;
  s.center = pose(s.center);
  s.radius *= pose.scale, s.focal_length *= pose.scale;
  s.y0 = pose.scale * s.y0 + pose.offset.y, s.y1 = pose.scale * s.y1 + pose.offset.y;
  s.field.radius *= pose.scale, s.field.period *= pose.scale;
  if (s.field.shape != DistanceField::Shape::gyroid)
    s.field.thickness *= pose.scale;  // of a gyroid, no length
  return s;
}

}  // namespace

size_t leave_out_collapsed(Scene& scene) {
  size_t kept = 0;
  for (SceneObject& object : scene.objects) {
    const size_t begin = object.first_triangle, end = begin + object.triangle_count;
    object.first_triangle = static_cast<uint32_t>(kept);
    for (size_t t = begin; t < end; ++t) {
      if (!has_area(scene, scene.triangles[t])) continue;
      scene.triangles[kept] = scene.triangles[t];
      scene.triangle_material[kept] = scene.triangle_material[t];
      ++kept;
    }
    object.triangle_count = static_cast<uint32_t>(kept) - object.first_triangle;
  }
  const size_t dropped = scene.triangles.size() - kept;
  scene.triangles.resize(kept);
  scene.triangle_material.resize(kept);
  update_content_hash(scene);
  return dropped;
}

dmat3 rotation(const dvec3& axis, double angle) {
  const dvec3 a = glm::normalize(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  dmat3 r(1.0);
  for (int k = 0; k < 3; ++k) {
    dvec3 e(0.0);
    e[k] = 1.0;
    r[k] = c * e + s * glm::cross(a, e) + (1.0 - c) * glm::dot(a, e) * a;  // Rodrigues' formula
  }
  return r;
}

Camera posed(const Camera& camera, const Pose& pose) {
  Camera c = camera;
  c.eye = vec3(pose(dvec3(c.eye))), c.target = vec3(pose(dvec3(c.target)));
  c.up = vec3(pose.turn * dvec3(c.up));
  return c;
}

Scene posed(const Scene& original, const Pose& pose) {
  Scene scene = original;
  const auto point = [&](const vec3& p) { return vec3(pose(dvec3(p))); };
  const bool turned = pose.turn != dmat3(1.0);
  const auto direction = [&](const vec3& d) { return turned ? vec3(pose.turn * dvec3(d)) : d; };
  const auto length = [&](float l) { return static_cast<float>(pose.scale * static_cast<double>(l)); };
  for (vec3& p : scene.positions) p = point(p);
  for (vec3& n : scene.normals) n = direction(n);
  for (AnalyticSurface& s : scene.analytic) s = posed(s, pose);
  for (RoundCurve& curve : scene.curves)
    for (vec4& c : curve.control) c = vec4(point(vec3(c)), length(c.w));
  for (Material& m : scene.materials) {
    m.absorption = vec3(dvec3(m.absorption) / pose.scale);
    m.outer_absorption = vec3(dvec3(m.outer_absorption) / pose.scale);
  }
  for (Light& l : scene.lights)
    l.position = point(l.position), l.direction = direction(l.direction), l.range = length(l.range);
  for (Camera& c : scene.cameras) c = posed(c, pose);
  scene.bounds = {};
  for (const uvec3& t : scene.triangles)
    for (const uint32_t v : {t.x, t.y, t.z}) scene.bounds.extend(scene.positions[v]);
  for (const AnalyticSurface& s : scene.analytic) extend(scene.bounds, bounds(s));
  for (const RoundCurve& c : scene.curves) extend(scene.bounds, bounds(c));
  update_content_hash(scene);
  return scene;
}

dvec3 rebasing_offset(const Scene& scene) {
  return dvec3(scene.bounds.center());
}

}  // namespace hybray
