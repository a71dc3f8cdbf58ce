// Random damage to a valid file: it must load or throw InputError, and never crash.
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/scene/gltf.h"
#include "tests/core/scene/gltf_sample.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr uint64_t kSeed = 20260722;
constexpr uint32_t kCases = 2000;

// A document with nodes, a camera, a light and material extensions, so that damage has much to hit.
std::string rich_document() {
  nlohmann::json d = sample_document("");
  d["nodes"] = nlohmann::json::parse(R"([
    {"mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8],
     "scale": [2, 2, 2], "children": [1, 2]},
    {"camera": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  d["cameras"] =
      nlohmann::json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}])");
  d["extensions"]["KHR_lights_punctual"]["lights"] = nlohmann::json::parse(
      R"([{"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}, "color": [1, 1, 1]}])");
  d["materials"][0]["extensions"] = nlohmann::json::parse(
      R"({"KHR_materials_ior": {"ior": 1.4}, "KHR_materials_emissive_strength": {"emissiveStrength": 3}})");
  d["extensionsUsed"] = {"KHR_lights_punctual"};
  return d.dump();
}

// One to four bytes set at random, or swapped for characters that JSON gives a meaning.
std::string damaged(std::string bytes, uint32_t number) {
  constexpr char kMeaning[] = "0123456789-.eE\"{}[],:";
  const auto pick = [&](uint32_t dimension, size_t n) {
    return static_cast<size_t>(random_unit(number, dimension, 0, kSeed) * static_cast<double>(n));
  };
  const size_t changes = 1 + pick(0, 4);
  for (uint32_t c = 0; c < changes; ++c) {
    const size_t where = pick(3 * c + 1, bytes.size());
    bytes[where] = pick(3 * c + 2, 2) == 0 ? static_cast<char>(pick(3 * c + 3, 256))
                                           : kMeaning[pick(3 * c + 3, sizeof kMeaning - 1)];
  }
  return bytes;
}

TEST(GltfFuzz, DamagedFilesLoadOrAreRefused) {
  const test::TemporaryFolder folder;
  const std::string good = glb(rich_document(), sample_buffer());
  ASSERT_EQ(load_gltf(folder.write("good.glb", good)).triangle_count(), 2u);
  std::printf("seed %llu, %u cases\n", static_cast<unsigned long long>(kSeed), kCases);
  uint32_t refused = 0;
  for (uint32_t number = 0; number < kCases; ++number) {
    const auto file = folder.write("damaged.glb", damaged(good, number));
    try {
      const Scene scene = load_gltf(file, 1000);
      for (const uvec3& tri : scene.triangles)
        ASSERT_LT(std::max({tri.x, tri.y, tri.z}), scene.positions.size()) << "case " << number;
    } catch (const InputError&) {
      ++refused;
    } catch (const std::exception& error) {
      FAIL() << "case " << number << " threw something else: " << error.what();
    }
  }
  EXPECT_GT(refused, kCases / 4) << "the damage hardly does anything";
  EXPECT_LT(refused, kCases) << "nothing loads any more";
}

}  // namespace
}  // namespace hybray
