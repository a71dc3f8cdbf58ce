#include "core/scene/procedural/closed_form_scenes.h"

#include "core/scene/procedural/closed_form_parts.h"
#include "core/scene/procedural/exact_scene.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace hybray::procedural {
namespace {

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

Scene scene_of(const BallLens& c) {
  Scene scene = with_floor("closed_ball_lens", c.floor);
  append_analytic(
      scene, analytic_sphere("ball", add_clear(scene, "glass", c.ior), {0, c.center_height, 0}, c.radius));
  add_lamp(scene, {0, c.light_height, 0});
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

Scene scene_of(const GlassSlab& c) {
  Scene scene = with_floor("closed_glass_slab", c.floor);
  MeshBuilder part;
  part.box({-c.half_width, c.bottom, -c.half_width}, {c.half_width, c.bottom + c.thickness, c.half_width});
  add_part(scene, part, add_clear(scene, "glass", c.ior, c.absorption), "slab");
  add_lamp(scene, {0, c.light_height, 0});
  add_camera(scene, {0, 0.8, 3.5}, {0, 0, 0}, 75.0f);
  return scene;
}

Scene scene_of(const FlatWater& c) {
  Scene scene = with_floor("closed_flat_water", c.floor);
  MeshBuilder part;
  part.box({-c.half_width, -c.below, -c.half_width}, {c.half_width, c.depth, c.half_width});
  add_part(scene, part, add_clear(scene, "water", c.ior), "water");
  add_lamp(scene, {0, c.light_height, 0});
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

Scene scene_of(const Furnace& c) {
  Scene scene;
  scene.name = "closed_furnace";
  const uint32_t white =
      add_material(scene, {.name = "receiver", .base_color = vec3(1.0f), .roughness = 1.0f});
  add_room(scene, c.half_room, white, "receiver");
  append_analytic(scene, analytic_sphere("ball", add_clear(scene, "glass", c.ior), dvec3(0), c.radius));
  add_lamp(scene, dvec3(c.light));
  add_camera(scene, {2.5, 2.5, -2.5}, {0, 0, 0}, 75.0f);
  return scene;
}

template <class Case>
Scene standard() {
  return scene_of(Case{});
}

template <class Case>
Scene hashed(const Case& c) {
  Scene scene = scene_of(c);
  update_content_hash(scene);
  return scene;
}

}  // namespace

Scene closed_form_scene(const BallLens& c) {
  return hashed(c);
}
Scene closed_form_scene(const GlassSlab& c) {
  return hashed(c);
}
Scene closed_form_scene(const FlatWater& c) {
  return hashed(c);
}
Scene closed_form_scene(const Furnace& c) {
  return hashed(c);
}

std::span<const Generator> closed_form_generators() {
  static constexpr std::array<Generator, 10> kGenerators{{
      {"closed_ball_lens", "a glass ball under a lamp", 2, exact<standard<BallLens>>, true},
      {"closed_cardioid", "a lamp over the wall of a mirrored cylinder", 2, exact<cardioid>, true},
      {"closed_cylinder", "parallel light in a mirrored cylinder", 2, exact<cylinder>, true},
      {"closed_flat_water", "the floor of still water under a lamp", 14, exact<standard<FlatWater>>, true},
      {"closed_furnace", "a glass ball in a closed white room", 12, exact<standard<Furnace>>, true},
      {"closed_glass_slab", "a plate of glass under a lamp", 14, exact<standard<GlassSlab>>, true},
      {"closed_paraboloid", "a parabolic mirror with the lamp at its focus", 2, exact<paraboloid>, true},
      {"closed_plane_mirror", "a mirror on the floor beside a lamp", 4, exact<plane_mirror>, true},
      {"closed_prism", "parallel light through an equilateral prism", 10, exact<prism>, true},
      {"closed_tir_prism", "total reflection in a right-angled prism", 10, exact<tir_prism>, true},
  }};
  return kGenerators;
}

}  // namespace hybray::procedural
