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

#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

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

struct OriginAndDirection {
  vec3 origin, direction;
};

template <class Packet>
void set_lane(Packet& p, int lane, const OriginAndDirection& ray) {
  p.ray.org_x[lane] = ray.origin.x, p.ray.org_y[lane] = ray.origin.y, p.ray.org_z[lane] = ray.origin.z;
  p.ray.dir_x[lane] = ray.direction.x, p.ray.dir_y[lane] = ray.direction.y;
  p.ray.dir_z[lane] = ray.direction.z;
}

// What the last query may have overwritten. A lane that meets nothing keeps it.
template <int N, class Packet>
void clear_hits(Packet& p, float t_far = kInfinity) {
  static_assert(RTC_INVALID_GEOMETRY_ID == kNoPrimitive);
  for (int lane = 0; lane < N; ++lane) {
    p.ray.tfar[lane] = t_far;
    p.hit.primID[lane] = kNoPrimitive, p.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    p.hit.u[lane] = p.hit.v[lane] = 0.0f;
  }
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

// The rays that trace_rays() is given and where their hits go: some that lie side by side, which packets copy
// as they are, ...
struct Neighbours {
  RayLanes rays;
  HitLanes hits;  // u and v may be null

  OriginAndDirection ray(size_t i) const {
    return {vec3(rays.ox[i], rays.oy[i], rays.oz[i]), vec3(rays.dx[i], rays.dy[i], rays.dz[i])};
  }
  void keep(size_t i, const Hit& hit) const {
    hits.t[i] = hit.t, hits.primitive[i] = hit.primitive;
    if (hits.u) hits.u[i] = hit.u, hits.v[i] = hit.v;
  }
  template <int N, class Packet>
  void fill(size_t first, Packet& p) const {
    const auto copy = [&](const float* from, float* to) { std::memcpy(to, from + first, N * sizeof(float)); };
    copy(rays.ox, p.ray.org_x), copy(rays.oy, p.ray.org_y), copy(rays.oz, p.ray.org_z);
    copy(rays.dx, p.ray.dir_x), copy(rays.dy, p.ray.dir_y), copy(rays.dz, p.ray.dir_z);
    clear_hits<N>(p);
  }
  template <int N, class Packet>
  void keep_all(size_t first, const Packet& p) const {
    const auto copy = [&](const auto* from, auto* to) { std::memcpy(to + first, from, N * sizeof(*to)); };
    copy(p.ray.tfar, hits.t), copy(p.hit.primID, hits.primitive);
    if (hits.u) copy(p.hit.u, hits.u), copy(p.hit.v, hits.v);
  }
};

// ... or some of a stream, listed by index.
struct Listed {
  const RayStream& rays;
  std::span<const uint32_t> which;
  HitStream& hits;

  OriginAndDirection ray(size_t j) const { return {rays.origin(which[j]), rays.direction(which[j])}; }
  void keep(size_t j, const Hit& hit) const {
    hits.t[which[j]] = hit.t, hits.primitive[which[j]] = hit.primitive;
  }
  template <int N, class Packet>
  void fill(size_t first, Packet& p) const {
    for (int lane = 0; lane < N; ++lane) set_lane(p, lane, ray(first + lane));
    clear_hits<N>(p);
  }
  template <int N, class Packet>
  void keep_all(size_t first, const Packet& p) const {
    for (int lane = 0; lane < N; ++lane) keep(first + lane, lane_hit(p, lane));
  }
};

// ... each from its own distance on.
struct ListedFrom : Listed {
  std::span<const float> near;

  float t_near(size_t j) const { return near[which[j]]; }
  template <int N, class Packet>
  void fill(size_t first, Packet& p) const {
    Listed::fill<N>(first, p);
    for (int lane = 0; lane < N; ++lane) p.ray.tnear[lane] = t_near(first + static_cast<size_t>(lane));
  }
};
template <class Rays>
constexpr bool kHasNear = std::is_same_v<Rays, ListedFrom>;

// Nearest hits of rays [begin, end), N neighbours at a time.
template <int N, class Rays>
void trace_packets(RTCScene scene, bool coherent, size_t begin, size_t end, const Rays& rays) {
  Query q(coherent);
  typename PacketType<N>::type packet{};
  prepare_packet<N>(packet, 0.0f);
  alignas(64) int valid[N];
  for (int& lane : valid) lane = -1;
  size_t first = begin;
  for (; first + N <= end; first += N) {
    rays.template fill<N>(first, packet);
    query(valid, scene, q, packet);
    rays.template keep_all<N>(first, packet);
  }
  if (first == end) return;
  const int count = static_cast<int>(end - first);
  for (int lane = 0; lane < N; ++lane) {
    // Lanes without a ray repeat the first, so that no number in the packet is left to chance.
    const size_t from = first + static_cast<size_t>(lane < count ? lane : 0);
    set_lane(packet, lane, rays.ray(from));
    if constexpr (kHasNear<Rays>) packet.ray.tnear[lane] = rays.t_near(from);
    valid[lane] = lane < count ? -1 : 0;
  }
  clear_hits<N>(packet);
  query(valid, scene, q, packet);
  for (int lane = 0; lane < count; ++lane) rays.keep(first + lane, lane_hit(packet, lane));
}

template <class Rays>
void trace_rays(RTCScene scene, TraceMode mode, size_t begin, size_t end, const Rays& rays) {
  const bool coherent = mode >= TraceMode::packet4_coherent;
  switch (mode) {
    case TraceMode::single: {
      Query q(false);
      RTCRayHit r = make_ray_hit(0.0f);
      for (size_t i = begin; i < end; ++i) {
        const OriginAndDirection ray = rays.ray(i);
        set_ray(r, ray.origin, ray.direction, kInfinity);
        if constexpr (kHasNear<Rays>) r.ray.tnear = rays.t_near(i);
        query(scene, q, r);
        rays.keep(i, ray_hit(r));
      }
      break;
    }
    case TraceMode::packet4:
    case TraceMode::packet4_coherent:
      trace_packets<4>(scene, coherent, begin, end, rays);
      break;
    case TraceMode::packet8:
    case TraceMode::packet8_coherent:
      trace_packets<8>(scene, coherent, begin, end, rays);
      break;
    case TraceMode::packet16:
    case TraceMode::packet16_coherent:
      trace_packets<16>(scene, coherent, begin, end, rays);
      break;
  }
}

}  // namespace hybray::embree
