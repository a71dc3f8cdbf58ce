#include "core/caustics/grouped_tree.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <tuple>

#include <tbb/parallel_sort.h>

namespace hybray::caustics {
namespace {

// Number of the object that a primitive belongs to; analytic surfaces follow the objects, and all curves
// together come last.
uint32_t object_of(const Scene& scene, uint32_t primitive) {
  if (scene.is_curve(primitive)) return static_cast<uint32_t>(scene.objects.size() + scene.analytic.size());
  if (!scene.is_triangle(primitive))
    return static_cast<uint32_t>(scene.objects.size() + (primitive - scene.triangles.size()));
  const auto next =
      std::upper_bound(scene.objects.begin(), scene.objects.end(), primitive,
                       [](uint32_t p, const SceneObject& object) { return p < object.first_triangle; });
  return static_cast<uint32_t>(next - scene.objects.begin()) - 1;
}

// 21 bits spread to every third.
uint64_t spread(uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

uint64_t morton_code(const vec3& p, const Bounds3& bounds) {
  const vec3 size = glm::max(bounds.upper - bounds.lower, vec3(1e-30f));
  const vec3 unit = glm::clamp((p - bounds.lower) / size, vec3(0.0f), vec3(1.0f));
  uint64_t code = 0;
  for (int c = 0; c < 3; ++c)
    code |= spread(static_cast<uint64_t>(static_cast<double>(unit[c]) * 0x1fffff)) << c;
  return code;
}

struct Key {
  uint32_t object, item;
  uint64_t code;
  bool operator<(const Key& o) const {
    return std::tie(object, code, item) < std::tie(o.object, o.code, o.item);
  }
};

}  // namespace

GroupedTree::GroupedTree(const Scene& scene, std::span<const Bounds3> boxes,
                         std::span<const uint32_t> primitives) {
  std::vector<Key> keys(boxes.size());
  parallel_blocks(keys.size(), 8192, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      keys[i] = {object_of(scene, primitives[i]), static_cast<uint32_t>(i),
                 morton_code(boxes[i].center(), scene.bounds)};
  });
  tbb::parallel_sort(keys.begin(), keys.end());
  order_.resize(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    order_[i] = keys[i].item;
    if (i == 0 || keys[i].object != keys[i - 1].object) first_.push_back(i);
  }
  below_.resize(first_.size());
  std::vector<Bounds3> roots(first_.size());
  parallel_blocks(first_.size(), 1, [&](size_t begin, size_t end) {
    for (size_t g = begin; g < end; ++g) {
      const size_t last = g + 1 < first_.size() ? first_[g + 1] : order_.size();
      std::vector<Bounds3> own;
      own.reserve(last - first_[g]);
      for (size_t i = first_[g]; i < last; ++i) own.push_back(boxes[order_[i]]);
      below_[g] = BoxTree(own);
      roots[g] = below_[g].root();
    }
  });
  above_ = BoxTree(roots);
}

size_t GroupedTree::memory_bytes() const {
  size_t bytes = order_.size() * sizeof(uint32_t) + above_.memory_bytes();
  for (const BoxTree& tree : below_) bytes += tree.memory_bytes();
  return bytes;
}

}  // namespace hybray::caustics
