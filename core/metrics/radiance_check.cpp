#include "core/metrics/radiance_check.h"

#include "core/base/error.h"
#include "core/base/parallel.h"

#include <vector>

#include <fmt/format.h>

namespace hybray::metrics {
namespace {

bool is_radiance(const vec3& v) {
  const float most = std::numeric_limits<float>::max();  // comparisons with NaN are false
  return v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f && v.x <= most && v.y <= most && v.z <= most;
}

}  // namespace

void require_radiance(const Image2D<vec3>& image, const std::string& name) {
  if (image.empty()) throw InputError(name, "the image has no pixels");
  const int w = image.width();
  std::vector<int> first_bad(static_cast<size_t>(image.height()), w);
  parallel_blocks(first_bad.size(), 16, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (int x = w - 1; x >= 0; --x)
        if (!is_radiance(image(x, static_cast<int>(y)))) first_bad[y] = x;
  });
  for (int y = 0; y < image.height(); ++y) {
    const int x = first_bad[static_cast<size_t>(y)];
    if (x == w) continue;
    const vec3& v = image(x, y);
    throw InputError(name,
                     fmt::format("pixel ({}, {}) is ({}, {}, {}); an error can only be computed from finite "
                                 "values that are not negative",
                                 x, y, v.x, v.y, v.z));
  }
}

void require_size(const Image2D<vec3>& image, const std::string& name, int width, int height,
                  const std::string& other) {
  if (image.width() == width && image.height() == height) return;
  throw InputError(name, fmt::format("it is {} x {} pixels, but {} is {} x {}", image.width(), image.height(),
                                     other, width, height));
}

}  // namespace hybray::metrics
