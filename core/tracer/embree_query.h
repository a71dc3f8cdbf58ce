// How Embree is asked: its versions 3 and 4, whose query calls differ in shape alone, as one set of
// functions, and the loops that hand it rays one by one or in packets. Only the sources of core/tracer
// include this header: that folder is the one that knows Embree. Masks and query flags are always set
// explicitly, because their defaults differ between the two versions.
#pragma once

#include "core/tracer/tracer.h"

#if HYBRAY_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <limits>

namespace hybray::embree {

constexpr unsigned kAllMask = 0xffffffffu;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// One way of asking, whichever version answers.
#if HYBRAY_EMBREE_MAJOR >= 4
struct Query {
  explicit Query(bool coherent) {
    rtcInitIntersectArguments(&intersect);
    rtcInitOccludedArguments(&occluded);
    intersect.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    occluded.flags = intersect.flags;
  }
  RTCIntersectArguments intersect;
  RTCOccludedArguments occluded;
};
inline void query(RTCScene scene, Query& q, RTCRayHit& r) {
  rtcIntersect1(scene, &r, &q.intersect);
}
inline void query(RTCScene scene, Query& q, RTCRay& r) {
  rtcOccluded1(scene, &r, &q.occluded);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRayHit4& r) {
  rtcIntersect4(valid, scene, &r, &q.intersect);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRayHit8& r) {
  rtcIntersect8(valid, scene, &r, &q.intersect);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRayHit16& r) {
  rtcIntersect16(valid, scene, &r, &q.intersect);
}
#else
struct Query {
  explicit Query(bool coherent) {
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  RTCIntersectContext context;
};
inline void query(RTCScene scene, Query& q, RTCRayHit& r) {
  rtcIntersect1(scene, &q.context, &r);
}
inline void query(RTCScene scene, Query& q, RTCRay& r) {
  rtcOccluded1(scene, &q.context, &r);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRayHit4& r) {
  rtcIntersect4(valid, scene, &q.context, &r);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRayHit8& r) {
  rtcIntersect8(valid, scene, &q.context, &r);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRayHit16& r) {
  rtcIntersect16(valid, scene, &q.context, &r);
}
#endif

template <int N>
struct PacketType;
template <>
struct PacketType<4> {
  using type = RTCRayHit4;
};
template <>
struct PacketType<8> {
  using type = RTCRayHit8;
};
template <>
struct PacketType<16> {
  using type = RTCRayHit16;
};

// What no query changes, set once for all the rays that a packet will carry. Embree writes a hit's instance
// only as what it was before: none.
template <int N, class Packet>
void prepare_packet(Packet& p, float t_near) {
  for (int lane = 0; lane < N; ++lane) {
    p.ray.tnear[lane] = t_near;
    p.ray.time[lane] = 0.0f, p.ray.mask[lane] = kAllMask, p.ray.flags[lane] = 0, p.ray.id[lane] = 0;
    p.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

// What differs from ray to ray, and what the last query may have overwritten.
template <class Packet>
void set_lane(Packet& p, int lane, const vec3& o, const vec3& d, float t_far) {
  p.ray.org_x[lane] = o.x, p.ray.org_y[lane] = o.y, p.ray.org_z[lane] = o.z;
  p.ray.dir_x[lane] = d.x, p.ray.dir_y[lane] = d.y, p.ray.dir_z[lane] = d.z;
  p.ray.tfar[lane] = t_far;
  p.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
}

template <class Packet>
Hit lane_hit(const Packet& p, int lane) {
  if (p.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return {};
  return {p.ray.tfar[lane], p.hit.primID[lane], p.hit.u[lane], p.hit.v[lane]};
}

inline RTCRayHit make_ray_hit(float t_near) {
  RTCRayHit r{};
  r.ray.tnear = t_near, r.ray.mask = kAllMask;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

inline void set_ray(RTCRayHit& r, const vec3& o, const vec3& d, float t_far) {
  r.ray.org_x = o.x, r.ray.org_y = o.y, r.ray.org_z = o.z;
  r.ray.dir_x = d.x, r.ray.dir_y = d.y, r.ray.dir_z = d.z;
  r.ray.tfar = t_far;
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
}

inline Hit ray_hit(const RTCRayHit& r) {
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {r.ray.tfar, r.hit.primID, r.hit.u, r.hit.v};
}

struct OriginAndDirection {
  vec3 origin, direction;
};

// Nearest hits of rays [begin, end), N neighbours at a time: load(i) gives ray i as an OriginAndDirection,
// store(i, Hit) takes what it met.
template <int N, class Load, class Store>
void trace_packets(RTCScene scene, bool coherent, size_t begin, size_t end, const Load& load,
                   const Store& store) {
  Query q(coherent);
  typename PacketType<N>::type packet{};
  prepare_packet<N>(packet, 0.0f);
  alignas(64) int valid[N];
  for (int& lane : valid) lane = -1;
  size_t first = begin;
  for (; first + N <= end; first += N) {
    for (int lane = 0; lane < N; ++lane) {
      const OriginAndDirection ray = load(first + lane);
      set_lane(packet, lane, ray.origin, ray.direction, kInfinity);
    }
    query(valid, scene, q, packet);
    for (int lane = 0; lane < N; ++lane) store(first + lane, lane_hit(packet, lane));
  }
  if (first == end) return;
  const int count = static_cast<int>(end - first);
  for (int lane = 0; lane < N; ++lane) {
    // Lanes without a ray repeat the first, so that no number in the packet is left to chance.
    const OriginAndDirection ray = load(first + (lane < count ? lane : 0));
    set_lane(packet, lane, ray.origin, ray.direction, kInfinity);
    valid[lane] = lane < count ? -1 : 0;
  }
  query(valid, scene, q, packet);
  for (int lane = 0; lane < count; ++lane) store(first + lane, lane_hit(packet, lane));
}

template <class Load, class Store>
void trace_rays(RTCScene scene, TraceMode mode, size_t begin, size_t end, const Load& load,
                const Store& store) {
  const bool coherent = mode >= TraceMode::packet4_coherent;
  switch (mode) {
    case TraceMode::single: {
      Query q(false);
      RTCRayHit r = make_ray_hit(0.0f);
      for (size_t i = begin; i < end; ++i) {
        const OriginAndDirection ray = load(i);
        set_ray(r, ray.origin, ray.direction, kInfinity);
        query(scene, q, r);
        store(i, ray_hit(r));
      }
      break;
    }
    case TraceMode::packet4:
    case TraceMode::packet4_coherent:
      trace_packets<4>(scene, coherent, begin, end, load, store);
      break;
    case TraceMode::packet8:
    case TraceMode::packet8_coherent:
      trace_packets<8>(scene, coherent, begin, end, load, store);
      break;
    case TraceMode::packet16:
    case TraceMode::packet16_coherent:
      trace_packets<16>(scene, coherent, begin, end, load, store);
      break;
  }
}

}  // namespace hybray::embree
