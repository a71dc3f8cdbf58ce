#include "core/scene/scene.h"

#include "core/base/error.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

// One triangle in the XY plane, facing +Z, with or without normals.
Mesh one_triangle(bool with_normals) {
  Mesh mesh;
  mesh.positions = {vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)};
  if (with_normals) mesh.normals.assign(3, vec3(0, 0, 1));
  mesh.triangles = {uvec3(0, 1, 2)};
  return mesh;
}

Scene empty_scene() {
  Scene scene;
  scene.name = "test";
  scene.materials.resize(2);
  return scene;
}

mat4 scaling(float x, float y, float z) {
  mat4 m(1.0f);
  m[0][0] = x, m[1][1] = y, m[2][2] = z;
  return m;
}

TEST(Scene, ObjectsCoverAllTrianglesInOrder) {
  Scene scene = empty_scene();
  append_mesh(scene, one_triangle(true), mat4(1.0f), 1, "a");
  append_mesh(scene, one_triangle(false), mat4(1.0f), 0, "b");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[1].first_triangle, 1u);
  EXPECT_EQ(scene.triangle_material, (std::vector<uint32_t>{1, 0}));
  EXPECT_EQ(scene.triangles[1], uvec3(3, 4, 5));
  EXPECT_EQ(scene.normals[4], vec3(0, 0, 1));
}

TEST(Scene, NormalsGoByTheInverseTranspose) {
  Scene scene = empty_scene();
  Mesh mesh = one_triangle(true);
  mesh.normals.assign(3, glm::normalize(vec3(1, 1, 0)));
  append_mesh(scene, mesh, scaling(2, 1, 1), 0, "a");
  // The plane x + y = c becomes x / 2 + y = c, whose normal is (1, 2, 0) / sqrt(5).
  EXPECT_NEAR(scene.normals[0].x, 1.0 / std::sqrt(5.0), 1e-7);
  EXPECT_NEAR(scene.normals[0].y, 2.0 / std::sqrt(5.0), 1e-7);
}

TEST(Scene, MirroringFlipsTheWindingSoThatTheFrontStaysInFront) {
  for (const bool with_normals : {true, false}) {
    Scene scene = empty_scene();
    append_mesh(scene, one_triangle(with_normals), scaling(1, -1, 1), 0, "a");
    EXPECT_EQ(vec3(geometric_normal(scene, 0)), vec3(0, 0, 1));
    EXPECT_EQ(scene.normals[0], vec3(0, 0, 1));
  }
  Scene scene = empty_scene();
  append_mesh(scene, one_triangle(false), scaling(1, 1, -1), 0, "a");
  EXPECT_EQ(vec3(geometric_normal(scene, 0)), vec3(0, 0, -1));
  EXPECT_EQ(scene.normals[0], vec3(0, 0, -1));
}

TEST(Scene, TheIdentityKeepsEveryBitOfANormal) {
  Scene scene = empty_scene();
  Mesh mesh = one_triangle(true);
  mesh.normals.assign(3, vec3(0.6000001f, 0.8f, 0.0f));
  append_mesh(scene, mesh, mat4(1.0f), 0, "a");
  EXPECT_EQ(scene.normals, mesh.normals);
}

TEST(Scene, AnObjectComesBackAsTheMeshThatItWas) {
  Scene scene = empty_scene();
  append_mesh(scene, one_triangle(true), mat4(1.0f), 0, "a");
  append_mesh(scene, one_triangle(true), scaling(3, 3, 3), 1, "b");
  const Mesh mesh = object_mesh(scene, scene.objects[1]);
  EXPECT_EQ(mesh.triangles, one_triangle(true).triangles);
  EXPECT_EQ(mesh.positions[1], vec3(3, 0, 0));
  EXPECT_EQ(mesh.positions.size(), 3u);
}

TEST(Scene, TheContentHashChangesWithEveryPartThatMatters) {
  Scene scene = empty_scene();
  append_mesh(scene, one_triangle(true), mat4(1.0f), 0, "a");
  scene.lights.emplace_back();
  scene.cameras.emplace_back();
  update_content_hash(scene);
  const uint64_t hash = scene.content_hash;
  const auto changed = [&](auto&& change) {
    Scene other = scene;
    change(other);
    update_content_hash(other);
    return other.content_hash != hash;
  };
  EXPECT_FALSE(changed([](Scene&) {}));
  EXPECT_TRUE(changed([](Scene& s) { s.positions[0].x = 1e-30f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.normals[0].x = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { std::swap(s.triangles[0].x, s.triangles[0].y); }));
  EXPECT_TRUE(changed([](Scene& s) { s.triangle_material[0] = 1; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].ior = 1.6f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].outer_ior = 1.6f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].absorption.y = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].outer_absorption.z = 0.1f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].thin_walled = true; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].conductor_eta.x = 0.2f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[1].conductor_k.x = 0.2f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.materials[0].cut_out = CutOut::leaf; }));
  EXPECT_TRUE(changed([](Scene& s) { s.lights[0].intensity = 2.0f; }));
  EXPECT_TRUE(changed([](Scene& s) { s.cameras[0].vertical_fov = 61.0f; }));
}

TEST(Scene, AnUnknownCameraIsAnErrorThatNamesTheCameras) {
  Scene scene = empty_scene();
  scene.cameras.emplace_back().name = "nave";
  scene.cameras.emplace_back().name = "aisle";
  EXPECT_EQ(find_camera(scene, "aisle").name, "aisle");
  try {
    find_camera(scene, "isle");
    FAIL() << "found a camera that is not there";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nave, aisle"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hybray
