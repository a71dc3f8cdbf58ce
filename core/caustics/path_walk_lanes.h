// One interaction of every path of a front with the triangle that its segment met, in as many lanes as the
// machine has. The scalar form of the same is PathWalk::meet; both give the same bits, on every instruction
// set.
#pragma once

#include "core/caustics/path_front.h"

#include <array>
#include <span>
#include <string>

namespace hybray::caustics {

struct WalkOptions;
struct WalkCounts;

// Indices of the paths that lanes leave to the scalar code.
struct LeftPaths {
  std::array<uint32_t, PathFront::kAllocated> index;
  size_t count = 0;
};

// Reads paths [0, from.count) with from.hits; appends what arrives at diffuse parts after a specular event to
// `arrivals` and the paths that go on to `to`, both in order. Paths whose segments met something else than a
// triangle, and those that a surface's shading normal does not refract plainly, are only listed, in `left`.
void meet_triangles(const optics::OpticsTable& optics, const WalkOptions& options, const PathFront& from,
                    PathFront& to, Arrivals& arrivals, LeftPaths& left, WalkCounts& counts);

}  // namespace hybray::caustics
