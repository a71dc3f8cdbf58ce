// Polished rings on a table: the cusps that light reflected inside a cylinder draws (a nephroid for light
// from afar, a cardioid for a lamp on the wall itself).
#include "core/scene/procedural/caustic_stage.h"

namespace hybray::procedural {
namespace {

void layout(Model& model) {
  using namespace caustic_stage;
  add_room(model, {1.0, 0.8, 0.8});
  const uint32_t gold = model.material(polished_gold()), silver = model.material(polished_silver());
  // Just clear of the table, so that no light is caught where the curved foot meets it.
  add_band(model, gold, "gold_ring", {-0.08, 0.0005, 0.05}, 0.14, 0.008, 0.06, 256.0);
  add_band(model, silver, "silver_ring", {0.32, 0.0005, 0.22}, 0.06, 0.005, 0.035, 160.0);
  model.light({.name = "lamp", .position = vec3(0.42f, 0.42f, 0.6f), .intensity = 1.2f});
  model.camera("front", {-0.12f, 0.62f, 0.72f}, {0.04f, 0.0f, 0.06f}, 36.0f);
  model.camera("inside", {-0.06f, 0.36f, 0.34f}, {-0.09f, 0.0f, 0.03f}, 45.0f);
  model.camera("above", {0.06f, 0.9f, 0.25f}, {0.06f, 0.0f, 0.08f}, 45.0f);
}

}  // namespace

Scene metal_ring(const Parameters& parameters) {
  return build("metal_ring", parameters, uint32_t{1} << 15, layout);
}

}  // namespace hybray::procedural
