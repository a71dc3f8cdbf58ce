#include "core/base/morton.h"

#include <cstdlib>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Morton, DeinterleavesBits) {
  for (uint32_t i = 0; i < 64; ++i) {
    int x = 0, y = 0;
    for (int bit = 0; bit < 3; ++bit) {
      x |= static_cast<int>(i >> (2 * bit) & 1) << bit;
      y |= static_cast<int>(i >> (2 * bit + 1) & 1) << bit;
    }
    EXPECT_EQ(morton_x(i), x);
    EXPECT_EQ(morton_y(i), y);
  }
}

TEST(Morton, EveryAlignedQuarterOfATileIsASquareBlock) {
  for (uint32_t first = 0; first < 64; first += 16) {
    std::set<std::pair<int, int>> blocks;
    for (uint32_t i = first; i < first + 16; ++i) blocks.emplace(morton_x(i) / 4, morton_y(i) / 4);
    EXPECT_EQ(blocks.size(), 1u);
  }
}

}  // namespace
}  // namespace hybray
