#include "core/scene/overlay.h"

#include "core/base/error.h"
#include "core/scene/shapes.h"
#include "tests/core/scene/gltf_sample.h"
#include "tests/temporary_folder.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using nlohmann::json;

class Overlay : public ::testing::Test {
 protected:
  Overlay() { folder_.write("square.glb", glb(sample_document("").dump(), sample_buffer())); }

  Scene load_text(const std::string& text) const {
    return load_overlay(folder_.write("place.json", text),
                        [](const std::string& name, const std::string& where) -> Scene {
                          throw InputError(where, "asked for " + name);
                        });
  }
  Scene load(const json& overlay) const { return load_text(overlay.dump()); }

  // The unit square with one camera, after `change`.
  static json sample() {
    return json::parse(R"({"source": {"gltf": "square.glb"},
      "cameras": [{"name": "front", "eye": [0.5, 0.5, 3], "target": [0.5, 0.5, 0], "vertical_fov": 40}]})");
  }

  void expect_refused(const std::string& text, const std::string& place, const std::string& message) const {
    try {
      load_text(text);
      ADD_FAILURE() << "loaded, but should be refused at " << place;
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("place.json"), what.npos) << what;
      EXPECT_NE(what.find(place), what.npos) << what;
      EXPECT_NE(what.find(message), what.npos) << what;
    }
  }

  template <class Change>
  void refuse(const std::string& place, const std::string& message, const Change& change) const {
    json overlay = sample();
    change(overlay);
    expect_refused(overlay.dump(), place, message);
  }

  test::TemporaryFolder folder_;
};

TEST_F(Overlay, TheSourceAndItsCameraAreThere) {
  const Scene scene = load(sample());
  EXPECT_EQ(scene.name, "place");
  EXPECT_EQ(scene.triangle_count(), 2u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].eye, vec3(0.5f, 0.5f, 3));
  EXPECT_EQ(scene.cameras[0].vertical_fov, 40.0f);
  EXPECT_EQ(scene.cameras[0].up, vec3(0, 1, 0));
}

TEST_F(Overlay, AGeneratorIsASource) {
  json overlay = sample();
  overlay["source"] = json::parse(R"({"generator": "sphere", "triangles": 2048, "seed": 3})");
  EXPECT_NEAR(static_cast<double>(load(overlay).triangle_count()), 2048.0, 0.15 * 2048.0);
}

TEST_F(Overlay, MaterialsAreChangedWhereTheOverlaySaysSoAndOnlyThere) {
  json overlay = sample();
  overlay["materials"]["paint"] = {{"ior", 1.33}, {"transmission", 1.0}, {"emissive", {3, 2, 1}}};
  const Material material = load(overlay).materials[0];
  EXPECT_EQ(material.ior, 1.33f);
  EXPECT_EQ(material.transmission, 1.0f);
  EXPECT_EQ(material.emissive, vec3(3, 2, 1));
  EXPECT_EQ(material.base_color, vec3(0.5f, 0.25f, 0.125f));
  EXPECT_EQ(material.roughness, 0.75f);
}

TEST_F(Overlay, MediaAndMetalsAreGivenAndWhatIsNotGivenStays) {
  json overlay = sample();
  overlay["materials"]["paint"] =
      json::parse(R"({"outer_ior": 1.5, "absorption": [1, 2, 3], "outer_absorption": [0, 0.5, 0],
                      "thin_walled": true, "cut_out": "leaf", "conductor_eta": [0.2, 0.4, 1.4], "conductor_k": [3.5, 2.5, 2]})");
  const Material material = load(overlay).materials[0];
  EXPECT_EQ(material.ior, 1.5f);
  EXPECT_EQ(material.outer_ior, 1.5f);
  EXPECT_EQ(material.absorption, vec3(1, 2, 3));
  EXPECT_EQ(material.outer_absorption, vec3(0, 0.5f, 0));
  EXPECT_TRUE(material.thin_walled);
  EXPECT_EQ(material.cut_out, CutOut::leaf);
  EXPECT_EQ(material.conductor_eta, vec3(0.2f, 0.4f, 1.4f));
  EXPECT_EQ(material.conductor_k, vec3(3.5f, 2.5f, 2.0f));
  const Material plain = load(sample()).materials[0];
  EXPECT_EQ(plain.outer_ior, 1.0f);
  EXPECT_FALSE(plain.thin_walled);
}

