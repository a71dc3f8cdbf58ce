#include "core/ssrm/block_chances.h"

#include "core/base/parallel.h"

#include <atomic>

namespace hybray::ssrm {
namespace {

constexpr int kWeightBit = 40;

}  // namespace

void BlockChances::reset(int width, int height) {
  width_ = static_cast<float>(width), height_ = static_cast<float>(height);
  across_ = (width + kSide - 1) / kSide, down_ = (height + kSide - 1) / kSide;
  cells_.assign(row() * static_cast<size_t>(down_ + 2), 0);
  around_.assign(cells_.size(), kUnknown);
}

void BlockChances::add(int x, int y, uint32_t part, uint32_t weight) {
  const uint64_t one = (uint64_t{1} << kWeightBit) + part;
  std::atomic_ref(cells_[block(x / kSide, y / kSide)]).fetch_add(weight * one, std::memory_order_relaxed);
}

void BlockChances::spread() {
  constexpr uint64_t kParts = (uint64_t{1} << kWeightBit) - 1;
  parallel_blocks(static_cast<size_t>(down_), 32, [&](size_t begin, size_t end) {
    for (size_t by = begin; by < end; ++by)
      for (size_t at = block(0, static_cast<int>(by)), last = at + static_cast<size_t>(across_); at < last;
           ++at) {
        const auto across = [&](size_t i) { return cells_[i - 1] + 2 * cells_[i] + cells_[i + 1]; };
        const uint64_t sum = across(at - row()) + 2 * across(at) + across(at + row());
        if (const uint64_t weight = sum >> kWeightBit)
          around_[at] = static_cast<float>(sum & kParts) / static_cast<float>(kWhole * weight);
      }
  });
}

// A point at view depth w is eye + w r, r = forward + (x - cx) / f right + (y - cy) / f down, and 1 / w =
// (depth - a) / b. Seen from the other eye and divided by w: (eye - other eye) / w + r.
Reprojection::Reprojection(const View& from, const View& to) {
  const auto seen = [&](const dvec3& v) {
    const double z = glm::dot(v, to.forward());
    return vec3(dvec3(to.focal() * glm::dot(v, to.right()) + to.center().x * z,
                      to.focal() * glm::dot(v, to.down()) + to.center().y * z, z));
  };
  const dvec3 apart = (from.eye() - to.eye()) / from.depth_b();
  base_ = seen(from.ray_direction(0.0, 0.0) - from.depth_a() * apart);
  by_x_ = seen(from.right() / from.focal());
  by_y_ = seen(from.down() / from.focal());
  by_depth_ = seen(apart);
}

}  // namespace hybray::ssrm
