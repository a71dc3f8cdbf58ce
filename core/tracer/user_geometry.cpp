#include "core/tracer/user_geometry.h"

namespace hybray::embree {
namespace {

const AnalyticSurface& surface_of(void* user, unsigned number) {
  return static_cast<const Scene*>(user)->analytic[number];
}

// First intersection inside the interval of ray `i`, of a packet of n.
std::optional<double> nearest_of(const AnalyticSurface& surface, RTCRayN* ray, unsigned n, unsigned i) {
  const dvec3 origin(RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i));
  const dvec3 direction(RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i));
  return nearest_hit(surface, origin, direction, RTCRayN_tnear(ray, n, i), RTCRayN_tfar(ray, n, i));
}

void write_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 box = bounds(surface_of(args->geometryUserPtr, args->primID));
  RTCBounds& b = *args->bounds_o;
  b.lower_x = box.lower.x, b.lower_y = box.lower.y, b.lower_z = box.lower.z;
  b.upper_x = box.upper.x, b.upper_y = box.upper.y, b.upper_z = box.upper.z;
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  const auto* scene = static_cast<const Scene*>(args->geometryUserPtr);
  const AnalyticSurface& surface = scene->analytic[args->primID];
  const unsigned n = args->N;
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* hit = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const std::optional<double> t = nearest_of(surface, ray, n, i);
    if (!t) continue;
    RTCRayN_tfar(ray, n, i) = static_cast<float>(*t);
    RTCHitN_u(hit, n, i) = 0.0f, RTCHitN_v(hit, n, i) = 0.0f;
    RTCHitN_primID(hit, n, i) = static_cast<unsigned>(scene->triangles.size()) + args->primID;
    RTCHitN_geomID(hit, n, i) = args->geomID;
  }
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  const AnalyticSurface& surface = surface_of(args->geometryUserPtr, args->primID);
  for (unsigned i = 0; i < args->N; ++i)
    if (args->valid[i] != 0 && nearest_of(surface, args->ray, args->N, i))
      RTCRayN_tfar(args->ray, args->N, i) = -kInfinity;
}

}  // namespace

void attach_analytic_surfaces(RTCDevice device, RTCScene rtc, const Scene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.analytic.size()));
  rtcSetGeometryUserData(geometry, const_cast<Scene*>(&scene));  // Embree hands it back and no more
  rtcSetGeometryBoundsFunction(geometry, write_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occluded);
  rtcSetGeometryMask(geometry, kAllMask);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(rtc, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace hybray::embree
