// One line against one primitive, in double: for questions about a single candidate, where an acceleration
// structure would be no help.
#pragma once

#include "core/scene/scene.h"

#include <optional>

namespace hybray {

// Smallest t >= 0 at which o + t d meets the primitive, two-sided; nothing where it does not. Triangles by
// Moeller and Trumbore's test (1997) with edges widened by its own rounding, so that
// a line through an edge that two triangles share meets at least one of them. `d` need not have unit length.
std::optional<double> primitive_hit(const Scene& scene, uint32_t primitive, const dvec3& o, const dvec3& d);

}  // namespace hybray