TEST_F(Overlay, MediaThatCannotBeAreRefused) {
  const auto refuse_value = [&](const char* key, const json& value, const std::string& message) {
    refuse(std::string("/materials/paint/") + key, message,
           [&](json& o) { o["materials"]["paint"][key] = value; });
  };
  refuse_value("ior", 0.99, "not between 1");
  refuse_value("outer_ior", 0.0, "not between 1");
  refuse_value("outer_ior", -1.5, "not between 1");
  refuse_value("outer_ior", 1e300, "not between 1");
  refuse_value("outer_ior", "water", "expected a number");
  refuse_value("absorption", json::array({0, -1e-6, 0}), "not between 0");
  refuse_value("absorption", 3.0, "array of three numbers");
  refuse_value("absorption", json::array({0, 1e300, 0}), "not between 0");
  refuse_value("outer_absorption", json::array({0, 0}), "array of three numbers");
  refuse_value("conductor_eta", json::array({-0.1, 0, 0}), "not between 0");
  refuse_value("conductor_k", json::array({"1", 0, 0}), "array of three numbers");
  refuse_value("thin_walled", 1, "true or false");
  refuse_value("cut_out", "maple", "'maple' is not none, leaf or fern");
  refuse_value("thin_waled", true, "did you mean 'thin_walled'?");
}

TEST_F(Overlay, LightsAddToTheSourceUnlessTheyReplaceIt) {
  json document = sample_document("");
  document["extensions"]["KHR_lights_punctual"]["lights"] =
      json::parse(R"([{"type": "point", "name": "old"}])");
  document["nodes"].push_back(json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  document["scenes"][0]["nodes"] = {0, 1};
  folder_.write("square.glb", glb(document.dump(), sample_buffer()));
  json overlay = sample();
  overlay["lights"] = json::parse(R"([
    {"name": "sun", "kind": "directional", "direction": [0, -2, 0], "intensity": 5},
    {"name": "lamp", "kind": "spot", "position": [1, 2, 3], "direction": [0, 0, -1], "intensity": 7,
     "range": 4,
     "color": [1, 0.5, 0], "inner_cone_angle": 30, "outer_cone_angle": 60}])");
  const Scene scene = load(overlay);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].name, "old");
  EXPECT_EQ(scene.lights[1].direction, vec3(0, -1, 0));
  EXPECT_EQ(scene.lights[1].intensity, 5.0f);
  EXPECT_EQ(scene.lights[2].kind, LightKind::spot);
  EXPECT_EQ(scene.lights[2].range, 4.0f);
  EXPECT_NEAR(scene.lights[2].inner_cone_angle, 0.5235988, 1e-6);
  EXPECT_NEAR(scene.lights[2].outer_cone_angle, 1.0471976, 1e-6);
  overlay["replace_lights"] = true;
  EXPECT_EQ(load(overlay).lights.size(), 2u);
}

