#include "core/metrics/image_batches.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/metrics/radiance_check.h"

namespace hybray::metrics {
namespace {

constexpr size_t kBlock = 4096;  // pixels

template <class Pixel>
void for_pixels(size_t count, const Pixel& pixel) {
  parallel_blocks(count, kBlock, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) pixel(i);
  });
}

void require_count(int64_t count, int64_t least) {
  if (count < least)
    throw InputError("batches",
                     "at least " + std::to_string(least) + " are needed, there are " + std::to_string(count));
}

}  // namespace

ImageBatches::ImageBatches(int width, int height) {
  if (width < 1 || height < 1) throw InputError("batches", "an image has at least one pixel");
  mean_ = Image2D<dvec3>(width, height);
  squares_ = Image2D<dvec3>(width, height);
}

void ImageBatches::add(const Image2D<vec3>& batch) {
  require_size(batch, "batch", width(), height(), "the first");
  require_radiance(batch, "batch");
  const double share = 1.0 / static_cast<double>(++count_);
  for_pixels(batch.size(), [&](size_t i) {
    const dvec3 x(batch[i]), before = x - mean_[i];
    mean_[i] += share * before;
    squares_[i] += before * (x - mean_[i]);
  });
}

void ImageBatches::merge(const ImageBatches& later) {
  if (later.width() != width() || later.height() != height())
    throw InputError("batches", "sets of images of different size cannot be merged");
  if (later.count_ == 0) return;
  const double n = static_cast<double>(count_ + later.count_);
  const double share = static_cast<double>(later.count_) / n;
  const double weight = static_cast<double>(count_) * share;
  for_pixels(mean_.size(), [&](size_t i) {
    const dvec3 apart = later.mean_[i] - mean_[i];
    mean_[i] += share * apart;
    squares_[i] += later.squares_[i] + weight * apart * apart;
  });
  count_ += later.count_;
}

Image2D<vec3> ImageBatches::mean() const {
  require_count(count_, 1);
  Image2D<vec3> image(width(), height());
  for_pixels(image.size(), [&](size_t i) { image[i] = vec3(mean_[i]); });
  return image;
}

Image2D<vec3> ImageBatches::variance_of_mean() const {
  require_count(count_, 2);
  const double n = static_cast<double>(count_), scale = 1.0 / (n * (n - 1.0));
  Image2D<vec3> image(width(), height());
  for_pixels(image.size(), [&](size_t i) { image[i] = vec3(scale * squares_[i]); });
  return image;
}

}  // namespace hybray::metrics
