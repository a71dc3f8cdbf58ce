// The photons of many paths, block by block as they were traced, in an order that does not depend on threads;
// nothing is copied into one list.
#pragma once

#include "core/caustics/photon.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace hybray::caustics {

// Photons that are written in place: room first, then how many came.
class PhotonBlock {
 public:
  PhotonBlock() = default;
  PhotonBlock(std::vector<Photon> photons) : memory_(std::move(photons)), size_(memory_.size()) {}

  // Where the next photons go: space for so many, after those that are there. Until add() they do not count.
  Photon* room(size_t count) {
    if (memory_.size() < size_ + count) memory_.resize(std::max(size_ + count, 2 * memory_.size()));
    return memory_.data() + size_;
  }
  void add(size_t count) { size_ += count; }
  void clear() { size_ = 0; }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Photon* begin() const { return memory_.data(); }
  const Photon* end() const { return memory_.data() + size_; }

 private:
  std::vector<Photon> memory_;  // of which the first size_ count
  size_t size_ = 0;
};

class PhotonBlocks {
 public:
  PhotonBlocks() = default;
  PhotonBlocks(std::vector<Photon> photons) { append(std::move(photons)); }

  void append(PhotonBlock block) {
    size_ += block.size();
    if (!block.empty()) blocks_.push_back(std::move(block));
  }
  void append_all(PhotonBlocks&& later) {
    for (PhotonBlock& block : later.blocks_) append(std::move(block));
    later = {};
  }

  // Empties the list but keeps its memory, which take_spare() hands out again: fresh pages cost more than
  // what is written to them.
  void clear() {
    for (PhotonBlock& block : blocks_) {
      block.clear();
      spare_.push_back(std::move(block));
    }
    blocks_.clear();
    size_ = 0;
  }
  PhotonBlock take_spare() {
    if (spare_.empty()) return {};
    PhotonBlock block = std::move(spare_.back());
    spare_.pop_back();
    return block;
  }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const std::vector<PhotonBlock>& blocks() const { return blocks_; }

  // Calls visit(photon) for each, in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const PhotonBlock& block : blocks_)
      for (const Photon& photon : block) visit(photon);
  }

 private:
  std::vector<PhotonBlock> blocks_;  // none of them empty
  std::vector<PhotonBlock> spare_;   // empty, with memory
  size_t size_ = 0;
};

}  // namespace hybray::caustics
