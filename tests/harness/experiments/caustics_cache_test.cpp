// The numbers of `caustics` do not depend on what the cache has: nothing, a part, all, more, or rubbish.
#include "harness/cache/cache_entries.h"
#include "harness/cache/reference_cache.h"
#include "tests/harness/experiments/caustics_fixture.h"

#include <fstream>

namespace hybray {
namespace {

class CausticsCache : public test::CausticsFixture {
 protected:
  static constexpr int64_t kAll = 5;

  // A point that needs a reference of `batches` batches, in a workspace of its own.
  Row with_batches(int64_t batches, ReferenceCache* cache, double target = 0.0) {
    Workspace::Settings s = settings();
    s.cache = cache;
    Workspace workspace(s);
    Row row = run_in(workspace, {{"scene", text("mirror_and_floor")},
                                 {"camera", text("mirror")},
                                 {"reference_paths", 2e4},
                                 {"reference_batches", batches},
                                 {"reference_relmse_target", target}});
    counts_ = workspace.references();
    return row;
  }

  std::vector<std::filesystem::path> files() const {
    const std::vector<CacheEntry> entries = cache_entries(folder_ / "cache");
    EXPECT_EQ(entries.size(), 1u);
    return entries.empty() ? std::vector<std::filesystem::path>() : entries[0].parts;
  }

  void expect_counts(uint64_t computed, uint64_t continued, uint64_t reused, uint64_t made, uint64_t read) {
    EXPECT_EQ(counts_.computed, computed);
    EXPECT_EQ(counts_.continued, continued);
    EXPECT_EQ(counts_.reused, reused);
    EXPECT_EQ(counts_.batches_computed, made);
    EXPECT_EQ(counts_.batches_reused, read);
  }

  std::vector<std::string> warnings_;
  ReferenceCache cache_{{folder_ / "cache", ReferenceCache::kDefaultBytes,
                         [this](const std::string& text) { warnings_.push_back(text); },
                         [](const std::string&) {}}};
  ReferenceCounts counts_;
};

TEST_F(CausticsCache, MetricsAreTheSameToTheBitWhetherItIsEmptyPartialFullOrFuller) {
  const Row truth = with_batches(kAll, nullptr);
  expect_counts(1, 0, 0, kAll, 0);
  EXPECT_GT(number(truth, "reference_bias_relmse"), 0.0) << "mixed caustics take part";
  const Row few_truth = with_batches(2, nullptr);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache"));

  expect_same_metrics(few_truth, with_batches(2, &cache_));
  expect_counts(1, 0, 0, 2, 0);
  expect_same_metrics(truth, with_batches(kAll, &cache_));
  expect_counts(0, 1, 0, kAll - 2, 2);
  expect_same_metrics(truth, with_batches(kAll, &cache_));
  expect_counts(0, 0, 1, 0, kAll);
  expect_same_metrics(few_truth, with_batches(2, &cache_));
  expect_counts(0, 0, 1, 0, 2);
  // A hole in the middle is filled.
  std::filesystem::remove(files().at(2));
  expect_same_metrics(truth, with_batches(kAll, &cache_));
  expect_counts(0, 1, 0, 1, kAll - 1);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(CausticsCache, ADamagedOrTruncatedBatchIsMadeAgainWithAWarning) {
  const Row truth = with_batches(kAll, &cache_);
  const std::vector<std::filesystem::path> parts = files();
  ASSERT_EQ(parts.size(), static_cast<size_t>(kAll));
  std::string good = test::content_of(parts[1]), bad = good;
  bad[bad.size() / 2] ^= 0x40;
  std::ofstream(parts[1], std::ios::binary) << bad;
  std::filesystem::resize_file(parts[3], good.size() / 3);
  expect_same_metrics(truth, with_batches(kAll, &cache_));
  expect_counts(0, 1, 0, 2, kAll - 2);
  EXPECT_EQ(warnings_.size(), 2u);
  EXPECT_EQ(test::content_of(parts[1]), good) << "as it was, byte for byte";
  expect_same_metrics(truth, with_batches(kAll, &cache_));
  expect_counts(0, 0, 1, 0, kAll);
}

TEST_F(CausticsCache, ATargetIsMetByTheSmallestNumberOfBatchesHoweverManyThereAre) {
  std::vector<double> own;  // by number of batches
  for (int64_t n = 2; n <= kAll; ++n) own.push_back(number(with_batches(n, nullptr), "reference_relmse"));
  // A target that three batches meet and two do not, and one that none meets.
  ASSERT_LT(own[1], own[0]);
  const double target = 0.5 * (own[0] + own[1]);
  for (ReferenceCache* cache : {static_cast<ReferenceCache*>(nullptr), &cache_, &cache_}) {
    const Row row = with_batches(kAll, cache, target);
    EXPECT_EQ(integer(row, "reference_batches"), 3);
    EXPECT_EQ(number(row, "reference_relmse"), own[1]);
  }
  EXPECT_EQ(files().size(), 3u) << "no more than was asked for";
  const Row all = with_batches(kAll, &cache_, 1e-9);
  EXPECT_EQ(integer(all, "reference_batches"), kAll);
  EXPECT_EQ(number(all, "reference_relmse"), own.back());
  EXPECT_EQ(integer(with_batches(kAll, &cache_, target), "reference_batches"), 3) << "from a fuller cache";
}

TEST_F(CausticsCache, WhatCannotBeKeptChangesNothing) {
  const Row truth = with_batches(3, nullptr);
  folder_.write("cache", "a file where the folder should be");
  expect_same_metrics(truth, with_batches(3, &cache_));
  expect_counts(1, 0, 0, 3, 0);
  EXPECT_EQ(warnings_.size(), 1u);
}

}  // namespace
}  // namespace hybray
