#include "harness/cache/reference_cache.h"

#include "harness/cache/cache_entries.h"
#include "tests/temporary_folder.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

namespace fs = std::filesystem;

class ReferenceCacheTest : public testing::Test {
 protected:
  ReferenceCache cache(uint64_t max_bytes = ReferenceCache::kDefaultBytes) {
    return ReferenceCache({folder_ / "cache", max_bytes,
                           [this](const std::string& text) { warnings_.push_back(text); },
                           [this](const std::string& text) { infos_.push_back(text); }});
  }
  fs::path file_of(const std::string& key, uint32_t part) {
    return part_file(entry_folder(folder_ / "cache", key), part);
  }
  // Lets the next use have a later time on any file system's clock.
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

  const test::TemporaryFolder folder_;
  std::vector<std::string> warnings_, infos_;
};

TEST_F(ReferenceCacheTest, GivesBackWhatWasSavedByKeyAndPart) {
  ReferenceCache c = cache();
  EXPECT_EQ(c.load("a", 0), std::nullopt);
  c.save("a", 0, "zero");
  c.save("a", 7, "seven");
  c.save("b", 0, "other");
  EXPECT_EQ(cache().load("a", 0), "zero");
  EXPECT_EQ(cache().load("a", 7), "seven");
  EXPECT_EQ(cache().load("b", 0), "other");
  EXPECT_EQ(cache().load("a", 1), std::nullopt);
  EXPECT_EQ(cache().load("c", 0), std::nullopt);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReferenceCacheTest, APartOfAnotherKeyUnderTheSameHashIsNotServed) {
  cache().save("b", 0, "of b");
  fs::create_directories(file_of("a", 0).parent_path());
  fs::copy_file(file_of("b", 0), file_of("a", 0));
  EXPECT_EQ(cache().load("a", 0), std::nullopt);
  cache().save("a", 0, "of a");
  EXPECT_EQ(cache().load("a", 0), "of a");
}

TEST_F(ReferenceCacheTest, ADamagedPartIsToldOfAndRemovedAndTheOthersStay) {
  cache().save("a", 0, "zero");
  cache().save("a", 1, "one");
  std::string bytes = test::content_of(file_of("a", 0));
  bytes.back() ^= 1;
  std::ofstream(file_of("a", 0), std::ios::binary) << bytes;
  ReferenceCache c = cache();
  EXPECT_EQ(c.load("a", 0), std::nullopt);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0], "the cached reference " + file_of("a", 0).string() +
                              " is damaged and will be made again: its checksum differs");
  EXPECT_EQ(c.load("a", 0), std::nullopt);
  EXPECT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(c.load("a", 1), "one");
}

TEST_F(ReferenceCacheTest, TheLeastRecentlyUsedEntriesGoFirst) {
  const std::string kilobyte(1000, 'x');
  ReferenceCache c = cache(3500);  // three parts with their headers
  for (const char* key : {"a", "b", "c"}) c.save(key, 0, kilobyte), pause();
  EXPECT_TRUE(c.load("a", 0));  // now b is the oldest
  pause();
  c.save("d", 0, kilobyte);
  EXPECT_FALSE(c.load("b", 0));
  for (const char* key : {"a", "c", "d"}) EXPECT_TRUE(c.load(key, 0)) << key;
  // An entry that grows pushes others out, not itself.
  pause();
  c.save("a", 1, kilobyte);
  pause();
  c.save("a", 2, kilobyte);
  for (uint32_t part : {0, 1, 2}) EXPECT_TRUE(c.load("a", part)) << part;
  uint64_t total = 0;
  for (const CacheEntry& entry : cache_entries(folder_ / "cache")) total += entry.bytes;
  EXPECT_LE(total, 3500u);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReferenceCacheTest, WhatIsLargerThanTheLimitIsNotKeptAndCostsNoOtherEntry) {
  ReferenceCache c = cache(3000);
  c.save("small", 0, "s");
  c.save("large", 0, std::string(2000, 'x'));
  c.save("large", 1, std::string(2000, 'x'));
  c.save("large", 2, std::string(2000, 'x'));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("3000 bytes are too few"), std::string::npos) << warnings_[0];
  EXPECT_TRUE(c.load("small", 0));
  EXPECT_TRUE(c.load("large", 0));
  EXPECT_FALSE(c.load("large", 1));
}

TEST_F(ReferenceCacheTest, ACacheOfNoBytesKeepsNothingAndSaysNothing) {
  ReferenceCache c = cache(0);
  c.lock("a");
  c.save("a", 0, "zero");
  EXPECT_FALSE(c.load("a", 0));
  EXPECT_FALSE(fs::exists(folder_ / "cache"));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ReferenceCacheTest, APlaceThatCannotBeWrittenIsToldOnce) {
  folder_.write("cache", "a file where the folder should be");
  ReferenceCache c = cache();
  for (uint32_t part = 0; part < 3; ++part) {
    const auto lock = c.lock("a");
    EXPECT_FALSE(c.load("a", part));
    c.save("a", part, "content");
  }
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("the run goes on without: "), std::string::npos) << warnings_[0];
}

TEST_F(ReferenceCacheTest, OneWhoMakesPartsKeepsTheOthersWaitingAndHisEntryFromBeingRemoved) {
  ReferenceCache c = cache();
  auto lock = c.lock("a");
  c.save("a", 0, "zero");
  ASSERT_EQ(cache_entries(folder_ / "cache").size(), 1u);
  EXPECT_FALSE(remove_entry(cache_entries(folder_ / "cache")[0]));
  std::atomic<bool> through{false};
  std::thread other([&] {
    ReferenceCache second = cache();
    const auto waited = second.lock("a");
    through = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(through);
  lock.reset();
  other.join();
  EXPECT_TRUE(through);
  EXPECT_EQ(infos_.size(), 1u) << "that it waits";
  EXPECT_TRUE(remove_entry(cache_entries(folder_ / "cache")[0]));
  EXPECT_TRUE(cache_entries(folder_ / "cache").empty());
}

TEST_F(ReferenceCacheTest, WhatAKilledProcessLeftIsRemovedByTheNextThatWorksOnTheEntry) {
  cache().save("a", 0, "zero");
  const fs::path left = file_of("a", 1).string() + ".123.tmp";
  std::ofstream(left) << "half";
  EXPECT_EQ(cache().load("a", 0), "zero");
  EXPECT_TRUE(fs::exists(left));
  cache().lock("a");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_EQ(cache().load("a", 0), "zero");
}

TEST_F(ReferenceCacheTest, RemovingEntriesTouchesNothingThatIsNotTheCaches) {
  cache().save("a", 0, "zero");
  const fs::path entry = entry_folder(folder_ / "cache", "a");
  std::ofstream(entry / "notes.txt") << "mine";
  fs::create_directories(folder_ / "cache/references/my pictures");
  const std::vector<CacheEntry> entries = cache_entries(folder_ / "cache", true);
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].key, "a");
  EXPECT_EQ(entries[0].parts.size(), 1u);
  EXPECT_FALSE(remove_entry(entries[0])) << "its folder stays";
  EXPECT_TRUE(fs::exists(entry / "notes.txt"));
  EXPECT_FALSE(fs::exists(file_of("a", 0)));
  EXPECT_TRUE(fs::exists(folder_ / "cache/references/my pictures"));
}

}  // namespace
}  // namespace hybray
