// A width x height array of values, row by row from the top left.
#pragma once

#include <cstddef>
#include <vector>

namespace hybray {

template <class T>
class Image2D {
 public:
  Image2D() = default;
  Image2D(int width, int height, const T& value = T{})
      : width_(width),
        height_(height),
        data_(static_cast<size_t>(width) * static_cast<size_t>(height), value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return data_.empty(); }
  size_t size() const { return data_.size(); }

  T& operator()(int x, int y) { return data_[index(x, y)]; }
  const T& operator()(int x, int y) const { return data_[index(x, y)]; }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }
  auto begin() { return data_.begin(); }
  auto end() { return data_.end(); }
  auto begin() const { return data_.begin(); }
  auto end() const { return data_.end(); }

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  int width_ = 0, height_ = 0;
  std::vector<T> data_;
};

}  // namespace hybray
