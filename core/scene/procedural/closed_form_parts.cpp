#include "core/scene/procedural/closed_form_parts.h"

namespace hybray::procedural {

uint32_t add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t add_clear(Scene& scene, const char* name, double ior, double absorption) {
  return add_material(scene, {.name = name,
                              .base_color = vec3(1.0f),
                              .roughness = 0.0f,
                              .transmission = 1.0f,
                              .ior = static_cast<float>(ior),
                              .absorption = vec3(static_cast<float>(absorption))});
}

uint32_t add_mirror(Scene& scene) {
  return add_material(scene, {.name = "mirror",
                              .base_color = vec3(static_cast<float>(kMirrorReflectance)),
                              .metallic = 1.0f,
                              .roughness = 0.0f});
}

void add_part(Scene& scene, MeshBuilder& part, uint32_t material, const char* name) {
  append_mesh(scene, part.take(), mat4(1.0f), material, name);
}

void add_parallelogram(Scene& scene, const dvec3& a, const dvec3& u, const dvec3& v, uint32_t material,
                       const char* name) {
  MeshBuilder part;
  part.quad(a, a + u, a + u + v, a + v);
  add_part(scene, part, material, name);
}

uint32_t add_receiver_material(Scene& scene) {
  return add_material(scene, {.name = "receiver", .base_color = vec3(0.8f), .roughness = 1.0f});
}

Scene with_floor(const char* name, double half_width) {
  Scene scene;
  scene.name = name;
  add_parallelogram(scene, {-half_width, 0, half_width}, {2 * half_width, 0, 0}, {0, 0, -2 * half_width},
                    add_receiver_material(scene), "receiver");
  return scene;
}

void add_lamp(Scene& scene, const dvec3& position) {
  scene.lights.push_back({.name = "lamp",
                          .kind = LightKind::point,
                          .position = vec3(position),
                          .intensity = static_cast<float>(kClosedFormIntensity)});
}

void add_sun(Scene& scene, const dvec3& direction) {
  scene.lights.push_back({.name = "sun",
                          .kind = LightKind::directional,
                          .direction = vec3(glm::normalize(direction)),
                          .intensity = static_cast<float>(kClosedFormIrradiance)});
}

void add_camera(Scene& scene, const dvec3& eye, const dvec3& target, float vertical_fov) {
  scene.cameras.push_back({"receiver", vec3(eye), vec3(target), vec3(0, 1, 0), vertical_fov});
}

void add_room(Scene& scene, double h, uint32_t material, const char* name) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-h, h}) {
      dvec3 a(-h), u(0.0), v(0.0);
      a[axis] = side;
      // u x v points along +axis; the walls face the room.
      u[(axis + 1) % 3] = 2 * h, v[(axis + 2) % 3] = 2 * h;
      if (side > 0)
        add_parallelogram(scene, a, v, u, material, name);
      else
        add_parallelogram(scene, a, u, v, material, name);
    }
}

}  // namespace hybray::procedural
