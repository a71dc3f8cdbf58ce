#include "core/scene/scene_library.h"

#include "core/base/error.h"
#include "core/scene/procedural/generators.h"
#include "tests/core/scene/gltf_sample.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <ostream>

#include <gtest/gtest.h>

namespace hybray {
namespace {

class SceneLibrary : public ::testing::Test {
 protected:
  std::string square(float width) const {
    auto document = sample_document("");
    document["nodes"][0]["scale"] = {width, 1, 1};
    return glb(document.dump(), sample_buffer());
  }

  ScenePaths paths() const {
    return {{folder_.path() / "scenes"}, {folder_.path() / "first", folder_.path() / "second"}};
  }

  test::TemporaryFolder folder_;
};

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), text.npos) << "'" << part << "' is not in: " << text;
}

TEST_F(SceneLibrary, SourcesAreSearchedInOrderAndInFolders) {
  folder_.write("second/a.glb", square(2));
  folder_.write("first/a/a.glb", square(3));
  folder_.write("second/b/b.glb", square(4));
  EXPECT_EQ(load_scene(paths(), "a").bounds.upper.x, 3.0f);
  EXPECT_EQ(load_scene(paths(), "b").bounds.upper.x, 4.0f);
  EXPECT_EQ(load_scene(paths(), "a").name, "a");
  folder_.write("first/a.glb", square(5));
  EXPECT_EQ(load_scene(paths(), "a").bounds.upper.x, 5.0f);
}

TEST_F(SceneLibrary, AnOverlayComesBeforeAGeneratorAndAFile) {
  folder_.write("first/base.glb", square(7));
  folder_.write("first/sphere.glb", square(1));
  EXPECT_NE(load_scene(paths(), "sphere").triangle_count(), 2u);
  folder_.write("scenes/sphere.json", R"({"source": {"gltf": "base"}})");
  const Scene scene = load_scene(paths(), "sphere");
  EXPECT_EQ(scene.bounds.upper.x, 7.0f);
  EXPECT_EQ(scene.name, "sphere");
}

TEST_F(SceneLibrary, AGeneratorLoadsByItsName) {
  const Scene scene = load_scene(paths(), "sphere");
  EXPECT_EQ(scene.name, "sphere");
  EXPECT_GT(scene.triangle_count(), 500u);
  EXPECT_NE(scene.content_hash, 0u);
  EXPECT_EQ(find_scene(paths(), "sphere").source, "generator sphere");
}

TEST_F(SceneLibrary, AMissingSourceNamesTheFoldersAndTheWayOut) {
  folder_.write("scenes/town.json", R"({"source": {"gltf": "town_model"}})");
  EXPECT_EQ(find_scene(paths(), "town").state, SceneState::source_missing);
  EXPECT_EQ(find_scene(paths(), "town").source, "town_model");
  const std::string message = message_of([&] { load_scene(paths(), "town"); });
  for (const char* part :
       {"town.json: /source", "town_model.glb", "/first", "/second", "fetch_scenes.py", "HYBRAY_SCENE_PATH"})
    expect_contains(message, part);
}

TEST_F(SceneLibrary, AnUnknownSceneIsAnErrorWithTheNearestName) {
  folder_.write("first/cathedral.glb", square(1));
  EXPECT_EQ(find_scene(paths(), "cathedrl").state, SceneState::unknown);
  expect_contains(message_of([&] { load_scene(paths(), "cathedrl"); }), "did you mean 'cathedral'?");
  expect_contains(message_of([&] { load_scene(paths(), "zzzzzz"); }),
                  "there are: atrium, atrium_lamps, cathedral, ");
}

TEST_F(SceneLibrary, NamesDoNotClimbOutOfTheFolders) {
  folder_.write("outside.glb", square(1));
  folder_.write("outside.json", R"({"source": {"generator": "sphere"}})");
  for (const char* name : {"../outside", "", ".", "..", "/etc/hostname"}) {
    EXPECT_EQ(find_scene(paths(), name).state, SceneState::unknown) << name;
    expect_contains(message_of([&] { load_scene(paths(), name); }), "no such scene");
  }
  folder_.write("scenes/x.json", R"({"source": {"gltf": "../outside"}})");
  expect_contains(message_of([&] { load_scene(paths(), "x"); }), "is in none of");
}

