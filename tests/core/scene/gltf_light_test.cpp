// What the glTF loader makes of lights and cameras, against values worked out by hand.
#include "tests/core/scene/gltf_fixture.h"

namespace hybray {
namespace {

using nlohmann::json;

using GltfLight = Gltf;
using GltfCamera = Gltf;

TEST_F(GltfLight, LightsShineAlongTheNodesMinusZ) {
  json document = sample_document();
  document["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
    {"type": "directional", "intensity": 3, "color": [1, 0.5, 0.25]},
    {"type": "spot", "name": "lamp", "range": 9, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}])");
  // A quarter turn about X takes -Z to +Y.
  document["nodes"].push_back(json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}},
    "rotation": [0.70710678118654752, 0, 0, 0.70710678118654752], "scale": [3, 3, 3]})"));
  document["nodes"].push_back(
      json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [1, 2, 3]})"));
  document["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = load(document);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
  expect_near(scene.lights[0].direction, vec3(0, 1, 0));
  EXPECT_EQ(scene.lights[0].intensity, 3.0f);
  EXPECT_EQ(scene.lights[0].color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(scene.lights[1].kind, LightKind::spot);
  EXPECT_EQ(scene.lights[1].name, "lamp");
  EXPECT_EQ(scene.lights[1].position, vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[1].direction, vec3(0, 0, -1));
  EXPECT_EQ(scene.lights[1].range, 9.0f);
  EXPECT_EQ(scene.lights[1].inner_cone_angle, 0.25f);
  EXPECT_EQ(scene.lights[1].outer_cone_angle, 0.5f);
}

TEST_F(GltfCamera, PerspectiveCamerasLookAlongTheNodesMinusZ) {
  json document = sample_document();
  document["cameras"] =
      json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1.0471975511965976, "znear": 0.1}},
    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}}])");
  // A quarter turn about Y takes -Z to -X.
  document["nodes"].push_back(json::parse(R"({"camera": 0, "name": "main", "translation": [0, 1, 0],
    "rotation": [0, 0.70710678118654752, 0, 0.70710678118654752]})"));
  document["nodes"].push_back(json::parse(R"({"camera": 0, "name": "main"})"));
  document["nodes"].push_back(json::parse(R"({"camera": 1, "name": "plan"})"));
  document["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Scene scene = load(document);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[1].name, "main 2");
  const Camera& camera = find_camera(scene, "main");
  EXPECT_NEAR(camera.vertical_fov, 60.0f, 1e-5f);
  expect_near(camera.eye, vec3(0, 1, 0));
  expect_near(glm::normalize(camera.target - camera.eye), vec3(-1, 0, 0));
  expect_near(camera.up, vec3(0, 1, 0));
}

}  // namespace
}  // namespace hybray
