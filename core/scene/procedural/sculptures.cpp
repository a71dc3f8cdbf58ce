// A court with sculptures given by distance fields: rings, gyroids and melted balls on plinths. A ray walks
// step by step along each body that it comes near.
#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

#include <array>

namespace hybray::procedural {
namespace {

using Shape = DistanceField::Shape;
constexpr double kHalf = 7.0, kWall = 3.2, kPlinth = 0.7;

struct Materials {
  uint32_t floor, wall, plinth, bronze, marble, clay;
};

Materials make_materials(Model& model) {
  const auto plain = [&](const char* name, const vec3& color, float roughness, float metallic) {
    return model.material({.name = name, .base_color = color, .metallic = metallic, .roughness = roughness});
  };
  return {
      plain("floor", {0.40f, 0.38f, 0.35f}, 0.3f, 0.0f),  plain("wall", {0.62f, 0.58f, 0.50f}, 0.9f, 0.0f),
      plain("plinth", {0.55f, 0.55f, 0.53f}, 0.6f, 0.0f), plain("bronze", {0.70f, 0.45f, 0.25f}, 0.3f, 1.0f),
      plain("marble", {0.80f, 0.78f, 0.74f}, 0.3f, 0.0f), plain("clay", {0.55f, 0.28f, 0.18f}, 0.6f, 0.0f)};
}

dvec3 tilted(double yaw, double tilt) {
  return {std::sin(tilt) * std::cos(yaw), std::cos(tilt), std::sin(tilt) * std::sin(yaw)};
}

// One piece about `at`, the middle of its plinth's top.
void add_sculpture(Model& model, const Materials& m, const dvec3& at, int number) {
  Dice dice = model.dice(key("sculpture", static_cast<uint64_t>(number)));
  const auto add = [&](const char* name, uint32_t material, const dvec3& center, const DistanceField& field) {
    model.surface(analytic_field(name, material, center, field));
  };
  switch (number % 3) {
    case 0: {  // three rings, each through the next
      double yaw = dice(0.0, kPi);
      for (int i = 0; i < 3; ++i) {
        add("ring", m.bronze, at + dvec3(0, 0.36 + 0.38 * i, 0),
            {.shape = Shape::torus,
             .radius = 0.27,
             .thickness = dice(0.05, 0.08),
             .axis = tilted(yaw, kPi / 2)});
        yaw += kPi / 2 + dice(-0.3, 0.3);
      }
      break;
    }
    case 1:
      add("gyroid", m.marble, at + dvec3(0, 0.46, 0),
          {.shape = Shape::gyroid,
           .radius = 0.46,
           .thickness = dice(0.25, 0.45),
           .period = dice(0.30, 0.42)});
      break;
    default:
      add("figure", m.clay, at + dvec3(0, 0.62, 0),
          {.shape = Shape::blob, .radius = 0.62, .thickness = dice(0.10, 0.28)});
  }
}

void add_court(Model& model, const Materials& m) {
  MeshBuilder floor = model.part(), walls = model.part();
  const int cells = model.lod(key("floor")).segments(48, 2);
  floor.surface(cells, cells, {}, [](double u, double v) {
    return dvec3(kHalf * (2.0 * u - 1.0), 0.0, kHalf * (1.0 - 2.0 * v));
  });
  model.add(std::move(floor), m.floor, "floor");
  for (int side = 0; side < 4; ++side) {
    walls.set_frame(turned(0.5 * kPi * side));
    walls.quad({-kHalf, 0, -kHalf}, {kHalf, 0, -kHalf}, {kHalf, kWall, -kHalf}, {-kHalf, kWall, -kHalf});
  }
  model.add(std::move(walls), m.wall, "walls");
}

void layout(Model& model) {
  const Materials m = make_materials(model);
  add_court(model, m);
  const int sides = model.lod(key("plinth")).even_segments(56, 6);
  int number = 0;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column, ++number) {
      const dvec3 at(-4.5 + 3.0 * column + (row % 2 ? 0.5 : 0.0), 0.0, -4.6 + 2.9 * row);
      MeshBuilder plinth = model.part();
      lathe_pieces(plinth,
                   {{{0.48, 0.0}, {0.48, 0.08}},
                    {{0.48, 0.08}, {0.40, 0.12}, {0.38, 0.2}, {0.38, kPlinth - 0.1}, {0.42, kPlinth - 0.05}},
                    {{0.42, kPlinth - 0.05}, {0.42, kPlinth}},
                    {{0.42, kPlinth}, {0.0, kPlinth}}},
                   sides);
      model.add(std::move(plinth), m.plinth, "plinth", moved(at));
      add_sculpture(model, m, at + dvec3(0, kPlinth, 0), number);
    }
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(0.5f, -1.0f, -0.6f)),
               .color = vec3(1.0f, 0.96f, 0.88f),
               .intensity = 7.0f});
  model.camera("court", {-0.9f, 1.65f, 6.4f}, {0.2f, 0.9f, 0.0f}, 60.0f);
  model.camera("rings", {-2.6f, 1.4f, -2.9f}, {-4.4f, 1.25f, -4.6f}, 60.0f);
  model.camera("gyroid", {0.1f, 1.35f, -3.2f}, {-1.5f, 1.15f, -4.6f}, 60.0f);
  model.camera("figure", {2.9f, 1.5f, -3.0f}, {1.5f, 1.2f, -4.6f}, 60.0f);
}

}  // namespace

Scene sculptures(const Parameters& parameters) {
  return build("sculptures", parameters, uint32_t{1} << 14, layout);
}

}  // namespace hybray::procedural
