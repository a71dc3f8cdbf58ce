// Bodies that close and bodies that do not, made by hand from the shapes of overlays.
#include "core/scene/closed_bodies.h"

#include "core/base/error.h"
#include "core/optics/surface_optics.h"
#include "core/scene/analytic_surface.h"
#include "core/scene/procedural/generators.h"
#include "core/scene/shapes.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace hybray {
namespace {

Material glass(float ior = 1.5f, float outer_ior = 1.0f) {
  return {.name = "glass", .roughness = 0.0f, .transmission = 1.0f, .ior = ior, .outer_ior = outer_ior};
}

mat4 placed(const vec3& at, float size = 1.0f) {
  return glm::scale(glm::translate(mat4(1.0f), at), vec3(size));
}

Mesh turned_inward(Mesh mesh) {
  for (uvec3& tri : mesh.triangles) std::swap(tri.y, tri.z);
  for (vec3& n : mesh.normals) n = -n;
  return mesh;
}

Scene scene_of(const Mesh& mesh, const Material& material) {
  Scene scene;
  scene.name = "test";
  scene.materials = {material};
  append_mesh(scene, mesh, mat4(1.0f), 0, "thing");
  return scene;
}

// A ring of `count` points of radius `r` at height y, as a disc about its centre facing up or down.
Mesh disc(int count, float r, float y, bool up) {
  Mesh mesh;
  mesh.positions.emplace_back(0, y, 0);
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * 3.141592653589793 * i / count;
    mesh.positions.emplace_back(r * std::cos(a), y, -r * std::sin(a));
  }
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<uint32_t>(1 + i), b = static_cast<uint32_t>(1 + (i + 1) % count);
    mesh.triangles.push_back(up ? uvec3(0, a, b) : uvec3(0, b, a));
  }
  return mesh;
}

// A dome of `count` sides from the rim at radius 1, y = 0 to its top (or bottom) at y = height, facing out.
Mesh cone(int count, float height) {
  Mesh mesh = disc(count, 1.0f, 0.0f, height > 0.0f);
  mesh.positions[0].y = height;
  return mesh;
}

TEST(ClosedBodies, TheSmoothnessIsThatOfTheOptics) {
  Material m = glass();
  m.roughness = std::nextafter(optics::kSmoothRoughness, 0.0f);
  EXPECT_EQ(find_body_faults(scene_of(make_shape("plane", 1), m)).size(), 1u);
  m.roughness = optics::kSmoothRoughness;
  EXPECT_TRUE(find_body_faults(scene_of(make_shape("plane", 1), m)).empty());
}

TEST(ClosedBodies, ShapesOfOverlaysCloseAtAnyTessellation) {
  for (const int count : {3, 4, 5, 7, 12, 37, 64, 100, 129, 160})
    for (const char* shape : {"sphere", "cylinder", "box"}) {
      SCOPED_TRACE(std::string(shape) + " " + std::to_string(count));
      Scene scene = scene_of(make_shape(shape, count), glass());
      append_mesh(scene, make_shape(shape, count), placed(vec3(3.3f, 0.7f, -11.1f), 0.37f), 0, "moved");
      EXPECT_TRUE(find_body_faults(scene).empty());
      EXPECT_NO_THROW(check_closed_bodies(scene));
    }
}

TEST(ClosedBodies, ASheetIsOpenAtItsFourEdgesAndTheErrorSaysWhere) {
  const Scene scene = scene_of(make_shape("plane", 3), glass());
  const auto faults = find_body_faults(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].object, "thing");
  EXPECT_EQ(faults[0].material, "glass");
  EXPECT_EQ(faults[0].open_edges, 12u);
  EXPECT_NEAR(std::max(std::abs(faults[0].place.x), std::abs(faults[0].place.z)), 0.5f, 1e-6f);
  try {
    check_closed_bodies(scene);
    FAIL() << "an open sheet passed";
  } catch (const InputError& error) {
    const std::string what = error.what();
    for (const char* part :
         {"scene test", "'thing'", "'glass'", "1.5", "12 edges", "thin_walled", "close it"})
      EXPECT_NE(what.find(part), what.npos) << part << " is not in: " << what;
  }
}

TEST(ClosedBodies, WhatIsNoBodyNeedNotClose) {
  Material thin = glass(), rough = glass(), metal = glass(), opaque = glass();
  thin.thin_walled = true;
  rough.roughness = 0.5f;
  metal.metallic = 1.0f;
  opaque.transmission = 0.0f;
  for (const Material& m : {thin, rough, metal, opaque})
    EXPECT_TRUE(find_body_faults(scene_of(make_shape("plane", 3), m)).empty());
}

TEST(ClosedBodies, AMissingTriangleIsFoundHoweverManyThereAre) {
  Mesh mesh = make_shape("sphere", 200);
  mesh.triangles.erase(mesh.triangles.begin() + 7777);
  const auto faults = find_body_faults(scene_of(mesh, glass()));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].open_edges, 3u);
  EXPECT_NEAR(glm::length(faults[0].place), 1.0f, 1e-2f);
}

TEST(ClosedBodies, ATriangleThatIsTurnedRoundIsFound) {
  Mesh mesh = make_shape("sphere", 24);
  std::swap(mesh.triangles[100].x, mesh.triangles[100].y);
  const auto faults = find_body_faults(scene_of(mesh, glass()));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].open_edges, 6u);  // each of its three edges runs twice the same way
}

