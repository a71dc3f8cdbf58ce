// Cut-outs as an Embree filter: a hit with a triangle counts only where its material's mask lets it.
#pragma once

#include "core/scene/scene.h"
#include "core/tracer/embree_query.h"

namespace hybray::embree {

// Lets hits with `geometry`, whose primitive ids are those of the triangles of `scene`, count only where
// is_there() says so: for nearest hits and occlusion, single rays and packets. `scene` must outlive it.
void filter_cut_outs(RTCGeometry geometry, const Scene& scene);

}  // namespace hybray::embree
