// The two levels of the tree: every item in one group, and queries against brute force.
#include "core/caustics/grouped_tree.h"

#include "tests/core/caustics/caustic_scenes.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace hybray::caustics {
namespace {

constexpr uint64_t kSeed = 23;

// Four objects of 2, 8, 1 and 2 triangles and two spheres.
Scene scene_of_six() {
  Scene scene = test::empty_scene();
  test::add_floor(scene, 5.0f);
  test::add_rectangle(scene, vec3(-1.0f), vec3(2, 0, 0), vec3(0, 2, 0), 2);
  Mesh one;
  one.positions = {vec3(0.0f), vec3(1, 0, 0), vec3(0, 1, 0)};
  one.triangles = {uvec3(0, 1, 2)};
  append_mesh(scene, one, mat4(1.0f), 0, "one");
  test::add_rectangle(scene, vec3(-5.0f), vec3(0, 0, 10), vec3(0, 10, 0));
  append_analytic(scene, analytic_sphere("a", 0, dvec3(2.0), 1.0));
  append_analytic(scene, analytic_sphere("b", 0, dvec3(-2.0), 1.0));
  return scene;
}

uint32_t object_by_search(const Scene& scene, uint32_t primitive) {
  for (uint32_t o = 0; o < scene.objects.size(); ++o)
    if (primitive >= scene.objects[o].first_triangle &&
        primitive < scene.objects[o].first_triangle + scene.objects[o].triangle_count)
      return o;
  return 1000 + primitive;
}

struct Items {
  std::vector<Bounds3> boxes;
  std::vector<uint32_t> primitives;
};

Items random_items(const Scene& scene, size_t count, float size) {
  Items items;
  for (uint64_t i = 0; i < count; ++i) {
    vec3 p;
    for (uint32_t c = 0; c < 3; ++c)
      // Some lie beyond the scene's bounds.
      p[static_cast<int>(c)] = static_cast<float>(-6.0 + 12.0 * random_unit(i, c, 0, kSeed));
    const float half = size * static_cast<float>(random_unit(i, 3, 0, kSeed));
    items.boxes.push_back({p - half, p + half});
    items.primitives.push_back(static_cast<uint32_t>(random_bits(i, 4, 0, kSeed) % scene.primitive_count()));
  }
  return items;
}

TEST(GroupedTree, HasOneGroupForEachObjectThatHasItemsAndEveryItemOnce) {
  const Scene scene = scene_of_six();
  for (const size_t count : {0u, 1u, 3u, 500u, 20000u}) {
    const Items items = random_items(scene, count, 0.2f);
    std::set<uint32_t> objects;
    for (const uint32_t p : items.primitives) objects.insert(object_by_search(scene, p));
    const GroupedTree tree(scene, items.boxes, items.primitives);
    EXPECT_EQ(tree.groups(), objects.size());
    std::vector<int> visited(count, 0);
    tree.visit({vec3(-1e9f), vec3(1e9f)}, [&](size_t i) { ++visited[i]; });
    EXPECT_EQ(static_cast<size_t>(std::count(visited.begin(), visited.end(), 1)), count);
    EXPECT_GE(tree.memory_bytes(), count * sizeof(uint32_t));
  }
}

TEST(GroupedTree, FindsAllThatBruteForceFindsAndLittleElse) {
  const Scene scene = scene_of_six();
  const Items items = random_items(scene, 20000, 0.2f);
  const GroupedTree tree(scene, items.boxes, items.primitives);
  size_t visited = 0, overlapping = 0;
  for (uint64_t q = 0; q < 100; ++q) {
    vec3 p;
    for (uint32_t c = 0; c < 3; ++c)
      p[static_cast<int>(c)] = static_cast<float>(-6.0 + 12.0 * random_unit(q, 10 + c, 0, kSeed));
    const Bounds3 query{p - 0.3f, p + 0.3f};
    std::vector<int> count(items.boxes.size(), 0);
    tree.visit(query, [&](size_t i) { ++count[i]; });
    for (size_t i = 0; i < count.size(); ++i) {
      ASSERT_LE(count[i], 1);
      const Bounds3& b = items.boxes[i];
      bool apart = false;
      for (int c = 0; c < 3; ++c) apart |= b.upper[c] < query.lower[c] || query.upper[c] < b.lower[c];
      if (!apart) {
        ASSERT_EQ(count[i], 1) << "seed " << kSeed << " query " << q << " item " << i;
      }
      visited += static_cast<size_t>(count[i]);
      overlapping += !apart;
    }
  }
  EXPECT_GT(overlapping, 500u);
  // Along a Morton curve four neighbours fill a box not much larger than their own.
  EXPECT_LT(visited, 100 * items.boxes.size() / 50);
}

TEST(GroupedTree, TakesAllCurvesForOneObjectAfterTheAnalyticSurfaces) {
  Scene scene = scene_of_six();
  RoundCurve curve;
  for (size_t i = 0; i < 4; ++i) curve.control[i] = vec4(0.0f, static_cast<float>(i), 0.0f, 0.1f);
  for (int i = 0; i < 3; ++i) append_curve(scene, curve);
  const Bounds3 box{vec3(0.0f), vec3(0.1f)};
  const std::vector<Bounds3> boxes(4, box);
  const auto first = static_cast<uint32_t>(scene.first_curve());
  const std::vector<uint32_t> curves{first, first + 2, first + 1, first};
  EXPECT_EQ(GroupedTree(scene, boxes, curves).groups(), 1u);
  const std::vector<uint32_t> mixed{first, first - 1, first - 2, first + 1};
  EXPECT_EQ(GroupedTree(scene, boxes, mixed).groups(), 3u);
}

TEST(GroupedTree, TakesManyEqualBoxesAndAFlatScene) {
  Scene scene = test::empty_scene();
  test::add_floor(scene, 1.0f);
  const std::vector<Bounds3> boxes(3000, Bounds3{vec3(0.5f, 0.0f, 0.5f), vec3(0.5f, 0.0f, 0.5f)});
  const std::vector<uint32_t> primitives(3000, 1);
  const GroupedTree tree(scene, boxes, primitives);
  EXPECT_EQ(tree.groups(), 1u);
  std::set<size_t> found;
  tree.visit({vec3(0.5f, 0.0f, 0.5f), vec3(0.5f, 0.0f, 0.5f)}, [&](size_t i) { found.insert(i); });
  EXPECT_EQ(found.size(), 3000u);
  tree.visit({vec3(0.0f), vec3(0.4f)}, [](size_t) { FAIL() << "nothing is there"; });
}

}  // namespace
}  // namespace hybray::caustics
