// A solid glass ball above a matte floor: the plainest caustic, whose form on the axis is known.
#include "core/scene/procedural/caustic_stage.h"

namespace hybray::procedural {
namespace {

void layout(Model& model) {
  using namespace caustic_stage;
  add_room(model, {3.0, 2.5, 3.0});
  add_ball(model, model.material(clear_glass()), "ball", {0.0, 0.75, 0.0}, 0.5, 184.0);
  model.light({.name = "lamp", .position = vec3(-1.7f, 3.0f, 0.6f), .intensity = 40.0f});
  model.camera("front", {0.9f, 1.7f, 3.3f}, {0.25f, 0.5f, 0.0f}, 40.0f);
  model.camera("caustic", {1.5f, 1.1f, 1.3f}, {0.45f, 0.05f, -0.1f}, 45.0f);
  model.camera("through", {-1.3f, 1.25f, 1.5f}, {0.1f, 0.6f, -0.05f}, 40.0f);
}

}  // namespace

Scene glass_ball(const Parameters& parameters) {
  return build("glass_ball", parameters, uint32_t{1} << 15, layout);
}

}  // namespace hybray::procedural
