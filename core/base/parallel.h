// Parallel loops over blocks of an index range (oneTBB behind). Results must not depend on which thread runs
// a block.
#pragma once

#include <cstddef>
#include <functional>

namespace hybray {

// Calls body(begin, end) for consecutive blocks of at most `block` indices that together cover [0, count)
// once each. The blocks are the same at any thread count. Exceptions thrown by `body` reach the caller.
void parallel_blocks(size_t count, size_t block, const std::function<void(size_t, size_t)>& body);

// Threads that parallel_blocks may use at this moment (at least 1).
int thread_count();

// While it lives, parallel loops (Embree's builds included) use at most `threads` threads; 0 = all that the
// machine offers.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

}  // namespace hybray
