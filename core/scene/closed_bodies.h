// Whether the surfaces of refracting media close. Light that enters a medium through an interface must leave
// it through one, or its index and absorption would follow the light for ever.
//
// An interface is a face of a solid transmitting material: it has its inner medium (ior, absorption) behind
// and its outer one before it. Any other face may state what lies before it by the outer medium of its
// material: the tiles of a pool under water. For every medium but empty space, the faces that have it behind
// them, and those that have it before them turned round, must form a closed oriented surface: every edge runs
// as often one way as the other. So several kinds of interfaces may meet along a line, as at the rim of the
// wine in a glass. Edges are matched by the exact positions of their vertices. Cracks are forgiven: open
// edges that run along one another, the other way, no further apart than 1/20 of their length. Models that
// were modelled by parts have such, where the parts follow one curve with different vertices; light that
// slips through them is as rare as the crack is narrow.
#pragma once

#include "core/scene/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace hybray {

// What is wrong with the surface of one medium at one object.
struct BodyFault {
  std::string object, material;
  float ior = 1.0f;       // of the medium
  size_t open_edges = 0;  // 0: closed, but its faces point inward
  vec3 place{0.0f};       // middle of an open edge, or a vertex of what is inside out
};

// All faults, in the order of the objects. A closed piece counts as inside out if it holds a negative volume
// and lies in the bounds of no other piece of the medium (in which it would be a bubble). Empty, and free of
// cost, for a scene without a solid transmitting material. Linear in the number of faces of interfaces.
std::vector<BodyFault> find_body_faults(const Scene& scene);

// Throws InputError, naming the scene, the first fault and the number of others.
void check_closed_bodies(const Scene& scene);

}  // namespace hybray
