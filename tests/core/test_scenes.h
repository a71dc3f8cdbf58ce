// Small scenes and random numbers that several tests share.
#pragma once

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/procedural/closed_form_scenes.h"
#include "core/scene/scene.h"
#include "core/scene/scene_library.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace hybray::test {

// A scene without triangles, with one material.
inline Scene empty_scene() {
  Scene scene;
  scene.name = "test";
  scene.materials.push_back({});
  return scene;
}

// Adds the rectangle with corner `a` and edges `u`, `v` (front side: cross(u, v)), as `cells` x `cells`
// quads.
inline void add_rectangle(Scene& scene, const vec3& a, const vec3& u, const vec3& v, int cells = 1) {
  Mesh mesh;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      mesh.positions.push_back(a + u * (static_cast<float>(i) / static_cast<float>(cells)) +
                               v * (static_cast<float>(j) / static_cast<float>(cells)));
  const auto row = static_cast<uint32_t>(cells + 1);
  for (uint32_t j = 0; j < static_cast<uint32_t>(cells); ++j)
    for (uint32_t i = 0; i < static_cast<uint32_t>(cells); ++i) {
      const uint32_t p = j * row + i;
      mesh.triangles.emplace_back(p, p + 1, p + row + 1);
      mesh.triangles.emplace_back(p, p + row + 1, p + row);
    }
  append_mesh(scene, mesh, mat4(1.0f), 0, "rectangle");
}

// `count` random triangles, edges up to `size`, inside the cube [-extent, extent]^3.
inline Scene triangle_soup(uint32_t count, float size, float extent, uint64_t seed) {
  Scene scene = empty_scene();
  Mesh mesh;
  for (uint32_t i = 0; i < count; ++i) {
    const auto unit = [&](uint32_t d) { return static_cast<float>(2.0 * random_unit(i, d, 0, seed) - 1.0); };
    const vec3 center = extent * vec3(unit(0), unit(1), unit(2));
    for (uint32_t k = 0; k < 3; ++k)
      mesh.positions.push_back(center + size * vec3(unit(3 + 3 * k), unit(4 + 3 * k), unit(5 + 3 * k)));
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  append_mesh(scene, mesh, mat4(1.0f), 0, "soup");
  return scene;
}

// Distance at which o + t d meets the triangle, by Moeller and Trumbore's test in double; nothing where it
// misses by more than `slack` in barycentric units.
inline std::optional<double> exact_hit(const Scene& scene, uint32_t triangle, const dvec3& o, const dvec3& d,
                                       double slack = 0.0) {
  const uvec3& tri = scene.triangles[triangle];
  const dvec3 a(scene.positions[tri.x]), e1 = dvec3(scene.positions[tri.y]) - a,
                                         e2 = dvec3(scene.positions[tri.z]) - a;
  const dvec3 p = glm::cross(d, e2);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return std::nullopt;
  const dvec3 s = o - a, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
  if (u < -slack || v < -slack || u + v > 1.0 + slack) return std::nullopt;
  const double t = glm::dot(e2, q) / det;
  return t >= 0.0 ? std::optional<double>(t) : std::nullopt;
}

// The scene that a generator of closed_form_generators() makes.
inline Scene closed_form_scene(const std::string& name) {
  for (const procedural::Generator& generator : procedural::closed_form_generators())
    if (generator.name == name) return generator.generate({});
  throw InputError(name, "no such scene");
}

// The project's own scenes and, where they are, the external ones.
inline ScenePaths scene_paths() {
  return default_scene_paths(HYBRAY_PROJECT_DIR);
}

// True where tests that need external scenes must not be skipped.
inline bool scenes_required() {
  const char* required = std::getenv("HYBRAY_REQUIRE_SCENES");
  return required && std::string(required) == "1";
}

}  // namespace hybray::test
