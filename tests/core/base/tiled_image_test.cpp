#include "core/base/tiled_image.h"

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(TiledImage, ReadsWhatWasWrittenWhereItHasMemoryAndOneValueElsewhere) {
  std::mt19937 random(5);
  for (const auto& [width, height] : {std::pair{1, 1}, {8, 8}, {9, 17}, {100, 3}, {64, 65}}) {
    const int tiles_x = (width + 7) / 8, tiles_y = (height + 7) / 8;
    std::vector<uint8_t> tiles(static_cast<size_t>(tiles_x * tiles_y));
    for (uint8_t& tile : tiles) tile = random() % 2;
    TiledImage<int> image(width, height, tiles, -7);
    std::map<std::pair<int, int>, int> twin;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool marked = tiles[static_cast<size_t>(y / 8 * tiles_x + x / 8)] != 0;
        EXPECT_EQ(image.stored(x, y), marked);
        EXPECT_EQ(std::as_const(image)(x, y), -7);
        if (marked) image.at(x, y) = twin[{x, y}] = static_cast<int>(random());
      }
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto written = twin.find({x, y});
        EXPECT_EQ(std::as_const(image)(x, y), written == twin.end() ? -7 : written->second);
      }
  }
}

TEST(TiledImage, TakesMemoryForMarkedTilesAlone) {
  std::vector<uint8_t> tiles(64 * 64, 0);
  tiles[5] = tiles[4000] = 1;
  EXPECT_EQ(TiledImage<float>(512, 512, tiles).values().size(), 2u * 64u);
  EXPECT_EQ(TiledImage<float>(512, 512, {}).values().size(), 512u * 512u);
}

}  // namespace
}  // namespace hybray
