// What the glTF loader makes of valid files, against values worked out by hand; and that saving keeps every
// bit.
#include "core/scene/gltf.h"

#include "tests/core/scene/gltf_sample.h"
#include "tests/temporary_folder.h"

#include <cmath>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using nlohmann::json;

class Gltf : public ::testing::Test {
 protected:
  Scene load(const json& document, const std::string& buffer = sample_buffer()) {
    folder_.write("data.bin", buffer);
    return load_gltf(folder_.write("x.gltf", document.dump()));
  }

  test::TemporaryFolder folder_;
};

void expect_near(const vec3& found, const vec3& expected, float tolerance = 1e-6f) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << "component " << c;
}

// The document with its buffer replaced by other positions and no indices, `mode` as given.
json with_vertices(json document, size_t count, int mode) {
  document["buffers"][0]["byteLength"] = 12 * count;
  document["bufferViews"] = json::array({{{"buffer", 0}, {"byteLength", 12 * count}}});
  document["accessors"] =
      json::array({{{"bufferView", 0}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}}});
  document["meshes"][0]["primitives"][0].erase("indices");
  document["meshes"][0]["primitives"][0]["mode"] = mode;
  return document;
}

TEST_F(Gltf, TheSampleIsAUnitSquareWithFlatNormals) {
  const Scene scene = load(sample_document());
  ASSERT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.name, "x");
  EXPECT_EQ(scene.bounds.lower, vec3(0, 0, 0));
  EXPECT_EQ(scene.bounds.upper, vec3(1, 1, 0));
  for (const vec3& n : scene.normals) EXPECT_EQ(n, vec3(0, 0, 1));
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "square");
  EXPECT_EQ(scene.objects[0].triangle_count, 2u);
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].name, "paint");
  EXPECT_EQ(scene.materials[0].base_color, vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(scene.materials[0].metallic, 0.0f);
  EXPECT_EQ(scene.materials[0].roughness, 0.75f);
  EXPECT_NE(scene.content_hash, 0u);
}

TEST_F(Gltf, TransformsOfNodesAreComposedFromTheRootDown) {
  // Parent: translate by (10, 0, 0) after a quarter turn about Y, which takes +X to -Z and +Z to +X.
  // Child: scale by (2, 3, 1), then translate by (0, 0, 5).
  json document = sample_document();
  document["nodes"] = json::parse(R"([
    {"children": [1], "translation": [10, 0, 0],
     "rotation": [0, 0.70710678118654752, 0, 0.70710678118654752]},
    {"mesh": 0, "matrix": [2,0,0,0, 0,3,0,0, 0,0,1,0, 0,0,5,1]}])");
  const Scene scene = load(document);
  // (x, y, 0) -> child (2x, 3y, 5) -> turned (5, 3y, -2x) -> moved (15, 3y, -2x)
  const vec3 expected[] = {{15, 0, 0}, {15, 0, -2}, {15, 3, -2}, {15, 3, 0}};
  for (size_t t = 0; t < 2; ++t) {
    const uvec3 corner = t == 0 ? uvec3(0, 1, 2) : uvec3(0, 2, 3);
    for (int c = 0; c < 3; ++c)
      expect_near(scene.positions[scene.triangles[t][c]], expected[corner[c]], 2e-6f);
    expect_near(scene.normals[scene.triangles[t].x], vec3(1, 0, 0));
    expect_near(vec3(geometric_normal(scene, static_cast<uint32_t>(t))), vec3(1, 0, 0));
  }
}

TEST_F(Gltf, AMirroringTransformKeepsFrontFacesCounterClockwise) {
  json document = sample_document();
  document["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = load(document);
  EXPECT_EQ(scene.bounds.lower, vec3(-1, 0, 0));
  for (uint32_t t = 0; t < 2; ++t) EXPECT_EQ(vec3(geometric_normal(scene, t)), vec3(0, 0, 1));
}

TEST_F(Gltf, AMeshPlacedTwiceBecomesTwoObjects) {
  json document = sample_document();
  document["nodes"].push_back({{"mesh", 0}, {"name", "copy"}, {"translation", {0, 0, 4}}});
  document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = load(document);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[1].name, "copy");
  EXPECT_EQ(scene.objects[1].first_triangle, 2u);
  EXPECT_EQ(scene.positions[scene.triangles[2].x], vec3(0, 0, 4));
}

