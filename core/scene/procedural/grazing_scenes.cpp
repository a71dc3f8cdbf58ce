// Closed-form scenes that are hard on arithmetic: light that grazes what bends it or what it falls on, and a
// box that lets none out.
#include "core/scene/procedural/closed_form_parts.h"

#include <cmath>

namespace hybray::procedural {

double GrazedReceiver::half_length() const {
  return 0.5 / std::cos(incidence);
}
dvec3 GrazedReceiver::normal() const {
  return {-std::cos(incidence), std::sin(incidence), 0.0};
}
dvec3 GrazedReceiver::along() const {
  return {std::sin(incidence), std::cos(incidence), 0.0};
}

Scene closed_form_scene(const SunlitPool& c) {
  Scene scene;
  scene.name = "sunlit_pool";
  const double w = c.half_width, wall = w + c.gap;
  add_parallelogram(scene, {-w, 0, w}, {2 * w, 0, 0}, {0, 0, -2 * w}, add_receiver_material(scene),
                    "receiver");
  MeshBuilder part;
  part.box({-w, -c.below, -w}, {w, c.depth, w});
  add_part(scene, part, add_clear(scene, "water", c.ior), "water");
  const uint32_t black = add_material(scene, {.name = "black", .base_color = vec3(0.0f), .roughness = 1.0f});
  add_parallelogram(scene, {-wall, -c.below, -wall}, {0, c.depth + c.below, 0}, {0, 0, 2 * wall}, black,
                    "wall");
  add_sun(scene, {std::sin(c.incidence), -std::cos(c.incidence), 0});
  add_camera(scene, {0, 0.9, 3.5}, {0, 0, 0}, 75.0f);
  update_content_hash(scene);
  return scene;
}

Scene closed_form_scene(const GrazedReceiver& c) {
  Scene scene;
  scene.name = "grazed_receiver";
  const double length = c.half_length(), margin = 1.25 * length;
  const dvec3 corner = c.center() - margin * c.along() - dvec3(0, 0, margin);
  add_parallelogram(scene, corner, {0, 0, 2 * margin}, 2 * margin * c.along(), add_receiver_material(scene),
                    "receiver");
  add_parallelogram(scene, {0.5, -0.5, -length}, {0, 0, 2 * length}, {-1, 1, 0}, add_mirror(scene), "mirror");
  add_sun(scene, {0, -1, 0});
  // Straight over the lit square, of which it sees the middle half in each direction.
  const dvec3 eye = c.center() + 2.0 * length * c.normal();
  scene.cameras.push_back({"receiver", vec3(eye), vec3(c.center()), vec3(c.along()),
                           static_cast<float>(2.0 * std::atan(0.25) * 180.0 / 3.14159265358979323846)});
  update_content_hash(scene);
  return scene;
}

Scene closed_form_scene(const SealedBox& c) {
  Scene scene;
  scene.name = "sealed_box";
  add_room(scene, c.half_room, add_receiver_material(scene), "receiver");
  add_room(scene, c.half_box, add_mirror(scene), "mirror");
  add_lamp(scene, c.light);
  add_camera(scene, {2.5, 2.5, -2.5}, {0, 0, 0}, 75.0f);
  update_content_hash(scene);
  return scene;
}

}  // namespace hybray::procedural
