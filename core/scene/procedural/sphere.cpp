// The simplest scene: a tessellated sphere on a low plinth in a walled court, about 1,000 triangles.
#include "core/scene/procedural/model.h"
#include "core/scene/procedural/shapes.h"

namespace hybray::procedural {
namespace {

constexpr double kHalf = 4.0;    // half of the court's inner side
constexpr double kHeight = 3.2;  // of its walls
constexpr double kPlinthTop = 0.35;
constexpr double kRadius = 1.0;

void court(Model& model) {
  const uint32_t stone =
      model.material({.name = "floor", .base_color = vec3(0.50f, 0.46f, 0.40f), .roughness = 0.3f});
  const uint32_t slate =
      model.material({.name = "floor_dark", .base_color = vec3(0.16f, 0.17f, 0.19f), .roughness = 0.2f});
  const std::array<uint32_t, 4> plaster{
      model.material({.name = "wall_left", .base_color = vec3(0.62f, 0.16f, 0.11f)}),
      model.material({.name = "wall_right", .base_color = vec3(0.16f, 0.36f, 0.55f)}),
      model.material({.name = "wall_back", .base_color = vec3(0.72f, 0.66f, 0.55f)}),
      model.material({.name = "wall_front", .base_color = vec3(0.35f, 0.48f, 0.28f)})};

  // A chequered floor that reaches a little into the walls, or one quad when there is little to spend.
  const double reach = kHalf + 0.05;
  const int cells = model.lod(key("floor")).wants(0.5) ? 6 : 1;
  MeshBuilder light = model.part(), dark = model.part();
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const auto line = [&](int k) { return -reach + 2.0 * reach * k / cells; };
      ((i + j) % 2 ? dark : light)
          .quad({line(i), 0, line(j + 1)}, {line(i + 1), 0, line(j + 1)}, {line(i + 1), 0, line(j)},
                {line(i), 0, line(j)});
    }
  model.add(std::move(light), stone, "floor");
  model.add(std::move(dark), slate, "floor_dark");

  // Walls 0.3 m thick; each runs past the corner to the left of it and ends at the one to the right. Strips
  // across their faces take up the triangles that the sphere's tessellation leaves over.
  for (int i = 0; i < 4; ++i) {
    const Lod lod = model.lod(key("wall", i));
    MeshBuilder part = model.part();
    part.box({-kHalf - 0.3, -0.05, -kHalf - 0.3}, {kHalf, kHeight, -kHalf}, kAllFaces & ~kFront & ~kRight);
    const int strips = lod.filling(0.5) + 1;
    part.surface(strips, 1, {}, [&](double u, double v) {
      return dvec3(-kHalf - 0.3 + (2.0 * kHalf + 0.3) * u, -0.05 + (kHeight + 0.05) * v, -kHalf);
    });
    model.add(std::move(part), plaster[static_cast<size_t>(i)], "wall", turned(0.5 * kPi * i));
  }
}

void objects(Model& model) {
  const uint32_t plinth =
      model.material({.name = "plinth", .base_color = vec3(0.55f, 0.53f, 0.5f), .roughness = 0.5f});
  const uint32_t paint = model.material(
      {.name = "sphere", .base_color = vec3(0.78f, 0.62f, 0.32f), .metallic = 1.0f, .roughness = 0.1f});
  const uint32_t wood =
      model.material({.name = "block", .base_color = vec3(0.42f, 0.24f, 0.11f), .roughness = 0.6f});

  MeshBuilder base = model.part();
  const int sides = model.lod(key("plinth")).even_segments(24, 6);
  lathe(base, {{1.1, -0.02}, {1.1, kPlinthTop}}, sides);
  lathe(base, {{1.1, kPlinthTop}, {0.0, kPlinthTop}}, sides);
  model.add(std::move(base), plinth, "plinth");

  MeshBuilder sphere_part = model.part();
  const Lod lod = model.lod(key("sphere"));
  const int rings = lod.segments(16, 4);
  ball(sphere_part, {0, kPlinthTop + kRadius - 0.015, 0}, kRadius, lod.even_segments(28, 6), rings);
  model.add(std::move(sphere_part), paint, "sphere");

  MeshBuilder block = model.part();
  block.box({-0.35, -0.02, -0.35}, {0.35, 0.8, 0.35}, kAllFaces & ~kBottom);
  model.add(std::move(block), wood, "block", moved({2.3, 0, -1.9}) * turned(0.5));
  MeshBuilder slab = model.part();
  slab.box({-0.9, -0.02, -0.25}, {0.9, 0.45, 0.25}, kAllFaces & ~kBottom);
  model.add(std::move(slab), wood, "bench", moved({-2.9, 0, 0.9}) * turned(1.4));
}

void layout(Model& model) {
  court(model);
  objects(model);
  model.light({.name = "sun",
               .kind = LightKind::directional,
               .direction = glm::normalize(vec3(0.45f, -1.0f, -0.35f)),
               .color = vec3(1.0f, 0.95f, 0.86f),
               .intensity = 6.0f});
  model.light({.name = "lamp",
               .position = vec3(-2.5f, 2.6f, -2.5f),
               .color = vec3(1.0f, 0.8f, 0.55f),
               .intensity = 3.0f});
  model.light({.name = "lamp_2",
               .position = vec3(2.8f, 2.6f, 2.6f),
               .color = vec3(1.0f, 0.8f, 0.55f),
               .intensity = 3.0f});
  model.camera("front", {0.4f, 1.6f, 3.5f}, {0.0f, 1.15f, 0.0f}, 65.0f);
  model.camera("corner", {-3.3f, 1.7f, 3.2f}, {0.6f, 0.8f, -0.8f}, 65.0f);
  model.camera("side", {3.4f, 1.6f, 0.9f}, {-0.6f, 1.0f, -0.5f}, 70.0f);
  model.camera("low", {-1.9f, 1.0f, 1.6f}, {1.2f, 0.9f, -1.4f}, 70.0f);
}

}  // namespace

Scene sphere(const Parameters& parameters) {
  return build("sphere", parameters, uint32_t{1} << 10, layout);
}

}  // namespace hybray::procedural
