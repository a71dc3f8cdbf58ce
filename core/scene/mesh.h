// A triangle mesh: the unit that loaders and generators make, and that a Scene is assembled from.
#pragma once

#include "core/base/vec.h"

#include <vector>

namespace hybray {

struct Mesh {
  std::vector<vec3> positions;   // metres
  std::vector<vec3> normals;     // unit shading normals, one a position; empty: flat, from the triangles
  std::vector<uvec3> triangles;  // counter-clockwise seen from the front
};

}  // namespace hybray
