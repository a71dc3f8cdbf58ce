#include "core/scene/scene.h"

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/mesh_cleanup.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>

namespace hybray {
namespace {

// A copy of `mesh` with three vertices of its own for each triangle, which carry the triangle's normal.
Mesh with_flat_normals(const Mesh& mesh) {
  Mesh flat;
  flat.positions.reserve(3 * mesh.triangles.size());
  for (const uvec3& tri : mesh.triangles) {
    const dvec3 a(mesh.positions[tri.x]), b(mesh.positions[tri.y]), c(mesh.positions[tri.z]);
    const vec3 n(glm::normalize(glm::cross(b - a, c - a)));
    const auto first = static_cast<uint32_t>(flat.positions.size());
    for (uint32_t v : {tri.x, tri.y, tri.z}) {
      flat.positions.push_back(mesh.positions[v]);
      flat.normals.push_back(n);
    }
    flat.triangles.emplace_back(first, first + 1, first + 2);
  }
  return flat;
}

template <class T>
uint64_t hash_vector(const std::vector<T>& values, uint64_t seed) {
  return hash_bytes(values.data(), values.size() * sizeof(T), hash_bytes(&seed, sizeof seed, values.size()));
}

template <class... T>
uint64_t hash_values(uint64_t seed, const T&... values) {
  ((seed = hash_bytes(&values, sizeof values, seed)), ...);
  return seed;
}

}  // namespace

Mesh transformed(const Mesh& source, const dmat4& transform) {
  Mesh mesh = source;
  if (transform == dmat4(1.0)) return mesh;
  for (vec3& p : mesh.positions) p = vec3(dvec3(transform * dvec4(dvec3(p), 1.0)));
  const dmat3 linear(transform);
  const dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
  for (vec3& n : mesh.normals) n = vec3(glm::normalize(normal_matrix * dvec3(n)));
  if (glm::determinant(linear) < 0.0)
    for (uvec3& tri : mesh.triangles) std::swap(tri.y, tri.z);
  return mesh;
}

void append_mesh(Scene& scene, const Mesh& source, const mat4& transform, uint32_t material,
                 const std::string& name) {
  HYBRAY_CHECK_LT(material, scene.materials.size());
  Mesh mesh = transformed(source, dmat4(transform));
  if (mesh.normals.empty()) mesh = with_flat_normals(mesh);
  HYBRAY_CHECK_EQ(mesh.normals.size(), mesh.positions.size());
  HYBRAY_CHECK_LT(scene.positions.size() + mesh.positions.size(), size_t{0xffffffffu});
  HYBRAY_CHECK_LT(scene.triangles.size() + mesh.triangles.size(), size_t{0xffffffffu});

  const auto first_vertex = static_cast<uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), mesh.positions.begin(), mesh.positions.end());
  scene.normals.insert(scene.normals.end(), mesh.normals.begin(), mesh.normals.end());
  scene.objects.push_back({name, static_cast<uint32_t>(scene.triangles.size()),
                           static_cast<uint32_t>(mesh.triangles.size()), material});
  for (const uvec3& tri : mesh.triangles) {
    for (const uint32_t v : {tri.x, tri.y, tri.z}) scene.bounds.extend(mesh.positions[v]);
    scene.triangles.push_back(tri + uvec3(first_vertex));
    scene.triangle_material.push_back(material);
  }
}

void append_analytic(Scene& scene, const AnalyticSurface& surface) {
  HYBRAY_CHECK_LT(surface.material, scene.materials.size());
  check_surface(surface);
  scene.analytic.push_back(surface);
  const Bounds3 box = bounds(surface);
  scene.bounds.extend(box.lower);
  scene.bounds.extend(box.upper);
}

void append_curve(Scene& scene, const RoundCurve& curve) {
  HYBRAY_CHECK_LT(curve.material, scene.materials.size());
  check_curve(curve, scene.curves.size());
  scene.curves.push_back(curve);
  const Bounds3 box = bounds(curve);
  scene.bounds.extend(box.lower);
  scene.bounds.extend(box.upper);
}

Mesh object_mesh(const Scene& scene, const SceneObject& object) {
  Mesh mesh;
  if (object.triangle_count == 0) return mesh;
  const auto first = scene.triangles.begin() + object.first_triangle;
  mesh.triangles.assign(first, first + object.triangle_count);
  uint32_t lowest = 0xffffffffu, highest = 0;
  for (const uvec3& tri : mesh.triangles)
    for (const uint32_t v : {tri.x, tri.y, tri.z})
      lowest = std::min(lowest, v), highest = std::max(highest, v);
  mesh.positions.assign(scene.positions.begin() + lowest, scene.positions.begin() + highest + 1);
  mesh.normals.assign(scene.normals.begin() + lowest, scene.normals.begin() + highest + 1);
  for (uvec3& tri : mesh.triangles) tri -= uvec3(lowest);
  remove_unused_vertices(mesh);
  return mesh;
}

void update_content_hash(Scene& scene) {
  uint64_t h = hash_text("scene-2");
  h = hash_vector(scene.positions, h);
  h = hash_vector(scene.normals, h);
  h = hash_vector(scene.triangles, h);
  h = hash_vector(scene.triangle_material, h);
  for (const Material& m : scene.materials)
    h = hash_values(h, m.base_color, m.metallic, m.roughness, m.transmission, m.ior, m.outer_ior,
                    m.absorption, m.outer_absorption, m.thin_walled, m.conductor_eta, m.conductor_k,
                    m.emissive);
  // Scenes without cut-outs keep the hash that they had before there were any.
  for (size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].cut_out != CutOut::none)
      h = hash_values(hash_text("cut-out", h), i, scene.materials[i].cut_out);
  for (const Light& l : scene.lights)
    h = hash_values(h, l.kind, l.position, l.direction, l.color, l.intensity, l.inner_cone_angle,
                    l.outer_cone_angle, l.range);
  for (const Camera& c : scene.cameras)
    h = hash_values(hash_text(c.name, h), c.eye, c.target, c.up, c.vertical_fov);
  for (const AnalyticSurface& s : scene.analytic) {
    h = hash_values(h, s.material, s.kind, s.center, s.radius, s.y0, s.y1, s.focal_length);
    if (s.kind == AnalyticSurface::Kind::field)
      h = hash_values(h, s.field.shape, s.field.radius, s.field.thickness, s.field.period, s.field.axis);
  }
  static_assert(sizeof(RoundCurve) == 4 * sizeof(vec4) + sizeof(uint32_t), "no padding in what is hashed");
  if (!scene.curves.empty()) h = hash_vector(scene.curves, hash_text("curves", h));
  scene.content_hash = h;
}

const Camera& find_camera(const Scene& scene, const std::string& name) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == name) return camera;
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) names.push_back(camera.name);
  throw InputError("scene " + scene.name,
                   fmt::format("no camera is named '{}'; its cameras are: {}", name,
                               names.empty() ? "(none)" : fmt::format("{}", fmt::join(names, ", "))));
}

dvec3 geometric_normal(const Scene& scene, uint32_t triangle) {
  const uvec3& tri = scene.triangles[triangle];
  const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
  return glm::normalize(glm::cross(b - a, c - a));
}

}  // namespace hybray