TEST_F(Overlay, ObjectsAreScaledThenTurnedThenMoved) {
  json overlay = sample();
  overlay["objects"] = json::parse(R"([
    {"name": "slab", "shape": "box", "scale": [4, 2, 1], "rotate": [0, 0, 90], "translate": [10, 0, 0],
     "material": {"base_color": [0.1, 0.2, 0.3]}},
    {"name": "twin", "gltf": "square.glb", "translate": [0, 0, 5], "scale": 2},
    {"name": "ball", "shape": "sphere", "tessellation": 8, "material": "paint"}])");
  const Scene scene = load(overlay);
  ASSERT_EQ(scene.objects.size(), 4u);
  Bounds3 slab, twin;
  for (const vec3& p : object_mesh(scene, scene.objects[1]).positions) slab.extend(p);
  for (const vec3& p : object_mesh(scene, scene.objects[2]).positions) twin.extend(p);
  // 4 x 2 x 1, turned a quarter about Z, is 2 x 4 x 1.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(slab.lower[c], vec3(9, -2, -0.5f)[c], 1e-5);
    EXPECT_NEAR(slab.upper[c], vec3(11, 2, 0.5f)[c], 1e-5);
  }
  EXPECT_EQ(twin.lower, vec3(0, 0, 5));
  EXPECT_EQ(twin.upper, vec3(2, 2, 5));
  EXPECT_EQ(scene.materials[scene.objects[1].material].base_color, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.materials[scene.objects[2].material].name, "twin/paint");
  EXPECT_EQ(scene.objects[2].name, "twin/square");
  EXPECT_EQ(scene.objects[3].material, scene.objects[0].material);
}

TEST_F(Overlay, RotationsAboutSeveralAxesAreXThenYThenZ) {
  json overlay = sample();
  // A box that is long in Z: about X it comes to lie along Y, about Y it stays there, about Z it ends along
  // X.
  overlay["objects"] =
      json::parse(R"([{"name": "bar", "shape": "box", "scale": [1, 1, 8], "rotate": [90, 90, 90]}])");
  const Scene scene = load(overlay);
  Bounds3 bar;
  for (const vec3& p : object_mesh(scene, scene.objects[1]).positions) bar.extend(p);
  EXPECT_NEAR(bar.upper.x - bar.lower.x, 8.0, 1e-5);
  EXPECT_NEAR(bar.upper.y - bar.lower.y, 1.0, 1e-5);
}

TEST_F(Overlay, RemovedMaterialsTakeTheirTrianglesWithThem) {
  json document = sample_document("");
  document["materials"].push_back({{"name", "leaves"}});
  document["meshes"].push_back(document["meshes"][0]);
  document["meshes"][1]["primitives"][0]["material"] = 1;
  document["nodes"].push_back({{"mesh", 1}, {"translation", {50, 0, 0}}});
  document["scenes"][0]["nodes"] = {0, 1};
  folder_.write("square.glb", glb(document.dump(), sample_buffer()));
  json overlay = sample();
  EXPECT_EQ(load(overlay).triangle_count(), 4u);
  overlay["remove_materials"] = {"leaves"};
  const Scene scene = load(overlay);
  EXPECT_EQ(scene.triangle_count(), 2u);
  EXPECT_EQ(scene.positions.size(), 6u);  // flat normals: each triangle has its own corners
  EXPECT_EQ(scene.bounds.upper, vec3(1, 1, 0));
  refuse("/remove_materials/0", "did you mean 'leaves'?", [](json& o) { o["remove_materials"] = {"leavs"}; });
  overlay["remove_materials"] = {"leaves", "paint"};
  expect_refused(overlay.dump(), "place.json", "no surfaces");
}

TEST_F(Overlay, RemovedMaterialsTakeTheirCurvesAlong) {
  json overlay = sample();
  overlay["source"] = json::parse(R"({"generator": "meadow", "triangles": 8192})");
  const Scene all = load(overlay);
  overlay["remove_materials"] = {"grass"};
  const Scene kept = load(overlay);
  const auto count = [&](const std::string& material) {
    return std::count_if(all.curves.begin(), all.curves.end(),
                         [&](const RoundCurve& c) { return all.materials[c.material].name == material; });
  };
  EXPECT_GT(count("grass"), 1000);
  EXPECT_EQ(static_cast<ptrdiff_t>(kept.curves.size()), count("straw") + count("reed"));
  EXPECT_EQ(kept.triangle_count(), all.triangle_count());
}

TEST_F(Overlay, TheHashCoversWhatTheOverlayChanges) {
  json overlay = sample();
  const uint64_t plain = load(overlay).content_hash;
  EXPECT_EQ(load(overlay).content_hash, plain);
  overlay["materials"]["paint"] = {{"roughness", 0.5}};
  EXPECT_NE(load(overlay).content_hash, plain);
}