TEST_F(Gltf, OnlyTheDefaultSceneIsLoadedAndWithoutScenesAllRoots) {
  json document = sample_document();
  document["nodes"].push_back({{"mesh", 0}});
  document["scenes"].push_back({{"nodes", {0, 1}}});
  EXPECT_EQ(load(document).triangle_count(), 2u);
  document["scene"] = 1;
  EXPECT_EQ(load(document).triangle_count(), 4u);
  document.erase("scene");
  EXPECT_EQ(load(document).triangle_count(), 2u);
  document.erase("scenes");
  EXPECT_EQ(load(document).triangle_count(), 4u);
}

TEST_F(Gltf, StripsAndFansKeepTheirWinding) {
  // A strip zigzags: (0,0) (1,0) (0,1) (1,1) (0,2): three triangles, all facing +Z.
  const std::string strip = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const Scene a = load(with_vertices(sample_document(), 5, 5), strip);
  ASSERT_EQ(a.triangle_count(), 3u);
  for (uint32_t t = 0; t < 3; ++t) EXPECT_EQ(vec3(geometric_normal(a, t)), vec3(0, 0, 1));
  const std::string fan = bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0});
  const Scene b = load(with_vertices(sample_document(), 5, 6), fan);
  ASSERT_EQ(b.triangle_count(), 3u);
  for (uint32_t t = 0; t < 3; ++t) EXPECT_EQ(vec3(geometric_normal(b, t)), vec3(0, 0, 1));
}

TEST_F(Gltf, TrianglesOfZeroAreaAreLeftOut) {
  // A proper triangle; one with two equal corners; three points on a line.
  const std::string buffer =
      bytes_of<float>({0, 0, 0, 1, 0,    0,    0,    1,    0,    0,    0,    0,    0,   0,
                       0, 0, 1, 0, 0.1f, 0.1f, 0.1f, 0.2f, 0.2f, 0.2f, 0.4f, 0.4f, 0.4f});
  const Scene scene = load(with_vertices(sample_document(), 9, 4), buffer);
  EXPECT_EQ(scene.triangle_count(), 1u);
  EXPECT_EQ(scene.positions.size(), 3u);
  EXPECT_EQ(scene.bounds.upper, vec3(1, 1, 0));
}

TEST_F(Gltf, IndicesOfEachWidthAndInterleavedPositionsAreRead) {
  for (const int type : {5121, 5123, 5125}) {
    json document = sample_document();
    std::string indices = type == 5121   ? bytes_of<uint8_t>({0, 1, 2, 0, 2, 3})
                          : type == 5123 ? bytes_of<uint16_t>({0, 1, 2, 0, 2, 3})
                                         : bytes_of<uint32_t>({0, 1, 2, 0, 2, 3});
    // Positions 16 bytes apart, the first at offset 4.
    const std::string positions = bytes_of<float>({9, 0, 0, 0, 9, 1, 0, 0, 9, 1, 1, 0, 9, 0, 1, 0});
    document["buffers"][0]["byteLength"] = positions.size() + indices.size();
    document["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 64}, {"byteStride", 16}};
    document["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", 64}, {"byteLength", indices.size()}};
    document["accessors"][0]["byteOffset"] = 4;
    document["accessors"][1]["componentType"] = type;
    const Scene scene = load(document, positions + indices);
    EXPECT_EQ(scene.triangle_count(), 2u);
    EXPECT_EQ(scene.bounds.upper, vec3(1, 1, 0)) << type;
  }
}

