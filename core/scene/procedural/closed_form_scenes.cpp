#include "core/scene/procedural/closed_form_scenes.h"

#include "core/scene/procedural/exact_scene.h"
#include "core/scene/procedural/mesh_builder.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace hybray::procedural {
namespace {

uint32_t add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t add_clear(Scene& scene, const char* name, double ior, double absorption = 0.0) {
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

// The parallelogram with corner `a` and edges u and v; its front is the side of u x v.
void add_parallelogram(Scene& scene, const dvec3& a, const dvec3& u, const dvec3& v, uint32_t material,
                       const char* name) {
  MeshBuilder part;
  part.quad(a, a + u, a + u + v, a + v);
  add_part(scene, part, material, name);
}

uint32_t add_receiver_material(Scene& scene) {
  return add_material(scene, {.name = "receiver", .base_color = vec3(0.8f), .roughness = 1.0f});
}

// A scene with a floor, which is its first object.
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

// The body between z = -half_length and half_length over a convex cross section, counter-clockwise in (x, y).
void add_extruded(Scene& scene, const std::vector<dvec2>& section, double half_length, uint32_t material) {
  MeshBuilder part;
  std::vector<dvec3> front, back;
  for (size_t i = 0; i < section.size(); ++i) {
    const dvec2 a = section[i], b = section[(i + 1) % section.size()];
    part.quad(dvec3(a, half_length), dvec3(a, -half_length), dvec3(b, -half_length), dvec3(b, half_length));
    front.emplace_back(a, half_length);
    back.emplace_back(section[section.size() - 1 - i], -half_length);
  }
  part.face(front);
  part.face(back);
  add_part(scene, part, material, "prism");
}

Scene ball_lens() {
  using C = BallLens;
  Scene scene = with_floor("closed_ball_lens", C::floor);
  append_analytic(scene, analytic_sphere("ball", add_clear(scene, "glass", kGlassIor),
                                         {0, C::center_height, 0}, C::radius));
  add_lamp(scene, {0, C::light_height, 0});
  add_camera(scene, {0, 0.45, 2.2}, {0, 0, 0}, 40.0f);
  return scene;
}

Scene plane_mirror() {
  using C = PlaneMirror;
  Scene scene = with_floor("closed_plane_mirror", C::floor);
  add_parallelogram(scene, {C::x, 0, -C::half_width}, {0, 0, 2 * C::half_width}, {0, C::height, 0},
                    add_mirror(scene), "mirror");
  add_lamp(scene, {0, C::light_height, 0});
  add_camera(scene, {0, 2.5, 5}, {-0.5, 0, 0}, 70.0f);
  return scene;
}

Scene glass_slab() {
  using C = GlassSlab;
  Scene scene = with_floor("closed_glass_slab", C::floor);
  MeshBuilder part;
  part.box({-C::half_width, C::bottom, -C::half_width},
           {C::half_width, C::bottom + C::thickness, C::half_width});
  add_part(scene, part, add_clear(scene, "glass", kGlassIor, C::absorption), "slab");
  add_lamp(scene, {0, C::light_height, 0});
  add_camera(scene, {0, 0.8, 3.5}, {0, 0, 0}, 75.0f);
  return scene;
}

Scene flat_water() {
  using C = FlatWater;
  Scene scene = with_floor("closed_flat_water", C::floor);
  MeshBuilder part;
  part.box({-C::half_width, -C::below, -C::half_width}, {C::half_width, C::depth, C::half_width});
  add_part(scene, part, add_clear(scene, "water", C::ior), "water");
  add_lamp(scene, {0, C::light_height, 0});
  add_camera(scene, {0, 0.9, 3.5}, {0, 0, 0}, 75.0f);
  return scene;
}

Scene paraboloid() {
  using C = ParaboloidMirror;
  Scene scene = with_floor("closed_paraboloid", C::floor);
  append_analytic(scene, analytic_paraboloid("mirror", add_mirror(scene), {0, C::vertex_height, 0},
                                             -C::focal_length, C::rim_radius));
  add_lamp(scene, {0, C::vertex_height - C::focal_length, 0});
  add_camera(scene, {0, 1.2, 3}, {0, 0, 0}, 50.0f);
  return scene;
}

Scene cylinder() {
  using C = CylinderMirror;
  Scene scene = with_floor("closed_cylinder", C::floor);
  append_analytic(scene,
                  analytic_cylinder("mirror", add_mirror(scene), dvec3(0), C::radius, -C::below, C::height));
  add_sun(scene, {1, -C::slope, 0});
  add_camera(scene, {0, 3, 0.6}, {0, 0, 0}, 45.0f);
  return scene;
}

Scene cardioid() {
  using C = CardioidMirror;
  Scene scene = with_floor("closed_cardioid", C::floor);
  append_analytic(scene,
                  analytic_cylinder("mirror", add_mirror(scene), dvec3(0), C::radius, -C::below, C::height));
  add_lamp(scene, {-C::radius, C::light_height, 0});
  add_camera(scene, {0, 3, 0.6}, {0, 0, 0}, 45.0f);
  return scene;
}

Scene prism() {
  using C = Prism;
  Scene scene = with_floor("closed_prism", C::floor);
  const double height = 0.5 * std::numbers::sqrt3 * C::side, y = C::center_height;
  add_extruded(scene,
               {{-height * 2 / 3, y}, {height / 3, y - 0.5 * C::side}, {height / 3, y + 0.5 * C::side}},
               C::half_length, add_clear(scene, "glass", kGlassIor));
  const double angle = C::light_angle * std::numbers::pi / 180.0;
  add_sun(scene, {std::cos(angle), std::sin(angle), 0});
  add_camera(scene, {0.4, 0.6, 3}, {0.4, 0, 0}, 50.0f);
  return scene;
}

Scene tir_prism() {
  using C = TirPrism;
  Scene scene;
  scene.name = "closed_tir_prism";
  add_parallelogram(scene, {C::wall_x, 0, -C::wall_half_width}, {0, 0, 2 * C::wall_half_width},
                    {0, C::wall_half_width, 0}, add_receiver_material(scene), "receiver");
  add_extruded(scene,
               {{C::right_angle_x - C::leg, C::right_angle_y},
                {C::right_angle_x, C::right_angle_y - C::leg},
                {C::right_angle_x, C::right_angle_y}},
               C::half_length, add_clear(scene, "glass", kGlassIor));
  add_sun(scene, {0, -1, 0});
  add_camera(scene, {0.9, 1.5, 3}, {3, 1.5, 0}, 60.0f);
  return scene;
}

Scene furnace() {
  using C = Furnace;
  Scene scene;
  scene.name = "closed_furnace";
  const uint32_t white =
      add_material(scene, {.name = "receiver", .base_color = vec3(1.0f), .roughness = 1.0f});
  const double h = C::half_room;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-h, h}) {
      dvec3 a(-h), u(0.0), v(0.0);
      a[axis] = side;
      // u x v points along +axis; the walls face the room.
      u[(axis + 1) % 3] = 2 * h, v[(axis + 2) % 3] = 2 * h;
      if (side > 0)
        add_parallelogram(scene, a, v, u, white, "receiver");
      else
        add_parallelogram(scene, a, u, v, white, "receiver");
    }
  append_analytic(scene, analytic_sphere("ball", add_clear(scene, "glass", kGlassIor), dvec3(0), C::radius));
  add_lamp(scene, dvec3(C::light));
  add_camera(scene, {2.5, 2.5, -2.5}, {0, 0, 0}, 75.0f);
  return scene;
}

}  // namespace

std::span<const Generator> closed_form_generators() {
  static constexpr std::array<Generator, 10> kGenerators{{
      {"closed_ball_lens", "a glass ball under a lamp", 2, exact<ball_lens>, true},
      {"closed_cardioid", "a lamp over the wall of a mirrored cylinder", 2, exact<cardioid>, true},
      {"closed_cylinder", "parallel light in a mirrored cylinder", 2, exact<cylinder>, true},
      {"closed_flat_water", "the floor of still water under a lamp", 14, exact<flat_water>, true},
      {"closed_furnace", "a glass ball in a closed white room", 12, exact<furnace>, true},
      {"closed_glass_slab", "a plate of glass under a lamp", 14, exact<glass_slab>, true},
      {"closed_paraboloid", "a parabolic mirror with the lamp at its focus", 2, exact<paraboloid>, true},
      {"closed_plane_mirror", "a mirror on the floor beside a lamp", 4, exact<plane_mirror>, true},
      {"closed_prism", "parallel light through an equilateral prism", 10, exact<prism>, true},
      {"closed_tir_prism", "total reflection in a right-angled prism", 10, exact<tir_prism>, true},
  }};
  return kGenerators;
}

}  // namespace hybray::procedural
