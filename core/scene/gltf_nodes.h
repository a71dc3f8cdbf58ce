// The tree of glTF nodes, walked into a flat list with world transforms (glTF 2.0 specification, section 3.5,
// "Scenes and Nodes").
#pragma once

#include "core/base/vec.h"
#include "core/scene/gltf_accessor.h"

#include <vector>

namespace hybray {

struct PlacedNode {
  size_t node;      // into the model's nodes
  dmat4 transform;  // to world space
};

// The nodes of the default scene (the first if none is named; all roots if there are no scenes), parents
// before children, children in the file's order. Throws InputError for a node with two parents or on a cycle,
// a scene root that has a parent, and a transform that is not affine, beyond the range of float, or flattens
// space. Nodes scaled to nothing (all three scales zero: a way to hide them) are left out with all below.
std::vector<PlacedNode> placed_nodes(const GltfFile& file);

}  // namespace hybray