TEST(ClosedBodies, ABodyWhoseFacesPointInwardIsFoundAndABubbleIsNone) {
  const Mesh ball = make_shape("sphere", 24);
  Scene scene = scene_of(ball, glass());
  append_mesh(scene, turned_inward(ball), placed(vec3(5, 0, 0)), 0, "inverted");
  const auto faults = find_body_faults(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].object, "inverted");
  EXPECT_EQ(faults[0].open_edges, 0u);
  EXPECT_THROW(check_closed_bodies(scene), InputError);

  Scene hollow = scene_of(ball, glass());
  append_mesh(hollow, turned_inward(ball), placed(vec3(0.1f, 0, 0), 0.5f), 0, "hollow");
  EXPECT_TRUE(find_body_faults(hollow).empty());
  // The same bubble, told from its own side: air inside, glass outside.
  Scene bubble = scene_of(ball, glass());
  bubble.materials.push_back(glass(1.0f, 1.5f));
  append_mesh(bubble, ball, placed(vec3(0.1f, 0, 0), 0.5f), 1, "bubble");
  EXPECT_TRUE(find_body_faults(bubble).empty());
}

// A cup of water: the glass' outer cone below, the border of glass and water above it, and the water's top.
Scene cup(const Material& border, bool border_faces_water) {
  Scene scene;
  scene.materials = {glass(1.5f), glass(1.33f), border};
  append_mesh(scene, cone(16, -1.0f), mat4(1.0f), 0, "glass_air");
  append_mesh(scene, disc(16, 1.0f, 0.0f, true), mat4(1.0f), 1, "water_air");
  const Mesh inside = cone(16, -0.7f);
  append_mesh(scene, border_faces_water ? turned_inward(inside) : inside, mat4(1.0f), 2, "border");
  return scene;
}

TEST(ClosedBodies, ThreeKindsOfInterfacesMayMeetAlongALine) {
  EXPECT_TRUE(find_body_faults(cup(glass(1.5f, 1.33f), true)).empty());
  EXPECT_TRUE(find_body_faults(cup(glass(1.33f, 1.5f), false)).empty());  // told from the other side
}

TEST(ClosedBodies, AWrongMediumOnOneSideLeavesTwoMediaOpen) {
  // The border to air instead of water: glass closes, water does not.
  const auto faults = find_body_faults(cup(glass(1.5f, 1.0f), true));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].object, "water_air");
  EXPECT_EQ(faults[0].open_edges, 16u);
  EXPECT_FALSE(find_body_faults(cup(glass(1.33f, 1.5f), true)).empty());  // faces the wrong way
  Material colored = glass(1.5f, 1.33f);
  colored.outer_absorption = vec3(1.0f);  // absorbs as the water above does not: another medium
  EXPECT_FALSE(find_body_faults(cup(colored, true)).empty());
}

TEST(ClosedBodies, OpaqueGroundBoundsTheMediumThatLiesBeforeIt) {
  Scene pool;
  pool.materials = {glass(1.33f), {.name = "tiles", .outer_ior = 1.33f}};
  append_mesh(pool, disc(16, 1.0f, 0.0f, true), mat4(1.0f), 0, "water");
  append_mesh(pool, turned_inward(cone(16, -0.7f)), mat4(1.0f), 1, "basin");
  EXPECT_TRUE(find_body_faults(pool).empty());
  pool.materials[1].outer_ior = 1.0f;
  EXPECT_EQ(find_body_faults(pool).size(), 1u);
}

TEST(ClosedBodies, ACrackBetweenTwoTessellationsOfOneCurveIsForgivenAndAGapIsNot) {
  const auto body = [](float radius) {
    Scene scene;
    scene.materials = {glass()};
    append_mesh(scene, cone(64, 1.0f), mat4(1.0f), 0, "upper");
    append_mesh(scene, disc(128, radius, 0.0f, false), mat4(1.0f), 0, "lower");
    return scene;
  };
  // The two rims part by 1 - cos(pi / 64) = 0.0012 where edges are 0.098 and 0.049 long.
  EXPECT_TRUE(find_body_faults(body(1.0f)).empty());
  const auto faults = find_body_faults(body(0.99f));
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].open_edges + faults[1].open_edges, 64u + 128u);
}

TEST(ClosedBodies, PositiveAndNegativeZeroAreOnePlace) {
  Mesh mesh = make_shape("box", 1);
  for (vec3& p : mesh.positions) p = p + vec3(0.5f);  // corners at 0 and 1
  for (uint32_t i = 0; i < mesh.positions.size(); i += 2)
    for (int k = 0; k < 3; ++k)
      if (mesh.positions[i][k] == 0.0f) mesh.positions[i][k] = -0.0f;
  EXPECT_TRUE(find_body_faults(scene_of(mesh, glass())).empty());
}

TEST(ClosedBodies, AnAnalyticSphereClosesAndACylinderWithoutEndsDoesNot) {
  Scene scene = scene_of(make_shape("plane", 1), Material{});
  scene.materials.push_back(glass());
  append_analytic(scene, analytic_sphere("ball", 1, dvec3(0, 2, 0), 1.0));
  EXPECT_TRUE(find_body_faults(scene).empty());
  append_analytic(scene, analytic_cylinder("tube", 1, dvec3(5, 0, 0), 1.0, 0.0, 1.0));
  const auto faults = find_body_faults(scene);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].object, "tube");
}

TEST(ClosedBodies, EveryProceduralSceneClosesItsBodiesAtAnyTessellation) {
  for (const procedural::Generator& generator : procedural::generators())
    for (const uint32_t count : {0u, 1u << 13, 60000u}) {
      // The closed forms are exact, at their own number of triangles alone.
      if (count != 0 && std::string(generator.name).starts_with("closed_")) continue;
      if (generator.exact && count != 0) continue;  // has one tessellation
      SCOPED_TRACE(std::string(generator.name) + " " + std::to_string(count));
      EXPECT_NO_THROW(check_closed_bodies(generator.generate({count, 1})));
    }
}

}  // namespace
}  // namespace hybray
