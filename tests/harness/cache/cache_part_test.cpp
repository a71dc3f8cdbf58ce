#include "harness/cache/cache_part.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

const std::string kKey = "scene ball, 3 lamps";
const std::string kContent("radiance\0\n\xff and more", 19);

TEST(CachePart, WhatIsReadIsWhatWasWritten) {
  const test::TemporaryFolder folder;
  for (const std::string& content : {kContent, std::string(), std::string(1 << 20, '\0')}) {
    write_part(folder / "part", kKey, content);
    const CachePart part = read_part(folder / "part");
    EXPECT_EQ(part.state, PartState::good) << part.problem;
    EXPECT_EQ(part.key, kKey);
    EXPECT_EQ(part.content, content);
    EXPECT_EQ(std::filesystem::file_size(folder / "part"), part_file_bytes(kKey, content));
    EXPECT_EQ(read_part_key(folder / "part"), kKey);
  }
}

TEST(CachePart, AMissingFileIsNoDamage) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_part(folder / "part").state, PartState::missing);
  EXPECT_EQ(read_part_key(folder / "part"), std::nullopt);
}

TEST(CachePart, EveryFlippedBitIsNoticed) {
  const test::TemporaryFolder folder;
  write_part(folder / "part", kKey, kContent);
  const std::string good = test::content_of(folder / "part");
  for (size_t i = 0; i < good.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ (1 << bit));
      folder.write("part", bad);
      const CachePart part = read_part(folder / "part");
      EXPECT_EQ(part.state, PartState::damaged) << "byte " << i << " bit " << bit;
      EXPECT_NE(part.problem, "");
      EXPECT_EQ(part.content, "");
      read_part_key(folder / "part");  // must not throw or ask for absurd memory
    }
}

TEST(CachePart, EveryLengthButItsOwnIsNoticed) {
  const test::TemporaryFolder folder;
  write_part(folder / "part", kKey, kContent);
  const std::string good = test::content_of(folder / "part");
  for (size_t length = 0; length < good.size(); ++length) {
    folder.write("part", good.substr(0, length));
    EXPECT_EQ(read_part(folder / "part").state, PartState::damaged) << length;
  }
  folder.write("part", good + "x");
  EXPECT_EQ(read_part(folder / "part").state, PartState::damaged);
}

TEST(CachePart, AFolderInItsPlaceIsDamage) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_part(folder.path()).state, PartState::damaged);
}

TEST(CachePart, APlaceThatCannotBeWrittenIsAnErrorOfTheWork) {
  const test::TemporaryFolder folder;
  folder.write("file", "");
  EXPECT_THROW(write_part(folder / "file/part", kKey, kContent), RuntimeError);
}

}  // namespace
}  // namespace hybray