TEST_F(Overlay, ASyntaxErrorIsPlacedByLineAndColumn) {
  expect_refused("{\n  \"source\": {\"gltf\": \"square.glb\"},\n}", "place.json:3:1", "not valid JSON");
  expect_refused("", "place.json:1:1", "not valid JSON");
  expect_refused("[]", "place.json", "expected an object");
}

TEST_F(Overlay, UnknownKeysAreErrorsWithTheNearestKnownKey) {
  refuse("/camera", "did you mean 'cameras'?", [](json& o) { o["camera"] = json::array(); });
  refuse("/cameras/0/eyes", "did you mean 'eye'?", [](json& o) { o["cameras"][0]["eyes"] = 1; });
  refuse("/source/gtlf", "did you mean 'gltf'?", [](json& o) { o["source"] = {{"gtlf", "square"}}; });
  refuse("/materials/paint/rougness", "did you mean 'roughness'?",
         [](json& o) { o["materials"]["paint"]["rougness"] = 1; });
  refuse("/quux", "known here: $schema, title", [](json& o) { o["quux"] = 1; });
}

TEST_F(Overlay, UnknownNamesAreErrorsWithTheNearestKnownName) {
  refuse("/materials/pant", "did you mean 'paint'?",
         [](json& o) { o["materials"]["pant"] = json::object(); });
  refuse("/source/generator", "did you mean 'atrium'?", [](json& o) {
    o["source"] = {{"generator", "artium"}};
  });
  refuse("/objects/0/shape", "did you mean 'sphere'?", [](json& o) {
    o["objects"] = {{{"name", "a"}, {"shape", "spere"}}};
  });
  refuse("/objects/0/material", "did you mean 'paint'?", [](json& o) {
    o["objects"] = {{{"name", "a"}, {"shape", "box"}, {"material", "paints"}}};
  });
}

TEST_F(Overlay, WrongTypesAndValuesOutOfRangeAreNamed) {
  refuse("/source", "missing", [](json& o) { o.erase("source"); });
  refuse("/source", "either", [](json& o) { o["source"] = json::object(); });
  refuse("/source", "either", [](json& o) { o["source"] = {{"gltf", "a"}, {"generator", "atrium"}}; });
  refuse("/source/triangles", "only a generator", [](json& o) { o["source"]["triangles"] = 5; });
  refuse("/source/triangles", "whole number", [](json& o) {
    o["source"] = {{"generator", "atrium"}, {"triangles", 1.5}};
  });
  refuse("/source/triangles", "not between", [](json& o) {
    o["source"] = {{"generator", "atrium"}, {"triangles", 1000000000000}};
  });
  refuse("/cameras", "expected an array", [](json& o) { o["cameras"] = 1; });
  refuse("/cameras/0/eye", "three numbers", [](json& o) { o["cameras"][0]["eye"] = {1, 2}; });
  refuse("/cameras/0/eye", "not between", [](json& o) { o["cameras"][0]["eye"] = {1, 2, 1e300}; });
  refuse("/cameras/0/target", "is the eye",
         [](json& o) { o["cameras"][0]["target"] = o["cameras"][0]["eye"]; });
  refuse("/cameras/0/target", "parallel to up", [](json& o) { o["cameras"][0]["target"] = {0.5, 9, 3}; });
  refuse("/cameras/0/vertical_fov", "not between", [](json& o) { o["cameras"][0]["vertical_fov"] = 180; });
  refuse("/cameras/0/name", "missing", [](json& o) { o["cameras"][0].erase("name"); });
  refuse("/cameras/1/name", "two cameras", [](json& o) { o["cameras"].push_back(o["cameras"][0]); });
  refuse("/materials/paint/ior", "not between", [](json& o) { o["materials"]["paint"]["ior"] = 0.9; });
  refuse("/lights/0/kind", "not point", [](json& o) {
    o["lights"] = {{{"name", "a"}, {"kind", "area"}, {"intensity", 1}}};
  });
  refuse("/lights/0/position", "missing", [](json& o) {
    o["lights"] = {{{"name", "a"}, {"kind", "point"}, {"intensity", 1}}};
  });
  refuse("/lights/0/position", "has none", [](json& o) {
    o["lights"] = {{{"name", "a"},
                    {"kind", "directional"},
                    {"direction", {0, 1, 0}},
                    {"position", {0, 0, 0}},
                    {"intensity", 1}}};
  });
  refuse("/lights/0/intensity", "not between", [](json& o) {
    o["lights"] = {{{"name", "a"}, {"kind", "point"}, {"position", {0, 0, 0}}, {"intensity", -1}}};
  });
  refuse("/objects/0", "either", [](json& o) { o["objects"] = {{{"name", "a"}}}; });
  refuse("/objects/0/scale", "leaves nothing", [](json& o) {
    o["objects"] = {{{"name", "a"}, {"shape", "box"}, {"scale", {1, 0, 1}}}};
  });
  refuse("/objects/0/tessellation", "not between", [](json& o) {
    o["objects"] = {{{"name", "a"}, {"shape", "sphere"}, {"tessellation", 2}}};
  });
  refuse("/objects/0", "range of float", [](json& o) {
    o["objects"] = {{{"name", "a"}, {"shape", "box"}, {"scale", 3e38}, {"translate", {3e38, 0, 0}}}};
  });
}