TEST_F(SceneLibrary, TheListHasEveryKindOfSceneOnceInOrder) {
  folder_.write("scenes/town.json", R"({"source": {"gltf": "town_model"}})");
  folder_.write("scenes/broken.json", "{");
  folder_.write("scenes/README.md", "not a scene");
  folder_.write("first/hall.glb", square(1));
  folder_.write("second/hall/hall.glb", square(1));
  std::vector<std::string> names;
  for (const SceneEntry& entry : list_scenes(paths())) {
    names.push_back(entry.name);
    if (entry.name == "broken") {
      EXPECT_EQ(entry.state, SceneState::unknown);
      expect_contains(entry.source, "not valid JSON");
    }
    if (entry.name == "hall") {
      EXPECT_EQ(entry.source, (folder_.path() / "first/hall.glb").string());
    }
    if (entry.name == "town") {
      EXPECT_EQ(entry.state, SceneState::source_missing);
    }
  }
  std::vector<std::string> expected{"broken", "hall", "town"};
  for (const procedural::Generator& generator : procedural::generators())
    expected.emplace_back(generator.name);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(names, expected);
}

TEST_F(SceneLibrary, TheDefaultPathsTakeTheProjectFirstAndThenTheEnvironment) {
  const char* before = std::getenv("HYBRAY_SCENE_PATH");
  const std::string kept = before ? before : "";
  setenv("HYBRAY_SCENE_PATH", "/somewhere::/else", 1);
  const ScenePaths found = default_scene_paths("/project");
  if (before)
    setenv("HYBRAY_SCENE_PATH", kept.c_str(), 1);
  else
    unsetenv("HYBRAY_SCENE_PATH");
  EXPECT_EQ(found.overlays, (std::vector<std::filesystem::path>{"/project/scenes"}));
  EXPECT_EQ(found.sources,
            (std::vector<std::filesystem::path>{"/project/scenes/external", "/somewhere", "/else"}));
}

// The scenes of the papers, which are not part of the project. Counts are those of the files' own
// documentation less their triangles of zero area (1 and 11: counted apart from this code, in exact
// arithmetic); bounding boxes are the documented ones.
struct ExternalScene {
  const char* name;
  size_t triangles;
  vec3 lower, upper;
  size_t cameras;
};

void PrintTo(const ExternalScene& scene, std::ostream* out) {
  *out << scene.name;
}

class ExternalScenes : public ::testing::TestWithParam<ExternalScene> {};

TEST_P(ExternalScenes, LoadWithTheirDocumentedTrianglesBoundsAndCameras) {
  const ExternalScene& expected = GetParam();
  const ScenePaths found = default_scene_paths(HYBRAY_PROJECT_DIR);
  const SceneEntry entry = find_scene(found, expected.name);
  ASSERT_NE(entry.state, SceneState::unknown) << "the overlay of " << expected.name << " is missing";
  if (entry.state == SceneState::source_missing) {
    const char* required = std::getenv("HYBRAY_REQUIRE_SCENES");
    if (required && std::string(required) == "1")
      FAIL() << expected.name << " is required, and its glTF was not found";
    GTEST_SKIP() << expected.name << " was not found: set HYBRAY_SCENE_PATH to the folder that has it";
  }
  const Scene scene = load_scene(found, expected.name);
  EXPECT_EQ(scene.triangle_count(), expected.triangles);
  const float tolerance = std::max(6e-4f, 1e-5f * scene.bounds.diagonal());
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(scene.bounds.lower[c], expected.lower[c], tolerance);
    EXPECT_NEAR(scene.bounds.upper[c], expected.upper[c], tolerance);
  }
  EXPECT_GE(scene.cameras.size(), expected.cameras);
  EXPECT_FALSE(scene.lights.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, ExternalScenes,
    ::testing::Values(ExternalScene{"sponza", 262267 - 1, vec3(-15.368f, -1.012f, -9.462f),
                                    vec3(14.399f, 11.436f, 8.843f), 4},
                      ExternalScene{"bistro", 1591928 - 11, vec3(-67.433f, -5.311f, -85.650f),
                                    vec3(30.351f, 27.406f, 47.868f), 4},
                      ExternalScene{"glass_table", 22766, vec3(-81.330f, 0.0f, -88.966f),
                                    vec3(117.606f, 60.0f, 59.754f), 1}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace hybray
