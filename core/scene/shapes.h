// Simple tessellated shapes for scene overlays, all centred at the origin.
#pragma once

#include "core/scene/mesh.h"

#include <string>
#include <vector>

namespace hybray {

// Names for make_shape: "sphere" (radius 1), "box" (edges 1), "plane" (1 x 1 in XZ, facing +Y), "cylinder"
// (radius 1, height 1 along Y, with flat ends).
const std::vector<std::string>& shape_names();

// Tessellation where none is asked for: segments around a sphere or cylinder, cells along an edge of a box or
// plane.
int default_tessellation(const std::string& shape);

// One of the above: a sphere has `tessellation` segments around and half as many from pole to pole. At least
// 3 for the round ones, 1 else.
Mesh make_shape(const std::string& shape, int tessellation);

}  // namespace hybray
