// Boxes in float that hold what is known in double.
#pragma once

#include "core/base/vec.h"

#include <cmath>

namespace hybray {

// The box from `lower` to `upper`, each side moved outward to the next float but one at most.
inline Bounds3 enclosing_box(const dvec3& lower, const dvec3& upper) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Bounds3 box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::nextafter(static_cast<float>(lower[k]), -kInfinity);
    box.upper[k] = std::nextafter(static_cast<float>(upper[k]), kInfinity);
  }
  return box;
}

}  // namespace hybray
