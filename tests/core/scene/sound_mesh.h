// A check that generated scenes have in common.
#pragma once

#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace hybray::test {

// All vertices are finite, and no triangle is a sliver: its height is more than a millionth of its length.
inline void expect_sound_triangles(const Scene& scene) {
  for (const vec3& p : scene.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
  for (const uvec3& tri : scene.triangles) {
    const dvec3 a(scene.positions[tri.x]), b(scene.positions[tri.y]), c(scene.positions[tri.z]);
    // Twice the area over the square of the longest edge.
    const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    ASSERT_GT(glm::length(glm::cross(b - a, c - a)), 1e-6 * longest * longest)
        << "at " << a.x << " " << a.y << " " << a.z;
  }
}

}  // namespace hybray::test