TEST_F(Gltf, NormalisedIntegerPositionsAndNormalsAreRead) {
  json document = sample_document();
  document["extensionsRequired"] = {"KHR_mesh_quantization"};
  const std::string positions = bytes_of<int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 32767, -32768, 0, 0});
  const std::string normals = bytes_of<int8_t>({0, 0, 127, 0, 0, 0, 64, 0, 0, 0, -128, 0});
  const std::string indices = bytes_of<uint16_t>({0, 1, 2});
  document["buffers"][0]["byteLength"] = 42;
  document["bufferViews"] = json::parse(R"([{"buffer": 0, "byteLength": 24, "byteStride": 8},
    {"buffer": 0, "byteOffset": 36, "byteLength": 6},
    {"buffer": 0, "byteOffset": 24, "byteLength": 12, "byteStride": 4}])");
  document["accessors"] = json::parse(R"([
    {"bufferView": 0, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
    {"bufferView": 2, "componentType": 5120, "normalized": true, "count": 3, "type": "VEC3"}])");
  document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
  const Scene scene = load(document, positions + normals + indices);
  ASSERT_EQ(scene.positions.size(), 3u);
  EXPECT_EQ(scene.positions[1], vec3(1, 0, 0));
  EXPECT_EQ(scene.positions[2], vec3(1, -1, 0));  // -32768 stands for -1 as well
  EXPECT_EQ(scene.normals[1], vec3(0, 0, 1));     // 64 / 127, made unit
  EXPECT_EQ(scene.normals[2], vec3(0, 0, -1));
}

TEST_F(Gltf, NormalsAreMadeUnitAndAMissingOneIsTakenFromItsTriangle) {
  json document = sample_document();
  document["buffers"][0]["byteLength"] = 108;
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 48}});
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
  const Scene scene = load(document, sample_buffer() + bytes_of<float>({0, 0, 5, 0, 3, 4, 0, 0, 0, 1, 0, 0}));
  ASSERT_EQ(scene.normals.size(), 4u);
  EXPECT_EQ(scene.normals[0], vec3(0, 0, 1));
  expect_near(scene.normals[1], vec3(0, 0.6f, 0.8f));
  EXPECT_EQ(scene.normals[2], vec3(0, 0, 1));
  EXPECT_EQ(scene.normals[3], vec3(1, 0, 0));
}

TEST_F(Gltf, DataUrisAndBinaryChunksHoldBuffers) {
  // base64 of sample_buffer(), by another program
  json document = sample_document(
      "data:application/"
      "octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAABAAIAAAACAAMA");
  const Scene a = load_gltf(folder_.write("a.gltf", document.dump()));
  const Scene b = load_gltf(folder_.write("b.glb", glb(sample_document("").dump(), sample_buffer())));
  EXPECT_EQ(a.bounds.upper, vec3(1, 1, 0));
  EXPECT_EQ(a.content_hash, b.content_hash);
}

TEST_F(Gltf, ImagesThatAreMissingOrDamagedDoNotMatter) {
  json document = sample_document();
  document["images"] =
      json::parse(R"([{"uri": "none.png"}, {"uri": "../../../etc/hostname"}, {"bufferView": 77},
    {"uri": "data:image/png;base64,AAAA"}])");
  document["textures"] = json::parse(R"([{"source": 0}, {"source": 99}])");
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  EXPECT_EQ(load(document).materials[0].base_color, vec3(0.5f, 0.25f, 0.125f));
}

TEST_F(Gltf, MaterialExtensionsAndDefaultsAreRead) {
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

TEST_F(Gltf, AVolumeMakesABodyAndItsColourAtADistanceTheAbsorption) {
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

TEST_F(Gltf, AMaterialThatDoesNotTransmitInItsFileIsNoSheet) {
  EXPECT_FALSE(load(sample_document()).materials[0].thin_walled);
}

TEST_F(Gltf, ExtrasOfOursWinOverTheExtensionsAndOthersAreLeftAlone) {
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

TEST_F(Gltf, LightsShineAlongTheNodesMinusZ) {
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

TEST_F(Gltf, PerspectiveCamerasLookAlongTheNodesMinusZ) {
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

TEST_F(Gltf, SavingAndLoadingKeepsEveryBitOfTrianglesAndMaterials) {
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

TEST_F(Gltf, SavingWhereNothingCanBeWrittenLeavesNothingBehind) {
  const Scene scene = load(sample_document());
  EXPECT_ANY_THROW(save_gltf(scene, folder_.path() / "no_such_folder" / "x.glb"));
}

}  // namespace
}  // namespace hybray
