#include "core/ssrm/compaction.h"

#include "core/base/parallel.h"

namespace hybray::ssrm {
namespace {

void compact(const MarchResults& results, bool hits, std::vector<uint32_t>& list) {
  constexpr size_t kBlock = 16384;
  const size_t n = results.size(), blocks = (n + kBlock - 1) / kBlock;
  const auto wanted = [&](size_t i) { return (results.verdict[i] == Verdict::hit) == hits; };
  std::vector<size_t> first(blocks + 1, 0);
  parallel_blocks(n, kBlock, [&](size_t begin, size_t end) {
    size_t count = 0;
    for (size_t i = begin; i < end; ++i) count += wanted(i);
    first[begin / kBlock + 1] = count;
  });
  for (size_t b = 0; b < blocks; ++b) first[b + 1] += first[b];
  list.resize(first[blocks]);
  parallel_blocks(n, kBlock, [&](size_t begin, size_t end) {
    uint32_t* out = list.data() + first[begin / kBlock];
    for (size_t i = begin; i < end; ++i)
      if (wanted(i)) *out++ = static_cast<uint32_t>(i);
  });
}

}  // namespace

void compact_unresolved(const MarchResults& results, std::vector<uint32_t>& list) {
  compact(results, false, list);
}

void compact_hits(const MarchResults& results, std::vector<uint32_t>& list) {
  compact(results, true, list);
}

}  // namespace hybray::ssrm
