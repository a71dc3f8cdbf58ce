#include "core/tracer/cut_out_filter.h"

namespace hybray::embree {
namespace {

// Embree asks about up to N hits at once, one a ray of the packet; those that `valid` names are to be
// decided, and to clear an entry turns that hit down.
void keep_what_is_there(const RTCFilterFunctionNArguments* args) {
  const auto* scene = static_cast<const Scene*>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const CutOut shape = scene->materials[scene->triangle_material[RTCHitN_primID(args->hit, n, i)]].cut_out;
    if (!is_there(shape, RTCHitN_u(args->hit, n, i), RTCHitN_v(args->hit, n, i))) args->valid[i] = 0;
  }
}

}  // namespace

void filter_cut_outs(RTCGeometry geometry, const Scene& scene) {
  rtcSetGeometryUserData(geometry, const_cast<Scene*>(&scene));  // Embree hands it back and no more
  rtcSetGeometryIntersectFilterFunction(geometry, keep_what_is_there);
  rtcSetGeometryOccludedFilterFunction(geometry, keep_what_is_there);
}

}  // namespace hybray::embree
