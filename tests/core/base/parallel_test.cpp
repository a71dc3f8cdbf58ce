#include "core/base/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(ParallelBlocks, CoversEveryIndexOnceInBlocksThatDoNotDependOnThreads) {
  for (int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    std::vector<std::atomic<int>> seen(1003);
    parallel_blocks(seen.size(), 10, [&](size_t begin, size_t end) {
      EXPECT_EQ(begin % 10, 0u);
      EXPECT_EQ(end, std::min<size_t>(begin + 10, 1003));
      for (size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const auto& n : seen) ASSERT_EQ(n, 1);
  }
}

TEST(ParallelBlocks, DoesNothingForAnEmptyRange) {
  parallel_blocks(0, 10, [](size_t, size_t) { FAIL(); });
}

TEST(ParallelBlocks, HandsExceptionsToTheCaller) {
  EXPECT_THROW(parallel_blocks(100, 1,
                               [](size_t begin, size_t) {
                                 if (begin == 57) throw std::runtime_error("57");
                               }),
               std::runtime_error);
}

TEST(ThreadLimit, BoundsTheThreadCountWhileItLives) {
  const int before = thread_count();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(thread_count(), 1);
  }
  EXPECT_EQ(thread_count(), before);
}

}  // namespace
}  // namespace hybray
