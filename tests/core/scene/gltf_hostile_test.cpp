// glTF files from strangers: each kind of malformation ends in one InputError that names the place, never in
// a crash.
#include "core/base/error.h"
#include "core/scene/gltf.h"
#include "tests/core/scene/gltf_sample.h"
#include "tests/temporary_folder.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using nlohmann::json;

class GltfHostile : public ::testing::Test {
 protected:
  // Loads the file and expects an InputError whose message contains both texts.
  void expect_refused(const std::filesystem::path& file, const std::string& place, const std::string& text,
                      size_t max_triangles = 1000) const {
    try {
      load_gltf(file, max_triangles);
      ADD_FAILURE() << "loaded, but should be refused at " << place;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(file.string()), message.npos) << message;
      EXPECT_NE(message.find(place), message.npos) << message;
      EXPECT_NE(message.find(text), message.npos) << message;
    }
  }

  // The same for the sample document after `change`.
  void refuse(const std::string& place, const std::string& text, const std::function<void(json&)>& change) {
    json document = sample_document();
    change(document);
    folder_.write("data.bin", sample_buffer());
    expect_refused(folder_.write("x.gltf", document.dump()), place, text);
  }

  void refuse_buffer(const std::string& place, const std::string& text, const std::string& buffer) {
    json document = sample_document();
    folder_.write("data.bin", buffer);
    expect_refused(folder_.write("x.gltf", document.dump()), place, text);
  }

  test::TemporaryFolder folder_;
};

TEST_F(GltfHostile, TheSampleItselfLoads) {
  folder_.write("data.bin", sample_buffer());
  EXPECT_EQ(load_gltf(folder_.write("x.gltf", sample_document().dump())).triangle_count(), 2u);
}

TEST_F(GltfHostile, AMissingFileAFolderAndAnEmptyFileAreRefused) {
  expect_refused(folder_.path() / "none.gltf", "none.gltf", "there is no file");
  expect_refused(folder_.path(), "", "not a regular file");
  expect_refused(folder_.write("x.gltf", ""), "x.gltf:1:1", "not valid JSON");
}

TEST_F(GltfHostile, ASyntaxErrorIsPlacedByLineAndColumn) {
  expect_refused(folder_.write("x.gltf", "{\n  \"asset\": {\"version\": \"2.0\"},\n  \"nodes\": [}\n}"),
                 "x.gltf:3:13", "not valid JSON");
}

TEST_F(GltfHostile, DeepNestingIsRefusedBeforeAnythingRecurses) {
  const std::string deep = std::string(1 << 20, '[') + std::string(1 << 20, ']');
  expect_refused(folder_.write("x.gltf", R"({"asset":{"version":"2.0"},"extras":)" + deep + "}"),
                 "x.gltf:1:", "nested deeper");
}

TEST_F(GltfHostile, AnotherVersionAndAMissingAssetAreRefused) {
  refuse("/asset/version", "'1.0' is not supported", [](json& d) { d["asset"]["version"] = "1.0"; });
  refuse("/asset", "missing", [](json& d) { d.erase("asset"); });
  expect_refused(folder_.write("x.gltf", "[1, 2, 3, 4]"), "x.gltf", "not a JSON object");
}

TEST_F(GltfHostile, EveryIndexOutOfRangeIsNamed) {
  const auto at = [](const char* pointer, const json& value) {
    return [=](json& d) { d[json::json_pointer(pointer)] = value; };
  };
  for (const char* pointer :
       {"/scene", "/scenes/0/nodes/0", "/nodes/0/mesh", "/nodes/0/camera",
        "/meshes/0/primitives/0/attributes/POSITION", "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/material", "/accessors/0/bufferView", "/bufferViews/1/buffer"}) {
    SCOPED_TRACE(pointer);
    refuse(pointer, "out of range", at(pointer, 7));
    refuse(pointer, "out of range", at(pointer, 4294967296ull));  // 0 once it is cut to 32 bits
    refuse(pointer, "not an index", at(pointer, -1));
    refuse(pointer, "not an index", at(pointer, "0"));
    refuse(pointer, "not an index", at(pointer, 0.5));
  }
  refuse("/nodes/0/children/1", "out of range", [](json& d) {
    d["nodes"].push_back(json::object());
    d["nodes"][0]["children"] = {1, 9};
  });
}

