// Queries by box against brute force.
#include "core/caustics/box_tree.h"

#include "core/base/hash.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace hybray::caustics {
namespace {

constexpr uint64_t kSeed = 17;

Bounds3 random_box(uint64_t item, uint32_t stream, float size) {
  vec3 center, half;
  for (uint32_t c = 0; c < 3; ++c) {
    center[static_cast<int>(c)] = static_cast<float>(10.0 * random_unit(item, c, stream, kSeed));
    half[static_cast<int>(c)] = size * static_cast<float>(random_unit(item, 3 + c, stream, kSeed));
  }
  return {center - half, center + half};
}

// How often each item is visited.
std::vector<int> visits(const BoxTree& tree, const Bounds3& query, size_t items) {
  std::vector<int> count(items, 0);
  tree.visit(query, [&](size_t i) {
    ASSERT_LT(i, items);
    ++count[i];
  });
  return count;
}

TEST(BoxTree, VisitsEveryItemThatOverlapsOnceAndFewOthers) {
  for (const size_t items : {1u, 2u, 4u, 5u, 63u, 64u, 65u, 1000u, 4097u}) {
    // Neighbours in the order are neighbours in space: sorted along x.
    std::vector<Bounds3> boxes;
    for (size_t i = 0; i < items; ++i) boxes.push_back(random_box(i, 0, 0.3f));
    std::sort(boxes.begin(), boxes.end(),
              [](const Bounds3& a, const Bounds3& b) { return a.lower.x < b.lower.x; });
    const BoxTree tree(boxes);
    size_t visited = 0, overlapping = 0;
    for (uint64_t q = 0; q < 200; ++q) {
      const Bounds3 query = random_box(q, 1, 0.5f);
      const std::vector<int> count = visits(tree, query, items);
      for (size_t i = 0; i < items; ++i) {
        const bool apart = boxes[i].upper.x < query.lower.x || query.upper.x < boxes[i].lower.x ||
                           boxes[i].upper.y < query.lower.y || query.upper.y < boxes[i].lower.y ||
                           boxes[i].upper.z < query.lower.z || query.upper.z < boxes[i].lower.z;
        ASSERT_LE(count[i], 1);
        if (!apart) {
          ASSERT_EQ(count[i], 1) << "seed " << kSeed << " query " << q << " item " << i;
        }
        visited += static_cast<size_t>(count[i]);
        overlapping += !apart;
      }
    }
    if (items >= 1000) {
      EXPECT_GT(overlapping, 0u);
      EXPECT_LT(visited, 200 * items / 2) << "the tree must leave most of the items out";
    }
  }
}

TEST(BoxTree, BoxesThatTouchOverlap) {
  const std::vector<Bounds3> boxes = {{vec3(0.0f), vec3(1.0f)}};
  const BoxTree tree(boxes);
  EXPECT_EQ(visits(tree, {vec3(1.0f), vec3(2.0f)}, 1)[0], 1);
  EXPECT_EQ(visits(tree, {vec3(-1.0f), vec3(0.0f)}, 1)[0], 1);
  for (int c = 0; c < 3; ++c) {
    Bounds3 above{vec3(0.5f), vec3(2.0f)}, below{vec3(-1.0f), vec3(0.5f)};
    above.lower[c] = 1.001f, below.upper[c] = -0.001f;
    EXPECT_EQ(visits(tree, above, 1)[0], 0) << c;
    EXPECT_EQ(visits(tree, below, 1)[0], 0) << c;
  }
  EXPECT_EQ(visits(tree, {vec3(0.5f), vec3(0.5f)}, 1)[0], 1) << "a point";
}

TEST(BoxTree, EqualBoxesAreAllVisited) {
  const std::vector<Bounds3> boxes(1237, Bounds3{vec3(1.0f), vec3(1.0f)});
  const BoxTree tree(boxes);
  const std::vector<int> count = visits(tree, {vec3(0.0f), vec3(2.0f)}, boxes.size());
  EXPECT_EQ(std::count(count.begin(), count.end(), 1), 1237);
  tree.visit({vec3(1.1f), vec3(2.0f)}, [](size_t) { FAIL() << "nothing is there"; });
}

TEST(BoxTree, OfNothingVisitsNothing) {
  const Bounds3 everywhere{vec3(-1e30f), vec3(1e30f)};
  BoxTree().visit(everywhere, [](size_t) { FAIL(); });
  const BoxTree tree{std::span<const Bounds3>()};
  tree.visit(everywhere, [](size_t) { FAIL(); });
  EXPECT_TRUE(tree.root().empty());
}

TEST(BoxTree, TheRootEnclosesAllItems) {
  std::vector<Bounds3> boxes;
  Bounds3 all;
  for (uint64_t i = 0; i < 77; ++i) {
    boxes.push_back(random_box(i, 2, 1.0f));
    all.extend(boxes.back().lower), all.extend(boxes.back().upper);
  }
  const BoxTree tree(boxes);
  EXPECT_EQ(tree.root().lower, all.lower);
  EXPECT_EQ(tree.root().upper, all.upper);
}

}  // namespace
}  // namespace hybray::caustics
