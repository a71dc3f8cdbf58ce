// Vector and matrix types: GLM, right-handed, depth from zero to one, metres.
#pragma once

#ifndef GLM_FORCE_DEPTH_ZERO_TO_ONE
#error "GLM_FORCE_DEPTH_ZERO_TO_ONE must come from the build (core/CMakeLists.txt)"
#endif

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace hybray {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::mat3;
using glm::mat4;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// Axis-aligned bounding box in world space, metres. Empty until the first `extend`.
struct Bounds3 {
  vec3 lower{std::numeric_limits<float>::infinity()};
  vec3 upper{-std::numeric_limits<float>::infinity()};

  void extend(const vec3& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  // Grown on every side by `fraction` of the diagonal.
  Bounds3 enlarged(float fraction) const {
    return {lower - fraction * diagonal(), upper + fraction * diagonal()};
  }
  bool empty() const { return lower.x > upper.x; }
  vec3 center() const { return 0.5f * (lower + upper); }
  float diagonal() const { return empty() ? 0.0f : glm::length(upper - lower); }
};

}  // namespace hybray
