// What the glTF loader makes of materials, their extensions and extras, against values worked out by hand.
#include "tests/core/scene/gltf_fixture.h"

#include <cmath>

namespace hybray {
namespace {

using nlohmann::json;

using GltfMaterial = Gltf;

TEST_F(GltfMaterial, MaterialExtensionsAndDefaultsAreRead) {
  json document = sample_document();
  document["materials"][0] = json::parse(R"({"emissiveFactor": [1, 0.5, 0], "extensions": {
    "KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_ior": {"ior": 1.33},
    "KHR_materials_transmission": {"transmissionFactor": 0.9}}, "extras": {"ior": 7}})");
  document["nodes"].push_back({{"mesh", 1}});
  document["meshes"].push_back(document["meshes"][0]);
  document["meshes"][1]["primitives"][0].erase("material");
  document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = load(document);
  ASSERT_EQ(scene.materials.size(), 2u);
  const Material& glass = scene.materials[0];
  EXPECT_EQ(glass.name, "material 0");
  EXPECT_EQ(glass.base_color, vec3(1.0f));
  EXPECT_EQ(glass.metallic, 1.0f);
  EXPECT_EQ(glass.emissive, vec3(4, 2, 0));
  EXPECT_EQ(glass.ior, 1.33f);
  EXPECT_EQ(glass.transmission, 0.9f);
  EXPECT_EQ(scene.objects[1].material, 1u);
  EXPECT_EQ(scene.materials[1].base_color, vec3(1.0f));
  EXPECT_EQ(scene.materials[1].ior, 1.5f);
  EXPECT_EQ(scene.materials[1].transmission, 0.0f);
}

TEST_F(GltfMaterial, AVolumeMakesABodyAndItsColourAtADistanceTheAbsorption) {
  json document = sample_document();
  json& extensions = document["materials"][0]["extensions"];
  extensions["KHR_materials_transmission"] = {{"transmissionFactor", 1.0}};
  EXPECT_TRUE(load(document).materials[0].thin_walled);
  extensions["KHR_materials_volume"] = {{"attenuationColor", {0.5, 1.0, 0.25}}, {"attenuationDistance", 2.0}};
  const Material sheet = load(document).materials[0];
  EXPECT_TRUE(sheet.thin_walled);
  // Half at 2 m: ln 2 / 2 per metre.
  EXPECT_NEAR(sheet.absorption.x, 0.34657359, 1e-7);
  EXPECT_EQ(sheet.absorption.y, 0.0f);
  EXPECT_NEAR(sheet.absorption.z, 0.69314718, 1e-7);
  extensions["KHR_materials_volume"]["thicknessFactor"] = 0.001;
  EXPECT_FALSE(load(document).materials[0].thin_walled);
  extensions["KHR_materials_volume"].erase("attenuationDistance");
  EXPECT_EQ(load(document).materials[0].absorption, vec3(0.0f));
  extensions["KHR_materials_volume"]["attenuationColor"] = {0, 0, 0};
  extensions["KHR_materials_volume"]["attenuationDistance"] = 1.0;
  const Material black = load(document).materials[0];
  EXPECT_TRUE(std::isfinite(black.absorption.x));
  EXPECT_EQ(static_cast<float>(1.0 + std::exp(-black.absorption.x)), 1.0f);
}

TEST_F(GltfMaterial, AMaterialThatDoesNotTransmitInItsFileIsNoSheet) {
  EXPECT_FALSE(load(sample_document()).materials[0].thin_walled);
}

TEST_F(GltfMaterial, ExtrasOfOursWinOverTheExtensionsAndOthersAreLeftAlone) {
  json document = sample_document();
  json& material = document["materials"][0];
  material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1.0}};
  material["extras"] = json::parse(R"({"absorption": "of another program", "hybray": {"outer_ior": 1.33,
    "absorption": [1, 2, 3], "outer_absorption": [4, 5, 6], "thin_walled": false,
    "conductor_eta": [7, 8, 9], "conductor_k": [0.1, 0.2, 0.3]}})");
  const Material m = load(document).materials[0];
  EXPECT_EQ(m.outer_ior, 1.33f);
  EXPECT_EQ(m.absorption, vec3(1, 2, 3));
  EXPECT_EQ(m.outer_absorption, vec3(4, 5, 6));
  EXPECT_FALSE(m.thin_walled);
  EXPECT_EQ(m.conductor_eta, vec3(7, 8, 9));
  EXPECT_EQ(m.conductor_k, vec3(0.1f, 0.2f, 0.3f));
  material["extras"] = "words";
  EXPECT_TRUE(load(document).materials[0].thin_walled);
}

}  // namespace
}  // namespace hybray
