// An image that many threads add to at once and that comes out the same, bit for bit, in any order: 64-bit
// fixed point, three channels.
#pragma once

#include "core/base/image2d.h"
#include "core/base/vec.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace hybray::caustics {

class FixedPointImage {
 public:
  FixedPointImage() = default;
  // `largest` > 0: the greatest sum that a pixel can reach. The unit is largest / 2^61: sums up to
  // twice `largest` fit, for what its estimate may get wrong. Additions beyond are left out and counted.
  FixedPointImage(int width, int height, double largest);

  bool empty() const { return sums_.empty(); }
  int width() const { return width_; }
  int height() const { return height_; }

  // Adds a non-negative radiance. Safe from many threads.
  void add(size_t pixel, const dvec3& value) {
    for (int c = 0; c < 3; ++c) {
      const double scaled = value[c] * scale_;
      if (!(scaled >= 0.0 && scaled < kLimit)) {
        count_overflow();
        continue;
      }
      const auto units = static_cast<int64_t>(scaled + 0.5);
      const std::atomic_ref<int64_t> sum(sums_[3 * pixel + static_cast<size_t>(c)]);
      if (sum.fetch_add(units, std::memory_order_relaxed) > static_cast<int64_t>(kLimit) - units) {
        sum.fetch_sub(units, std::memory_order_relaxed);  // or further additions would wrap
        count_overflow();
      }
    }
  }

  // The sums, times `factor`.
  Image2D<vec3> image(double factor = 1.0) const;
  // Greatest sum / what the accumulator can hold, [0, 1].
  double peak_fraction() const;
  // Additions that were not finite and non-negative, or did not fit: any makes the image wrong.
  uint64_t overflows() const { return overflows_; }

 private:
  static constexpr double kLimit = 0x1p62;

  void count_overflow() { std::atomic_ref<uint64_t>(overflows_).fetch_add(1, std::memory_order_relaxed); }

  int width_ = 0, height_ = 0;
  double scale_ = 1.0;
  std::vector<int64_t> sums_;
  uint64_t overflows_ = 0;
};

}  // namespace hybray::caustics
