// Sums over an image that do not depend on the number of threads: one set of doubles a row, merged in order.
#pragma once

#include "core/base/parallel.h"

#include <array>
#include <cstddef>
#include <vector>

namespace hybray::metrics {

// Sum over rows y in [0, height) of row(y), which returns std::array<double, N> and may run on any thread.
template <size_t N, class Row>
std::array<double, N> sum_rows(int height, const Row& row) {
  std::vector<std::array<double, N>> rows(static_cast<size_t>(height));
  parallel_blocks(rows.size(), 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) rows[y] = row(static_cast<int>(y));
  });
  std::array<double, N> sum{};
  for (const auto& one : rows)
    for (size_t i = 0; i < N; ++i) sum[i] += one[i];
  return sum;
}

}  // namespace hybray::metrics