TEST_F(Overlay, FilesAreOnlyReadBesideTheOverlay) {
  refuse("/source", "leaves the folder", [](json& o) { o["source"]["gltf"] = "../square.glb"; });
  refuse("/objects/0/gltf", "absolute", [&](json& o) {
    o["objects"] = {{{"name", "a"}, {"gltf", (folder_.path() / "square.glb").string()}}};
  });
  refuse("/source", "asked for elsewhere", [](json& o) { o["source"]["gltf"] = "elsewhere"; });
}

TEST(Shapes, AreClosedAndFaceOutwards) {
  // The divergence theorem: a closed surface that faces outwards encloses the sum of its signed tetrahedra.
  const auto volume = [](const Mesh& mesh) {
    double sum = 0.0;
    for (const uvec3& tri : mesh.triangles)
      sum += glm::dot(dvec3(mesh.positions[tri.x]),
                      glm::cross(dvec3(mesh.positions[tri.y]), dvec3(mesh.positions[tri.z]))) /
             6.0;
    return sum;
  };
  constexpr double kPi = 3.14159265358979;
  EXPECT_NEAR(volume(make_shape("box", 1)), 1.0, 1e-6);
  EXPECT_NEAR(volume(make_shape("box", 5)), 1.0, 1e-6);
  EXPECT_NEAR(volume(make_shape("sphere", 256)), 4.0 / 3.0 * kPi, 2e-3);
  EXPECT_NEAR(volume(make_shape("cylinder", 256)), kPi, 1e-3);
  EXPECT_EQ(make_shape("plane", 3).triangles.size(), 18u);
  for (const std::string& name : shape_names()) {
    const Mesh mesh = make_shape(name, 12);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const uvec3& tri : mesh.triangles) {
      const dvec3 n = glm::cross(dvec3(mesh.positions[tri.y]) - dvec3(mesh.positions[tri.x]),
                                 dvec3(mesh.positions[tri.z]) - dvec3(mesh.positions[tri.x]));
      for (const uint32_t v : {tri.x, tri.y, tri.z}) {
        EXPECT_NEAR(glm::length(mesh.normals[v]), 1.0, 1e-6) << name;
        EXPECT_GT(glm::dot(n, dvec3(mesh.normals[v])), 0.0) << name;
      }
    }
  }
  EXPECT_GT(make_shape("plane", 1).normals[0].y, 0.99f);
}

}  // namespace
}  // namespace hybray
