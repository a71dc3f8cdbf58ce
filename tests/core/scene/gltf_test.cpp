// What the glTF loader makes of geometry and nodes, against values worked out by hand.
#include "tests/core/scene/gltf_fixture.h"

namespace hybray {
namespace {

using nlohmann::json;

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

}  // namespace
}  // namespace hybray
