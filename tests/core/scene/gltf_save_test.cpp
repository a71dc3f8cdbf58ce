// Saving a scene as glTF keeps every bit.
#include "tests/core/scene/gltf_fixture.h"

#include <cmath>
#include <filesystem>

namespace hybray {
namespace {

using GltfSave = Gltf;

TEST_F(GltfSave, SavingAndLoadingKeepsEveryBitOfTrianglesAndMaterials) {
  Scene scene;
  scene.name = "saved";
  scene.materials = {
      {.name = "clay", .base_color = vec3(0.1f, 0.2f, 0.3f), .metallic = 0.25f, .roughness = 0.6f},
      {.name = "glow",
       .base_color = vec3(1.0f),
       .metallic = 1.0f,
       .roughness = 0.0f,
       .transmission = 0.9f,
       .ior = 1.3333f,
       .emissive = vec3(17.3f, 0.7f, 1e-3f)},
      {.name = "wine",
       .transmission = 1.0f,
       .ior = 1.345f,
       .outer_ior = 1.51f,
       .absorption = vec3(4.1f, 60.3f, 1e-7f),
       .outer_absorption = vec3(0.1f, 0.0f, 0.3f)},
      {.name = "pane", .transmission = 0.5f, .absorption = vec3(0.3f), .thin_walled = true},
      {.name = "gauze", .thin_walled = true},
      {.name = "frond", .cut_out = CutOut::fern},
      {.name = "gold",
       .metallic = 1.0f,
       .conductor_eta = vec3(0.21f, 0.43f, 1.38f),
       .conductor_k = vec3(3.272f, 2.455f, 1.914f)}};
  Mesh mesh;
  for (int i = 0; i < 30; ++i) {
    const auto f = static_cast<float>(i);
    mesh.positions.emplace_back(std::sin(f * 1.7f), f / 3.0f, std::cos(f * 0.9f) * 1e-3f);
    mesh.normals.push_back(glm::normalize(vec3(std::sin(f), std::cos(f * 2.0f), 0.3f)));
    if (i >= 2) mesh.triangles.emplace_back(i - 2, i - 1, i);
  }
  append_mesh(scene, mesh, mat4(1.0f), 0, "first");
  append_mesh(scene, mesh, mat4(2.0f), 1, "second");
  scene.lights.push_back(
      {"lamp", LightKind::spot, vec3(1, 2, 3), vec3(0, -1, 0), vec3(1, 0.5f, 0.2f), 12.5f, 0.1f, 0.4f, 7.0f});
  scene.cameras.push_back({"eye", vec3(1, 2, 3), vec3(4, 2, -3), vec3(0, 1, 0), 50.0f});
  update_content_hash(scene);

  const auto file = folder_.path() / "saved.glb";
  save_gltf(scene, file);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "saved.glb.part"));
  const Scene again = load_gltf(file);
  EXPECT_EQ(again.positions, scene.positions);
  EXPECT_EQ(again.normals, scene.normals);
  EXPECT_EQ(again.triangles, scene.triangles);
  EXPECT_EQ(again.triangle_material, scene.triangle_material);
  ASSERT_EQ(again.materials.size(), scene.materials.size());
  for (size_t m = 0; m < scene.materials.size(); ++m) {
    SCOPED_TRACE(scene.materials[m].name);
    EXPECT_EQ(again.materials[m].name, scene.materials[m].name);
    EXPECT_EQ(again.materials[m].base_color, scene.materials[m].base_color);
    EXPECT_EQ(again.materials[m].metallic, scene.materials[m].metallic);
    EXPECT_EQ(again.materials[m].roughness, scene.materials[m].roughness);
    EXPECT_EQ(again.materials[m].transmission, scene.materials[m].transmission);
    EXPECT_EQ(again.materials[m].ior, scene.materials[m].ior);
    EXPECT_EQ(again.materials[m].outer_ior, scene.materials[m].outer_ior);
    EXPECT_EQ(again.materials[m].absorption, scene.materials[m].absorption);
    EXPECT_EQ(again.materials[m].outer_absorption, scene.materials[m].outer_absorption);
    EXPECT_EQ(again.materials[m].thin_walled, scene.materials[m].thin_walled);
    EXPECT_EQ(again.materials[m].conductor_eta, scene.materials[m].conductor_eta);
    EXPECT_EQ(again.materials[m].conductor_k, scene.materials[m].conductor_k);
    EXPECT_EQ(again.materials[m].emissive, scene.materials[m].emissive);
    EXPECT_EQ(again.materials[m].cut_out, scene.materials[m].cut_out);
  }
  ASSERT_EQ(again.objects.size(), 2u);
  EXPECT_EQ(again.objects[1].name, "second");
  ASSERT_EQ(again.lights.size(), 1u);
  EXPECT_EQ(again.lights[0].intensity, 12.5f);
  EXPECT_EQ(again.lights[0].range, 7.0f);
  EXPECT_EQ(again.lights[0].outer_cone_angle, 0.4f);
  expect_near(again.lights[0].direction, vec3(0, -1, 0));
  ASSERT_EQ(again.cameras.size(), 1u);
  EXPECT_EQ(again.cameras[0].name, "eye");
  expect_near(again.cameras[0].eye, vec3(1, 2, 3));
  expect_near(glm::normalize(again.cameras[0].target - again.cameras[0].eye), glm::normalize(vec3(3, 0, -6)));
  EXPECT_NEAR(again.cameras[0].vertical_fov, 50.0f, 1e-4f);
}

TEST_F(GltfSave, SavingWhereNothingCanBeWrittenLeavesNothingBehind) {
  const Scene scene = load(sample_document());
  EXPECT_ANY_THROW(save_gltf(scene, folder_.path() / "no_such_folder" / "x.glb"));
}

}  // namespace
}  // namespace hybray
