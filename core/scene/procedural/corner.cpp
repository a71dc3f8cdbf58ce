#include "core/scene/procedural/corner.h"

#include "core/scene/procedural/mesh_builder.h"

namespace hybray::procedural {
namespace {

uint32_t paint(Scene& scene, const char* name, const vec3& color) {
  scene.materials.push_back({.name = name, .base_color = color, .roughness = 0.4f});
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

void add(Scene& scene, MeshBuilder& part, uint32_t material, const char* name) {
  append_mesh(scene, part.take(), mat4(1.0f), material, name);
}

}  // namespace

Scene corner() {
  Scene scene;
  scene.name = "corner";
  const uint32_t stone = paint(scene, "stone", vec3(0.5f, 0.47f, 0.42f));
  const uint32_t plaster = paint(scene, "plaster", vec3(0.65f, 0.6f, 0.5f));
  const uint32_t brick = paint(scene, "brick", vec3(0.5f, 0.2f, 0.13f));

  MeshBuilder floor, walls, blocks;
  floor.quad({-12, 0, 12}, {12, 0, 12}, {12, 0, -6}, {-12, 0, -6});
  walls.quad({-12, 0, -6}, {12, 0, -6}, {12, 5, -6}, {-12, 5, -6});
  walls.quad({-6, 0, 12}, {-6, 0, -6}, {-6, 5, -6}, {-6, 5, 12});
  constexpr unsigned kSeen = kAllFaces & ~kBottom;
  blocks.box({1.2, 0, -4.5}, {3.1, 1.7, -2.9}, kSeen);
  blocks.box({-3.4, 0, -3.6}, {-2.0, 0.6, -1.1}, kSeen);
  blocks.box({-1.1, 0, -5.2}, {0.2, 3.0, -4.4}, kSeen);
  add(scene, floor, stone, "floor");
  add(scene, walls, plaster, "walls");
  add(scene, blocks, brick, "blocks");

  scene.lights.push_back({.name = "lamp", .position = vec3(2.0f, 4.0f, 2.0f), .intensity = 60.0f});
  scene.cameras.push_back({"floor", vec3(0.0f, 2.5f, 3.0f), vec3(0.0f, 0.0f, 0.0f), vec3(0, 1, 0), 60.0f});
  scene.cameras.push_back({"wall", vec3(-3.0f, 1.6f, 5.0f), vec3(0.5f, 1.2f, -5.0f), vec3(0, 1, 0), 70.0f});
  return scene;
}

}  // namespace hybray::procedural
