// The two-level acceleration structure of the photon maps: below, the points of each object of the scene;
// above, the objects (caustics paper, "Mixed caustics").
#pragma once

#include "core/caustics/box_tree.h"
#include "core/scene/scene.h"

namespace hybray::caustics {

class GroupedTree {
 public:
  // Item i has the box boxes[i] and lies on primitive primitives[i] of the scene.
  GroupedTree(const Scene& scene, std::span<const Bounds3> boxes, std::span<const uint32_t> primitives);

  size_t groups() const { return below_.size(); }
  size_t memory_bytes() const;

  // Calls visit(i) for every item whose box may overlap `query`.
  template <class Visit>
  void visit(const Bounds3& query, const Visit& visit) const {
    above_.visit(query, [&](size_t group) {
      below_[group].visit(query, [&](size_t i) { visit(order_[first_[group] + i]); });
    });
  }

 private:
  std::vector<uint32_t> order_;  // items by object, along a Morton curve within it
  std::vector<size_t> first_;    // of each group in order_
  std::vector<BoxTree> below_;
  BoxTree above_;
};

}  // namespace hybray::caustics
