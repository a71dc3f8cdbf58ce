// Queries that pass over some primitives, by a filter function that belongs to the query. Scenes that are
// asked this way must have kQueryFilterFlag.
#pragma once

#include "core/tracer/embree_query.h"

namespace hybray::embree {

#if HYBRAY_EMBREE_MAJOR >= 4
constexpr RTCSceneFlags kQueryFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
using QueryContext = RTCRayQueryContext;
#else
constexpr RTCSceneFlags kQueryFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
using QueryContext = RTCIntersectContext;
#endif

// Embree hands a query's context back to the filter: what the filter needs stands behind it.
struct PassingContext {
  QueryContext base;
  const PassedPrimitives* passed;  // of ray id 0, 1, ...
};

inline void reject_passed(const RTCFilterFunctionNArguments* args) {
  const auto* passed = reinterpret_cast<const PassingContext*>(args->context)->passed;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (passed[RTCRayN_id(args->ray, args->N, i)].has(RTCHitN_primID(args->hit, args->N, i)))
      args->valid[i] = 0;
  }
}

// As query() with coherent rays; a ray's id says which of `passed` is its own.
inline void query_beyond(const int* valid, RTCScene scene, const PassedPrimitives* passed,
                         RTCRayHit16& packet) {
  PassingContext context;
  context.passed = passed;
#if HYBRAY_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context.base);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags =
      static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_COHERENT | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
  arguments.context = &context.base;
  arguments.filter = reject_passed;
  rtcIntersect16(valid, scene, &packet, &arguments);
#else
  rtcInitIntersectContext(&context.base);
  context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.base.filter = reject_passed;
  rtcIntersect16(valid, scene, &context.base, &packet);
#endif
}

}  // namespace hybray::embree
