// The list of photons in blocks: order, and memory that is used again.
#include "core/caustics/photon_blocks.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::caustics {
namespace {

std::vector<Photon> numbered(uint32_t first, uint32_t count) {
  std::vector<Photon> photons(count);
  for (uint32_t i = 0; i < count; ++i) photons[i].primitive = first + i;
  return photons;
}

std::vector<uint32_t> numbers_of(const PhotonBlocks& list) {
  std::vector<uint32_t> numbers;
  list.for_each([&](const Photon& photon) { numbers.push_back(photon.primitive); });
  return numbers;
}

TEST(PhotonBlocks, KeepTheOrderInWhichTheyWereAppendedAndLeaveOutEmptyBlocks) {
  PhotonBlocks list;
  EXPECT_TRUE(list.empty());
  list.append(numbered(0, 2));
  list.append(std::vector<Photon>());
  PhotonBlocks later(numbered(2, 1));
  later.append(numbered(3, 2));
  list.append_all(std::move(later));
  EXPECT_EQ(numbers_of(list), (std::vector<uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(list.size(), 5u);
  EXPECT_EQ(list.blocks().size(), 3u);
}

TEST(PhotonBlock, GrowsUnderWhatItHoldsAndCountsOnlyWhatWasAdded) {
  PhotonBlock block;
  for (uint32_t i = 0; i < 1000; ++i) {
    Photon* to = block.room(3);
    for (uint32_t k = 0; k < 3; ++k) to[k].primitive = 10 * i + k;
    block.add(i % 3);  // of which the rest is overwritten
  }
  std::vector<uint32_t> expected, held;
  for (uint32_t i = 0; i < 1000; ++i)
    for (uint32_t k = 0; k < i % 3; ++k) expected.push_back(10 * i + k);
  for (const Photon& photon : block) held.push_back(photon.primitive);
  EXPECT_EQ(held, expected);
  EXPECT_EQ(block.size(), expected.size());
}

TEST(PhotonBlocks, ClearingKeepsTheMemoryAndNothingElse) {
  PhotonBlocks list;
  list.append(numbered(0, 100));
  list.append(numbered(100, 7));
  const Photon* memory[2] = {list.blocks()[0].begin(), list.blocks()[1].begin()};
  list.clear();
  EXPECT_TRUE(list.empty());
  EXPECT_TRUE(list.blocks().empty());
  EXPECT_TRUE(numbers_of(list).empty());
  // Both blocks come back, in either order, without what was in them; then there is no more.
  PhotonBlock a = list.take_spare(), b = list.take_spare();
  EXPECT_TRUE(a.empty() && b.empty());
  if (a.begin() != memory[0]) std::swap(a, b);
  EXPECT_EQ(a.room(100), memory[0]);
  EXPECT_EQ(b.room(7), memory[1]);
  EXPECT_EQ(list.take_spare().begin(), nullptr);
}

TEST(PhotonBlocks, AListThatIsFilledAndClearedAgainAndAgainHoldsTheLastFillAlone) {
  PhotonBlocks list;
  for (uint32_t frame = 0; frame < 5; ++frame) {
    list.clear();
    std::vector<uint32_t> expected;
    for (uint32_t block = 0; block < 3 + frame % 2; ++block) {
      PhotonBlock photons = list.take_spare();
      for (const Photon& photon : numbered(100 * frame + 10 * block, 1 + block)) {
        *photons.room(1) = photon;
        photons.add(1);
        expected.push_back(photon.primitive);
      }
      list.append(std::move(photons));
    }
    EXPECT_EQ(numbers_of(list), expected) << frame;
    EXPECT_EQ(list.size(), expected.size());
  }
}

}  // namespace
}  // namespace hybray::caustics
