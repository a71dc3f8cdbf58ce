// The street: a bending town street with a square, in the spirit of Amazon's Bistro scene.
#include "core/scene/procedural/street.h"

namespace hybray::procedural {
namespace street_parts {

Materials make_materials(Model& model) {
  const auto matte = [&](const char* name, vec3 color, float roughness = 0.8f) {
    return model.material({.name = name, .base_color = color, .roughness = roughness});
  };
  const auto metal = [&](const char* name, vec3 color, float roughness) {
    return model.material({.name = name, .base_color = color, .metallic = 1.0f, .roughness = roughness});
  };
  const auto clear = [&](const char* name, vec3 color, float ior) {
    return model.material(
        {.name = name, .base_color = color, .roughness = 0.0f, .transmission = 1.0f, .ior = ior});
  };
  const auto glow = [&](const char* name, vec3 color, vec3 emissive, float roughness) {
    return model.material({.name = name, .base_color = color, .roughness = roughness, .emissive = emissive});
  };
  Materials m{};
  m.plaster = {matte("plaster_cream", {0.60f, 0.50f, 0.36f}), matte("plaster_ochre", {0.55f, 0.36f, 0.17f}),
               matte("plaster_rose", {0.52f, 0.29f, 0.22f}),  matte("plaster_grey", {0.44f, 0.43f, 0.41f}),
               matte("plaster_sand", {0.50f, 0.42f, 0.31f}),  matte("plaster_brick", {0.34f, 0.13f, 0.08f})};
  m.shutter = {matte("shutter_green", {0.05f, 0.16f, 0.10f}, 0.5f),
               matte("shutter_blue", {0.09f, 0.18f, 0.30f}, 0.5f),
               matte("shutter_brown", {0.16f, 0.08f, 0.04f}, 0.5f),
               matte("shutter_grey", {0.32f, 0.34f, 0.34f}, 0.5f)};
  m.fabric = {matte("fabric_red", {0.45f, 0.03f, 0.03f}), matte("fabric_green", {0.03f, 0.20f, 0.08f}),
              matte("fabric_blue", {0.05f, 0.11f, 0.33f}), matte("fabric_orange", {0.60f, 0.22f, 0.03f})};
  m.paint = {
      matte("paint_red", {0.40f, 0.02f, 0.02f}, 0.1f), matte("paint_teal", {0.02f, 0.20f, 0.22f}, 0.1f),
      matte("paint_ivory", {0.60f, 0.54f, 0.40f}, 0.1f), matte("paint_navy", {0.02f, 0.04f, 0.14f}, 0.1f)};
  m.stone = matte("stone", {0.52f, 0.47f, 0.39f});
  m.dark_stone = matte("dark_stone", {0.24f, 0.22f, 0.20f}, 0.4f);
  m.asphalt = matte("asphalt", {0.07f, 0.07f, 0.075f}, 0.2f);  // wet after rain
  m.kerb = matte("kerb", {0.36f, 0.35f, 0.33f}, 0.6f);
  m.slate = matte("slate", {0.10f, 0.11f, 0.13f}, 0.5f);
  m.zinc = metal("zinc", {0.55f, 0.56f, 0.58f}, 0.4f);
  m.white_wood = matte("white_wood", {0.62f, 0.60f, 0.55f}, 0.5f);
  m.wood = matte("wood", {0.26f, 0.13f, 0.06f}, 0.5f);
  m.iron = matte("iron", {0.03f, 0.03f, 0.035f}, 0.5f);
  m.steel = metal("steel", {0.62f, 0.62f, 0.63f}, 0.3f);
  m.chrome = metal("chrome", {0.92f, 0.92f, 0.93f}, 0.05f);
  m.brass = metal("brass", {0.80f, 0.60f, 0.28f}, 0.2f);
  m.pane = matte("pane", {0.03f, 0.035f, 0.04f}, 0.03f);
  m.lit_pane = glow("lit_pane", {0.05f, 0.04f, 0.03f}, {0.9f, 0.55f, 0.25f}, 0.05f);
  m.glass = clear("glass", {0.97f, 0.98f, 0.98f}, 1.5f);
  m.wine = clear("wine_glass", {0.35f, 0.55f, 0.25f}, 1.5f);
  m.ceramic = matte("ceramic", {0.72f, 0.71f, 0.68f}, 0.15f);
  m.rubber = matte("rubber", {0.03f, 0.03f, 0.03f});
  m.leaf = matte("leaf", {0.10f, 0.23f, 0.05f}, 0.5f);
  m.dark_leaf = matte("dark_leaf", {0.05f, 0.14f, 0.04f}, 0.5f);
  m.flower = matte("flower", {0.62f, 0.06f, 0.12f}, 0.7f);
  m.bark = matte("bark", {0.17f, 0.12f, 0.08f});
  m.terracotta = matte("terracotta", {0.46f, 0.19f, 0.10f});
  m.soil = matte("soil", {0.07f, 0.045f, 0.03f});
  m.canvas = matte("canvas", {0.66f, 0.60f, 0.48f}, 0.9f);
  m.sheet = model.material({.name = "sheet",
                            .base_color = vec3(0.97f, 0.98f, 0.98f),
                            .roughness = 0.0f,
                            .transmission = 1.0f,
                            .thin_walled = true});
  m.bulb = glow("bulb", vec3(0.0f), {10.0f, 6.5f, 3.0f}, 1.0f);
  return m;
}

}  // namespace street_parts

namespace {

void layout(Model& model) {
  using namespace street_parts;
  const Materials m = make_materials(model);
  const std::vector<House> houses = make_houses(model);
  add_ground(model, m);
  add_roofs(model, m, houses);
  for (const House& house : houses) add_facade(model, m, house);
  add_furniture(model, m);
  add_cafes(model, m);
  add_vehicles(model, m);
  add_trees(model, m);
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(0.42f, -1.0f, -0.52f)),
               .color = vec3(1.0f, 0.92f, 0.80f),
               .intensity = 6.0f});
  model.camera("street", {-36.0f, 1.65f, 0.6f}, {-6.0f, 3.2f, -0.8f}, 65.0f);
  model.camera("square", {0.5f, 1.7f, -5.0f}, {-6.2f, 2.4f, -16.5f}, 70.0f);
  model.camera("terrace", {-5.4f, 1.55f, -7.9f}, {-4.6f, 1.15f, -13.0f}, 65.0f);
  model.camera("bend", {33.0f, 1.65f, 9.3f}, {8.0f, 3.0f, 1.2f}, 65.0f);
  model.camera("shopfront", {-16.6f, 1.65f, -0.9f}, {-24.2f, 2.0f, -6.5f}, 70.0f);
}

}  // namespace

Scene street(const Parameters& parameters) {
  return build("street", parameters, uint32_t{1} << 20, layout);
}

}  // namespace hybray::procedural
