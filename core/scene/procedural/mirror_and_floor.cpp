// Two plane mirrors and a glass ball. The low one throws a patch of the spot light's beam onto the floor; in
// the standing one the ball's caustic is seen a second time (a mixed caustic).
#include "core/scene/procedural/caustic_stage.h"

namespace hybray::procedural {
namespace {

// A mirror `width` by `height` centred in its frame's plane z = 0, facing +z, on a wooden board.
void add_mirror(Model& model, uint32_t mirror, uint32_t wood, const std::string& name, double width,
                double height, const dmat4& frame) {
  const Lod lod = model.lod(key(name.c_str()));
  const double x = 0.5 * width, y = 0.5 * height, edge = 0.05;
  MeshBuilder board = model.part(), glass = model.part();
  board.bevelled_box({-x - edge, -y - edge, -0.05}, {x + edge, y + edge, -0.004}, 0.008);
  caustic_stage::ground(glass, lod, {-x, -y, 0}, {width, 0, 0}, {0, height, 0});
  model.add(std::move(board), wood, name + "_board", frame);
  model.add(std::move(glass), mirror, name, frame);
}

// A frame at `at` whose +z axis points at `toward`.
dmat4 facing(const dvec3& at, const dvec3& toward) {
  const dvec3 z = glm::normalize(toward - at), x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  const dvec3 y = glm::cross(z, x);
  return {dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), dvec4(at, 1)};
}

void layout(Model& model) {
  using namespace caustic_stage;
  add_room(model, {2.6, 2.2, 2.4});
  const uint32_t mirror = model.material(front_mirror());
  const uint32_t wood = model.material(matte("wood", {0.3f, 0.17f, 0.08f}));

  // The standing mirror at the back, a little turned toward the cameras.
  add_mirror(model, mirror, wood, "standing_mirror", 1.5, 1.3, facing({0.55, 0.72, -1.5}, {0.35, 0.72, 1.0}));

  add_ball(model, model.material(clear_glass()), "ball", {0.55, 0.42, -0.25}, 0.28, 150.0);
  model.light({.name = "lamp", .position = vec3(-0.15f, 1.6f, 0.35f), .intensity = 9.0f});

  // The low mirror on the left: its normal halves the angle between the spot light and where the patch falls.
  const dvec3 low(-1.5, 0.55, -0.6), patch(-0.55, 0.0, 0.75), spot(-0.7, 2.2, -1.2);
  const dvec3 normal = glm::normalize(glm::normalize(patch - low) + glm::normalize(spot - low));
  add_mirror(model, mirror, wood, "low_mirror", 0.4, 0.4, facing(low, low + normal));
  model.light({.name = "spot",
               .kind = LightKind::spot,
               .position = vec3(spot),
               .direction = vec3(glm::normalize(low - spot)),
               .color = vec3(1.0f, 0.86f, 0.65f),
               .intensity = 30.0f,
               .inner_cone_angle = 0.1f,
               .outer_cone_angle = 0.2f});
  model.camera("front", {0.1f, 1.45f, 2.6f}, {0.0f, 0.45f, -0.4f}, 50.0f);
  model.camera("mirror", {-0.25f, 0.95f, 1.5f}, {0.5f, 0.5f, -0.8f}, 45.0f);
  model.camera("patch", {0.3f, 1.0f, 1.9f}, {-0.7f, 0.15f, 0.2f}, 45.0f);
}

}  // namespace

Scene mirror_and_floor(const Parameters& parameters) {
  return build("mirror_and_floor", parameters, uint32_t{1} << 15, layout);
}

}  // namespace hybray::procedural
