// Materials and small scenes of the caustics tests.
#pragma once

#include "core/caustics/caustic_pass.h"
#include "core/gbuffer/gbuffer.h"
#include "tests/core/test_scenes.h"

#include <memory>
#include <vector>

namespace hybray::test {

inline Material matte(const vec3& albedo) {
  Material m;
  m.name = "matte";
  m.base_color = albedo;
  return m;
}

inline Material mirror(const vec3& reflectance) {
  Material m;
  m.name = "mirror";
  m.base_color = reflectance;
  m.metallic = 1.0f;
  m.roughness = 0.0f;
  return m;
}

inline Material glass(float ior, const vec3& absorption = vec3(0.0f)) {
  Material m;
  m.name = "glass";
  m.base_color = vec3(1.0f);
  m.roughness = 0.0f;
  m.transmission = 1.0f;
  m.ior = ior;
  m.absorption = absorption;
  return m;
}

inline uint32_t add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

inline Light point_light(const vec3& position, float intensity, const vec3& color = vec3(1.0f)) {
  Light light;
  light.name = "lamp";
  light.position = position;
  light.intensity = intensity;
  light.color = color;
  return light;
}

// A square floor of side 2 half at height y, facing up, of material 0.
inline void add_floor(Scene& scene, float half, float y = 0.0f) {
  add_rectangle(scene, vec3(-half, y, half), vec3(2.0f * half, 0.0f, 0.0f), vec3(0.0f, 0.0f, -2.0f * half));
}

// A rectangle of material `material`.
inline void add_sheet(Scene& scene, uint32_t material, const vec3& corner, const vec3& u, const vec3& v) {
  add_rectangle(scene, corner, u, v);
  scene.objects.back().material = material;
  for (uint32_t t = scene.objects.back().first_triangle; t < scene.triangles.size(); ++t)
    scene.triangle_material[t] = material;
}

// Everything at once: a floor of two-channel colour, a ball of absorbing glass, a metal ball, a thin sheet, a
// glossy painted block, under a coloured lamp; half of the light leaves the scene.
inline Scene mixed_scene() {
  Scene scene = empty_scene();
  scene.materials[0] = matte(vec3(0.8f, 0.5f, 0.2f));
  const uint32_t green = add_material(scene, glass(1.5f, vec3(1.0f, 0.1f, 0.6f)));
  const uint32_t gold = add_material(scene, mirror(vec3(0.9f, 0.7f, 0.3f)));
  Material pane = glass(1.5f);
  pane.base_color = vec3(0.9f, 0.95f, 1.0f);
  pane.thin_walled = true;
  const uint32_t sheet = add_material(scene, pane);
  Material paint = matte(vec3(0.7f, 0.1f, 0.1f));
  paint.roughness = 0.0f;
  const uint32_t glossy = add_material(scene, paint);
  Material half = glass(1.4f);
  half.metallic = 0.3f, half.thin_walled = true, half.transmission = 0.5f;
  half.base_color = vec3(0.6f, 0.9f, 0.4f);
  const uint32_t mixture = add_material(scene, half);
  add_floor(scene, 3.0f);
  append_analytic(scene, analytic_sphere("green", green, dvec3(0.0, 0.8, 0.0), 0.7));
  append_analytic(scene, analytic_sphere("gold", gold, dvec3(1.4, 0.6, 0.3), 0.5));
  add_sheet(scene, sheet, vec3(-2.0f, 0.2f, -1.0f), vec3(0.0f, 0.0f, 2.0f), vec3(0.3f, 1.5f, 0.0f));
  add_sheet(scene, glossy, vec3(-1.0f, 0.0f, -2.0f), vec3(2.0f, 0.0f, 0.0f), vec3(0.0f, 1.5f, -0.2f));
  add_sheet(scene, mixture, vec3(-0.6f, 1.8f, -0.6f), vec3(1.2f, 0.0f, 0.0f), vec3(0.0f, 0.1f, 1.2f));
  scene.lights.push_back(point_light(vec3(0.3f, 3.0f, 0.4f), 10.0f, vec3(1.0f, 0.8f, 0.5f)));
  update_content_hash(scene);
  return scene;
}

// A scene with its tracer and prepared optics.
struct Prepared {
  explicit Prepared(Scene s)
      : scene(std::move(s)), tracer(scene, {.robust = true, .high_quality = false}), caustic(tracer) {}
  Scene scene;
  Tracer tracer;
  caustics::CausticScene caustic;
};

inline View make_view(const Scene& scene, const vec3& eye, const vec3& target, int width, int height,
                      float fov = 50.0f, const vec3& up = vec3(0.0f, 1.0f, 0.0f)) {
  Camera camera;
  camera.name = "test";
  camera.eye = eye, camera.target = target, camera.up = up, camera.vertical_fov = fov;
  View::Settings settings;
  settings.width = width, settings.height = height;
  settings.near = 0.01;
  return View(camera, settings, scene.bounds);
}

constexpr unsigned kCausticBits = kDepth | kDepthDerivatives | kShadingNormal | kPrimitive;

inline double mean_flux(const caustics::Photon& p) {
  return (static_cast<double>(p.flux.x) + static_cast<double>(p.flux.y) + static_cast<double>(p.flux.z)) /
         3.0;
}

// Photons of equal flux on an n x n grid over the square [-half, half]^2 of the floor y = 0: irradiance 1
// W/m^2.
inline std::vector<caustics::Photon> even_floor(int n, double half) {
  std::vector<caustics::Photon> photons;
  const double step = 2.0 * half / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      caustics::Photon p;
      p.position = vec3(dvec3(-half + (i + 0.5) * step, 0.0, -half + (j + 0.5) * step));
      p.normal = vec3(0.0f, 1.0f, 0.0f);
      p.direction = vec3(0.6f, -0.8f, 0.0f);
      p.flux = vec3(static_cast<float>(step * step));
      p.cos_in = 0.8f;
      photons.push_back(p);
    }
  return photons;
}

}  // namespace hybray::test