TEST_F(GltfHostile, WrongTypesAreNamedAndNotTakenForAbsent) {
  refuse("/nodes/0/matrix", "array of 16 numbers", [](json& d) { d["nodes"][0]["matrix"] = {1, 2, 3}; });
  refuse("/nodes/0/translation", "array of 3 numbers", [](json& d) {
    d["nodes"][0]["translation"] = {1, "2", 3};
  });
  refuse("/nodes/0", "not an object", [](json& d) { d["nodes"][0] = 5; });
  refuse("/meshes", "not an array", [](json& d) { d["meshes"] = json::object(); });
  refuse("/meshes/0/primitives", "missing", [](json& d) { d["meshes"][0].erase("primitives"); });
  refuse("/accessors/0/count", "missing", [](json& d) { d["accessors"][0].erase("count"); });
  refuse("/accessors/0/normalized", "true or false", [](json& d) { d["accessors"][0]["normalized"] = 1; });
  refuse("/materials/0/pbrMetallicRoughness/roughnessFactor", "not a number",
         [](json& d) { d["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = "rough"; });
}

TEST_F(GltfHostile, AVertexIndexBeyondThePositionsIsRefused) {
  std::string buffer = sample_buffer();
  buffer[48 + 2 * 4] = 4;
  refuse_buffer("/accessors/1", "element 4 is vertex index 4; there are 4 vertices", buffer);
}

TEST_F(GltfHostile, ValuesThatAreNotFiniteAreRefused) {
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::string buffer = sample_buffer();
    std::memcpy(buffer.data() + 12, &value, 4);
    refuse_buffer("/accessors/0", "element 1 is not finite", buffer);
  }
  folder_.write("x.gltf", "");
  std::string text = sample_document().dump();
  text.replace(text.find("0.75"), 4, "1e999");
  expect_refused(folder_.write("x.gltf", text), "x.gltf", "not valid JSON");
  refuse("/nodes/1", "transform is beyond the range of float", [](json& d) {
    d["nodes"] = json::parse(
        R"([{"children": [1], "scale": [1e30, 1e30, 1e30]}, {"mesh": 0, "scale": [1e300, 1, 1]}])");
  });
  refuse("/nodes/0", "vertex beyond the range of float", [](json& d) {
    d["nodes"][0]["scale"] = {2e38, 2e38, 2e38};
    d["nodes"][0]["translation"] = {3e38, 0, 0};
  });
}

TEST_F(GltfHostile, NormalsThatAreNotFiniteOrTooFewAreRefused) {
  const auto with_normals = [](json& d, size_t count) {
    d["buffers"][0]["byteLength"] = 108;
    d["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 48}});
    d["accessors"].push_back(
        {{"bufferView", 2}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
    d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2;
  };
  std::vector<float> normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  json document = sample_document();
  with_normals(document, 3);
  folder_.write("data.bin", sample_buffer() + bytes_of(normals));
  expect_refused(folder_.write("x.gltf", document.dump()), "/attributes/NORMAL", "3 normals for 4 positions");
  normals[5] = std::nanf("");
  document = sample_document();
  with_normals(document, 4);
  folder_.write("data.bin", sample_buffer() + bytes_of(normals));
  expect_refused(folder_.write("x.gltf", document.dump()), "/accessors/2", "element 1 is not finite");
}

TEST_F(GltfHostile, MissingAndShortBuffersAreRefused) {
  expect_refused(folder_.write("x.gltf", sample_document().dump()), "/buffers/0/uri", "there is no file");
  refuse_buffer("/buffers/0/byteLength", "states 60 bytes, there are 59", sample_buffer().substr(0, 59));
  refuse("/buffers/0", "no uri", [](json& d) { d["buffers"][0].erase("uri"); });
  refuse("/buffers/0/uri", "data URI",
         [](json& d) { d["buffers"][0]["uri"] = "data:application/octet-stream;base64,"; });
  refuse("/buffers/0/byteLength", "there are 3",
         [](json& d) { d["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAA"; });
  refuse("/buffers/0/byteLength", "states 18446744073709551615 bytes",
         [](json& d) { d["buffers"][0]["byteLength"] = 18446744073709551615ull; });
}

TEST_F(GltfHostile, AccessorsThatLeaveTheirViewAreRefused) {
  refuse("/accessors/0", "leave the buffer view", [](json& d) { d["accessors"][0]["count"] = 5; });
  refuse("/accessors/0", "leave the buffer view", [](json& d) { d["accessors"][0]["byteOffset"] = 4; });
  refuse("/accessors/0", "leave the buffer view",
         [](json& d) { d["accessors"][0]["byteOffset"] = 18446744073709551612ull; });
  refuse("/accessors/0", "leave the buffer view", [](json& d) { d["bufferViews"][0]["byteStride"] = 16; });
  refuse("/bufferViews/0/byteStride", "less than one element",
         [](json& d) { d["bufferViews"][0]["byteStride"] = 8; });
  refuse("/bufferViews/1", "leave the buffer", [](json& d) { d["bufferViews"][1]["byteLength"] = 13; });
  refuse("/bufferViews/1", "leave the buffer",
         [](json& d) { d["bufferViews"][1]["byteOffset"] = 18446744073709551615ull; });
}

TEST_F(GltfHostile, HugeCountsAreRefusedBeforeTheyAreAllocated) {
  refuse("/meshes/0/primitives/0", "more than 1000 triangles",
         [](json& d) { d["accessors"][1]["count"] = 3000000000u; });
  refuse("/accessors/0", "leave the buffer view", [](json& d) { d["accessors"][0]["count"] = 4000000000u; });
  refuse("/accessors/0/count", "2^32", [](json& d) { d["accessors"][0]["count"] = 1ull << 60; });
  refuse("/accessors/0/count", "not between 1", [](json& d) { d["accessors"][0]["count"] = 0; });
}

TEST_F(GltfHostile, InstancesCountTowardsTheLimitOfTriangles) {
  json document = sample_document();
  for (int i = 1; i < 600; ++i) {
    document["nodes"].push_back({{"mesh", 0}});
    document["scenes"][0]["nodes"].push_back(i);
  }
  folder_.write("data.bin", sample_buffer());
  const auto file = folder_.write("x.gltf", document.dump());
  expect_refused(file, "/meshes/0", "more than 1199 triangles", 1199);
  EXPECT_EQ(load_gltf(file, 1200).triangle_count(), 1200u);
}

TEST_F(GltfHostile, UnsuitableTypesAndSparseAccessorsAreRefused) {
  refuse("/accessors/0/type", "not the type", [](json& d) { d["accessors"][0]["type"] = "VEC2"; });
  refuse("/accessors/1/componentType", "5126", [](json& d) { d["accessors"][1]["componentType"] = 5126; });
  refuse("/accessors/1/componentType", "5122", [](json& d) { d["accessors"][1]["componentType"] = 5122; });
  refuse("/accessors/0/componentType", "5125", [](json& d) { d["accessors"][0]["componentType"] = 5125; });
  refuse("/accessors/0/bufferView", "missing", [](json& d) { d["accessors"][0].erase("bufferView"); });
  refuse("/accessors/0/sparse", "not supported", [](json& d) {
    d["accessors"][0]["sparse"] = json::parse(
        R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})");
  });
}

TEST_F(GltfHostile, NodesMustBeTrees) {
  refuse("/nodes/1", "above itself",
         [](json& d) { d["nodes"] = json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])"); });
  refuse("/nodes/0", "above itself", [](json& d) { d["nodes"][0]["children"] = {0}; });
  refuse("/nodes/1/children", "child of node 0 already", [](json& d) {
    d["nodes"] = json::parse(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])");
    d["scenes"][0]["nodes"] = {0, 1};
  });
  refuse("/scenes/0/nodes", "is no root", [](json& d) {
    d["nodes"] = json::parse(R"([{"children": [1]}, {"mesh": 0}])");
    d["scenes"][0]["nodes"] = {0, 1};
  });
  refuse("/scenes/0/nodes", "listed twice", [](json& d) { d["scenes"][0]["nodes"] = {0, 0}; });
}

TEST_F(GltfHostile, AChainOfManyNodesNeedsNoStack) {
  json document = sample_document();
  constexpr int kNodes = 100000;
  json nodes = json::array();
  for (int i = 0; i + 1 < kNodes; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", 0}});
  document["nodes"] = nodes;
  folder_.write("data.bin", sample_buffer());
  EXPECT_EQ(load_gltf(folder_.write("x.gltf", document.dump())).triangle_count(), 2u);
}

TEST_F(GltfHostile, TransformsWithoutAnInverseAreRefused) {
  refuse("/nodes/0", "flattens space", [](json& d) { d["nodes"][0]["scale"] = {1, 0, 1}; });
  refuse("/nodes/0/rotation", "not a rotation", [](json& d) { d["nodes"][0]["rotation"] = {0, 0, 0, 0}; });
  refuse("/nodes/0/matrix", "not affine",
         [](json& d) { d["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; });
}

TEST_F(GltfHostile, UrisThatLeaveTheFolderAreRefused) {
  const std::filesystem::path outside = folder_.write("outside/secret.bin", sample_buffer());
  folder_.write("inside/sub/data.bin", sample_buffer());
  std::filesystem::create_symlink(outside, folder_.path() / "inside/link.bin");
  std::filesystem::create_directory_symlink(outside.parent_path(), folder_.path() / "inside/folder");
  const auto with_uri = [&](const std::string& uri) {
    return folder_.write("inside/x.gltf", sample_document(uri).dump());
  };
  for (const std::string& uri :
       {std::string("../outside/secret.bin"), std::string("sub/../../outside/secret.bin"),
        std::string("%2e%2e/outside/secret.bin"), std::string("%2E%2E%2Foutside%2Fsecret.bin"),
        outside.string(), "file://" + outside.string(), std::string("file:secret.bin"),
        std::string("http://example.org/a.bin"), std::string("..\\outside\\secret.bin"),
        std::string("link.bin"), std::string("folder/secret.bin"), std::string("%00"), std::string("a%2"),
        std::string("a%zz"), std::string("")}) {
    SCOPED_TRACE(uri);
    json document = sample_document(uri);
    document["buffers"][0]["uri"] = uri;
    expect_refused(folder_.write("inside/x.gltf", document.dump()), "/buffers/0/uri", "URI");
  }
  EXPECT_EQ(load_gltf(with_uri("sub/data.bin")).triangle_count(), 2u);
  EXPECT_EQ(load_gltf(with_uri("sub/../sub/d%61ta.bin")).triangle_count(), 2u);
}

TEST_F(GltfHostile, CompressionExtensionsThatAreRequiredAreNamed) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "VENDOR_unknown"})
    refuse("/extensionsRequired/0", name, [&](json& d) { d["extensionsRequired"] = {name}; });
}

TEST_F(GltfHostile, PrimitivesWithoutTrianglesLeaveAnEmptySceneWhichIsRefused) {
  for (const int mode : {0, 1, 2, 3})
    refuse("x.gltf", "no triangles", [&](json& d) { d["meshes"][0]["primitives"][0]["mode"] = mode; });
  refuse("/mode", "not a primitive mode", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 9; });
  refuse("x.gltf", "whole number of triangles", [](json& d) { d["accessors"][1]["count"] = 5; });
  refuse("/attributes", "no POSITION",
         [](json& d) { d["meshes"][0]["primitives"][0]["attributes"] = json::object(); });
  refuse("x.gltf", "no triangles", [](json& d) { d["nodes"][0]["scale"] = {0, 0, 0}; });
  refuse("x.gltf", "no triangles", [](json& d) { d["scenes"][0].erase("nodes"); });
}

TEST_F(GltfHostile, FactorsOutOfRangeAreRefused) {
  refuse("/baseColorFactor", "not between", [](json& d) {
    d["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {2, 0, 0, 1};
  });
  refuse("/emissiveFactor", "below 0", [](json& d) { d["materials"][0]["emissiveFactor"] = {0, -1, 0}; });
  refuse("/KHR_materials_ior/ior", "below 1",
         [](json& d) { d["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 0.5; });
  refuse("/KHR_materials_transmission", "not a number", [](json& d) {
    d["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = "clear";
  });
}

TEST_F(GltfHostile, VolumesThatCannotBeAreRefused) {
  const auto refuse_volume = [&](const char* key, const json& value, const std::string& message) {
    refuse(std::string("/KHR_materials_volume"), message, [&](json& d) {
      json& extensions = d["materials"][0]["extensions"];
      extensions["KHR_materials_transmission"]["transmissionFactor"] = 1.0;
      extensions["KHR_materials_volume"] = {{"thicknessFactor", 1.0}, {"attenuationColor", {0.5, 0.5, 0.5}}};
      extensions["KHR_materials_volume"][key] = value;
    });
  };
  refuse_volume("thicknessFactor", -1.0, "below 0");
  refuse_volume("thicknessFactor", "thick", "not a number");
  refuse_volume("attenuationDistance", 0.0, "not above 0");
  refuse_volume("attenuationDistance", -2.0, "not above 0");
  refuse_volume("attenuationDistance", 1e-300, "not finite");
  refuse_volume("attenuationColor", json::array({0.5, 1.5, 0.5}), "not between 0 and 1");
  refuse_volume("attenuationColor", json::array({0.5, -0.5, 0.5}), "not between 0 and 1");
  refuse_volume("attenuationColor", json::array({0.5, 0.5}), "array of 3 numbers");
}

TEST_F(GltfHostile, ExtrasOfOursThatCannotBeAreRefused) {
  const auto refuse_extra = [&](const char* key, const json& value, const std::string& message) {
    refuse(std::string("/materials/0/extras/hybray/") + key, message,
           [&](json& d) { d["materials"][0]["extras"]["hybray"][key] = value; });
  };
  refuse_extra("outer_ior", 0.5, "below 1");
  refuse_extra("outer_ior", 1e300, "below 1 or not finite");
  refuse_extra("outer_ior", nullptr, "not a number");
  refuse_extra("absorption", json::array({1, 2}), "array of 3 numbers");
  refuse_extra("absorption", json::array({1, -2, 3}), "below 0");
  refuse_extra("outer_absorption", json::array({1, 1e300, 3}), "not finite");
  refuse_extra("thin_walled", 1, "true or false");
  refuse_extra("conductor_eta", "gold", "array of 3 numbers");
  refuse_extra("conductor_k", json::array({-1, 0, 0}), "below 0");
  refuse_extra("cut_out", "maple", "'maple' is not none, leaf or fern");
  refuse_extra("cut_out", 1, "not a string");
  refuse_extra("colour", 1, "unknown key");
  refuse("/materials/0/extras/hybray", "not an object",
         [](json& d) { d["materials"][0]["extras"]["hybray"] = 3; });
}

TEST_F(GltfHostile, BinaryFilesWithWrongLengthsAreRefused) {
  const std::string good = glb(sample_document("").dump(), sample_buffer());
  EXPECT_EQ(load_gltf(folder_.write("x.glb", good)).triangle_count(), 2u);
  const auto patched = [&](size_t offset, uint32_t value) {
    std::string bytes = good;
    std::memcpy(bytes.data() + offset, &value, 4);
    return folder_.write("x.glb", bytes);
  };
  const auto json_size = static_cast<uint32_t>(good.size() - 28 - 60);
  expect_refused(patched(4, 1), "x.glb", "version 1 is not supported");
  expect_refused(patched(8, static_cast<uint32_t>(good.size()) + 4), "x.glb", "the header states");
  expect_refused(patched(12, 0xfffffff0u), "x.glb", "chunk 0 states 4294967280 bytes");
  expect_refused(patched(16, 0x004e4942), "x.glb", "first chunk is not JSON");
  expect_refused(patched(20 + json_size, 61), "x.glb", "chunk 1 states 61 bytes, 60 are left");
  expect_refused(patched(20 + json_size, 56), "x.glb", "chunk 2 is cut short");
  for (size_t size = 4; size < good.size(); size += 7) {
    const auto file = folder_.write("x.glb", good.substr(0, size));
    EXPECT_THROW(load_gltf(file), InputError) << "cut to " << size << " bytes";
  }
}

}  // namespace
}  // namespace hybray
