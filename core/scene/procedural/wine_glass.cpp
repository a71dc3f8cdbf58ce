// A glass of red wine on a table. Three kinds of interfaces meet along the rim of the wine: glass and air,
// wine and air, glass and wine.
#include "core/scene/procedural/caustic_stage.h"

namespace hybray::procedural {
namespace {

constexpr float kWineIndex = 1.345f;
const vec3 kWineAbsorption(4.0f, 60.0f, 50.0f);  // 1/m: a finger's breadth is red, the whole glass dark

struct Interfaces {
  uint32_t glass_air, wine_air, glass_wine;
};

// Normals point to the outer medium: out of the glass, out of the wine's surface, and from the glass into the
// wine.
Interfaces make_materials(Model& model) {
  Material glass = caustic_stage::clear_glass();
  Interfaces result{};
  glass.name = "glass_air";
  result.glass_air = model.material(glass);
  glass.name = "glass_wine";
  glass.outer_ior = kWineIndex;
  glass.outer_absorption = kWineAbsorption;
  result.glass_wine = model.material(glass);
  result.wine_air = model.material({.name = "wine_air",
                                    .base_color = vec3(1.0f),
                                    .roughness = 0.0f,
                                    .transmission = 1.0f,
                                    .ior = kWineIndex,
                                    .absorption = kWineAbsorption});
  return result;
}

void add_glass(Model& model, const dvec3& foot) {
  const Interfaces m = make_materials(model);
  const Lod lod = model.lod(key("glass"));
  const int sides = lod.segments(160.0, 10);
  // Metres: (radius, height). From below the foot, up the stem, around the bowl to the rim.
  const Curve2 outside = {{0.0, 0.0022},  {0.018, 0.0015}, {0.033, 0.0006}, {0.0362, 0.0012}, {0.034, 0.003},
                          {0.016, 0.006}, {0.006, 0.013},  {0.0041, 0.03},  {0.004, 0.06},    {0.0046, 0.08},
                          {0.0075, 0.09}, {0.02, 0.1005},  {0.033, 0.119},  {0.039, 0.143},   {0.0378, 0.17},
                          {0.0335, 0.2},  {0.0305, 0.218}};
  // From the rim down the inner wall; the wine stands at the fifth of these.
  const Curve2 inside = {{0.0305, 0.218}, {0.0302, 0.2192}, {0.0296, 0.2188}, {0.0293, 0.2175},
                         {0.0322, 0.2},   {0.0375, 0.147},  {0.0317, 0.12},   {0.0188, 0.1025},
                         {0.008, 0.096},  {0.0, 0.0945}};
  constexpr int kWineLine = 5;
  const int span = lod.segments(5.0, 1);
  const Curve2 outer = smooth(outside, lod.segments(90.0, 16));
  const Curve2 inner = smooth(inside, span * (static_cast<int>(inside.size()) - 1));
  const auto wine_line = inner.begin() + span * kWineLine;

  MeshBuilder glass = model.part(), border = model.part(), surface = model.part();
  for (MeshBuilder* part : {&glass, &border, &surface}) part->set_frame(moved(foot));
  Curve2 in_air = outer;
  in_air.insert(in_air.end(), inner.begin() + 1, wine_line + 1);
  lathe(glass, in_air, sides);
  lathe(border, Curve2(wine_line, inner.end()), sides);
  const int rings = lod.segments(6.0, 1);
  Curve2 level;
  for (int i = 0; i <= rings; ++i) level.emplace_back(wine_line->x * (rings - i) / rings, wine_line->y);
  lathe(surface, level, sides);
  model.add(std::move(glass), m.glass_air, "glass");
  model.add(std::move(border), m.glass_wine, "glass_wine_border");
  model.add(std::move(surface), m.wine_air, "wine_surface");
}

void layout(Model& model) {
  using namespace caustic_stage;
  add_room(model, {0.6, 0.45, 0.5, vec3(0.72f, 0.7f, 0.66f), vec3(0.55f, 0.57f, 0.6f)});
  add_glass(model, {0.0, 0.0002, 0.0});
  const vec3 lamp(-0.27f, 0.5f, -0.2f), aim(0.03f, 0.1f, 0.02f);
  model.light({.name = "lamp",
               .kind = LightKind::spot,
               .position = lamp,
               .direction = glm::normalize(aim - lamp),
               .intensity = 1.6f,
               .inner_cone_angle = 0.35f,
               .outer_cone_angle = 0.6f});
  model.light({.name = "fill", .position = vec3(0.35f, 0.6f, 0.4f), .intensity = 0.1f});
  model.camera("front", {0.05f, 0.34f, 0.52f}, {0.06f, 0.065f, 0.03f}, 38.0f);
  model.camera("caustic", {0.1f, 0.3f, 0.42f}, {0.11f, 0.0f, 0.09f}, 36.0f);
  model.camera("close", {0.02f, 0.2f, 0.28f}, {0.0f, 0.13f, 0.0f}, 40.0f);
}

}  // namespace

Scene wine_glass(const Parameters& parameters) {
  return build("wine_glass", parameters, uint32_t{3} << 14, layout);
}

}  // namespace hybray::procedural
