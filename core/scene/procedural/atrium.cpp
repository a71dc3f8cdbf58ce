// The atrium: a two-storey colonnaded hall, 30 m long, in the spirit of the Sponza palace's courtyard.
#include "core/scene/procedural/atrium.h"

namespace hybray::procedural {
namespace atrium_parts {

namespace {

// `on_long` places along each long side of the ring and `on_short` along each short one, a bay apart about
// the side's middle.
std::vector<Place> around_the_ring(int on_long, int on_short) {
  std::vector<Place> places;
  const auto side = [&](double x, double z, double yaw, int count) {
    for (int i = 0; i < count; ++i)
      places.push_back(
          {moved({x, 0, z}) * turned(yaw) * moved({(i - 0.5 * (count - 1)) * kBay, 0, 0}), places.size()});
  };
  side(0, -kRingZ, 0.0, on_long);
  side(0, kRingZ, kPi, on_long);
  side(-kRingX, 0, 0.5 * kPi, on_short);
  side(kRingX, 0, -0.5 * kPi, on_short);
  return places;
}

}  // namespace

const std::vector<Place>& bays() {
  static const std::vector<Place> kPlaces = around_the_ring(7, 3);
  return kPlaces;
}

const std::vector<Place>& columns() {
  static const std::vector<Place> kPlaces = around_the_ring(8, 2);
  return kPlaces;
}

Materials make_materials(Model& model) {
  const auto matte = [&](const char* name, vec3 color, float roughness) {
    return model.material({.name = name, .base_color = color, .roughness = roughness});
  };
  const auto metal = [&](const char* name, vec3 color, float roughness) {
    return model.material({.name = name, .base_color = color, .metallic = 1.0f, .roughness = roughness});
  };
  const auto clear = [&](const char* name, vec3 color, float ior) {
    return model.material(
        {.name = name, .base_color = color, .roughness = 0.0f, .transmission = 1.0f, .ior = ior});
  };
  Materials m{};
  m.stone = matte("stone", {0.44f, 0.36f, 0.27f}, 0.8f);
  m.pale_stone = matte("pale_stone", {0.58f, 0.52f, 0.43f}, 0.7f);
  m.plaster = matte("plaster", {0.56f, 0.43f, 0.31f}, 0.9f);
  m.marble_light = matte("marble_light", {0.52f, 0.48f, 0.42f}, 0.2f);
  m.tile = matte("tile", {0.30f, 0.17f, 0.11f}, 0.2f);
  m.marble_dark = matte("marble_dark", {0.17f, 0.13f, 0.11f}, 0.15f);
  m.wood = matte("wood", {0.22f, 0.11f, 0.05f}, 0.5f);
  m.iron = matte("iron", {0.05f, 0.05f, 0.05f}, 0.6f);
  m.brass = metal("brass", {0.78f, 0.57f, 0.25f}, 0.2f);
  m.gold = metal("gold", {0.85f, 0.62f, 0.22f}, 0.4f);
  m.terracotta = matte("terracotta", {0.45f, 0.19f, 0.10f}, 0.8f);
  m.soil = matte("soil", {0.07f, 0.045f, 0.03f}, 1.0f);
  m.leaf = matte("leaf", {0.09f, 0.21f, 0.05f}, 0.5f);
  // The fountain's water is a surface without a bottom of its own: a sheet.
  m.water = model.material({.name = "water",
                            .base_color = vec3(0.9f, 0.97f, 0.97f),
                            .roughness = 0.0f,
                            .transmission = 1.0f,
                            .ior = 1.33f,
                            .thin_walled = true});
  m.glass = clear("glass", {0.96f, 0.98f, 0.97f}, 1.5f);
  m.mirror = metal("mirror", {0.93f, 0.93f, 0.92f}, 0.02f);
  m.flame = model.material({.name = "flame", .base_color = vec3(0.0f), .emissive = vec3(14.0f, 8.0f, 3.0f)});
  m.cloth = {
      matte("cloth_red", {0.42f, 0.03f, 0.03f}, 0.9f), matte("cloth_green", {0.06f, 0.22f, 0.08f}, 0.9f),
      matte("cloth_blue", {0.05f, 0.10f, 0.33f}, 0.9f), matte("cloth_ochre", {0.50f, 0.30f, 0.06f}, 0.9f)};
  return m;
}

void add_hall(Model& model) {
  const Materials m = make_materials(model);
  add_shell(model, m);
  add_arcades(model, m);
  add_vaults(model, m);
  add_balustrade(model, m);
  add_drapes(model, m);
  add_ornaments(model, m);
  add_furniture(model, m);
  model.camera("nave", {-10.0f, 1.65f, 1.4f}, {4.0f, 2.9f, -0.7f}, 65.0f);
  model.camera("drape", {-2.6f, 1.6f, 1.9f}, {-5.6f, 1.9f, -4.8f}, 65.0f);
  model.camera("aisle", {-12.9f, 1.6f, 6.9f}, {2.0f, 1.9f, 6.3f}, 70.0f);
  model.camera("gallery", {-8.4f, 7.25f, -6.9f}, {2.2f, 6.3f, 4.8f}, 70.0f);
  model.camera("fountain", {3.6f, 1.6f, 2.5f}, {-1.2f, 0.9f, -0.7f}, 65.0f);
}

}  // namespace atrium_parts

namespace {

void layout(Model& model) {
  atrium_parts::add_hall(model);
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(0.36f, -1.0f, 0.3f)),
               .color = vec3(1.0f, 0.93f, 0.82f),
               .intensity = 10.0f});
}

}  // namespace

Scene atrium(const Parameters& parameters) {
  return build("atrium", parameters, uint32_t{1} << 18, layout);
}

}  // namespace hybray::procedural
