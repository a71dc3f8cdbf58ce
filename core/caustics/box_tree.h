// A binary tree of bounding boxes over items in a given order, for queries by box. Complete and implicit:
// node i has the children 2 i + 1 and 2 i + 2. Items that are neighbours in space should be neighbours in the
// order.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace hybray::caustics {

inline bool overlap(const Bounds3& a, const Bounds3& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Bounds3> items) : items_(items.size()) {
    const size_t leaves = std::bit_ceil(std::max<size_t>(1, (items_ + kLeaf - 1) / kLeaf));
    nodes_.resize(2 * leaves - 1);
    first_leaf_ = leaves - 1;
    for (size_t i = 0; i < items_; ++i) extend(nodes_[first_leaf_ + i / kLeaf], items[i]);
    for (size_t n = first_leaf_; n-- > 0;) {
      extend(nodes_[n], nodes_[2 * n + 1]);
      extend(nodes_[n], nodes_[2 * n + 2]);
    }
  }

  const Bounds3& root() const { return nodes_.front(); }
  size_t memory_bytes() const { return nodes_.size() * sizeof(Bounds3); }

  // Calls visit(item) for every item of each leaf whose box overlaps `query`: all that overlap it, and some
  // that do not.
  template <class Visit>
  void visit(const Bounds3& query, const Visit& visit) const {
    if (items_ == 0) return;
    std::array<size_t, 64> stack;
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const size_t n = stack[--depth];
      if (!overlap(nodes_[n], query)) continue;
      if (n >= first_leaf_) {
        const size_t first = (n - first_leaf_) * kLeaf, last = std::min(items_, first + kLeaf);
        for (size_t i = first; i < last; ++i) visit(i);
      } else {
        stack[depth++] = 2 * n + 2;
        stack[depth++] = 2 * n + 1;
      }
    }
  }

 private:
  static constexpr size_t kLeaf = 4;

  static void extend(Bounds3& box, const Bounds3& other) {
    box.lower = glm::min(box.lower, other.lower);
    box.upper = glm::max(box.upper, other.upper);
  }

  size_t items_ = 0, first_leaf_ = 0;
  std::vector<Bounds3> nodes_;
};

}  // namespace hybray::caustics
