#include "core/ssrm/slanted_bounds.h"

#include <limits>

namespace hybray::ssrm {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

}  // namespace

SlantedBounds::SlantedBounds(int width, int height)
    : depth(width, height, kNothing),
      slopes(width, height),
      pyramid(width, height),
      first_level(width, height) {}

void SlantedBounds::build() {
  pyramid.build(depth, slopes, 1, kNothing);
  first_level.build(depth, 1, kNothing, 1);
}

}  // namespace hybray::ssrm
