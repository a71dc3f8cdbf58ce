// The photons of many paths, block by block as they were traced, in an order that does not depend on threads;
// nothing is copied into one list.
#pragma once

#include "core/caustics/photon.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace hybray::caustics {

class PhotonBlocks {
 public:
  PhotonBlocks() = default;
  PhotonBlocks(std::vector<Photon> photons) { append(std::move(photons)); }

  void append(std::vector<Photon> block) {
    size_ += block.size();
    if (!block.empty()) blocks_.push_back(std::move(block));
  }
  void append(PhotonBlocks&& later) {
    for (std::vector<Photon>& block : later.blocks_) append(std::move(block));
    later = {};
  }

  // Empties the list but keeps its memory, which take_spare() hands out again: fresh pages cost more than
  // what is written to them.
  void clear() {
    for (std::vector<Photon>& block : blocks_) {
      block.clear();
      spare_.push_back(std::move(block));
    }
    blocks_.clear();
    size_ = 0;
  }
  std::vector<Photon> take_spare() {
    if (spare_.empty()) return {};
    std::vector<Photon> block = std::move(spare_.back());
    spare_.pop_back();
    return block;
  }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::vector<std::vector<Photon>>& blocks() const { return blocks_; }

  // Calls visit(photon) for each, in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const std::vector<Photon>& block : blocks_)
      for (const Photon& photon : block) visit(photon);
  }

 private:
  std::vector<std::vector<Photon>> blocks_;  // none of them empty
  std::vector<std::vector<Photon>> spare_;   // empty, with memory
  size_t size_ = 0;
};

}  // namespace hybray::caustics
