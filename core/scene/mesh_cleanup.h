// Leaving out of a mesh what cannot be traced or is not used.
#pragma once

#include "core/scene/mesh.h"

namespace hybray {

// Cross product of two edges: normal to the triangle, twice its area long. In double from the float vertices.
dvec3 double_area_vector(const Mesh& mesh, const uvec3& triangle);

// Whether every position is finite.
bool all_finite(const Mesh& mesh);

// Leaves out triangles of zero area: those whose cross product is within the rounding error of double
// arithmetic, so that its direction means nothing. Returns how many.
size_t remove_zero_area(Mesh& mesh);

// Leaves out vertices that no triangle uses; the others keep their order.
void remove_unused_vertices(Mesh& mesh);

}  // namespace hybray
