// Lists of rays that ask only whether something is in the way, handed to Embree one by one or in packets. As
// embree_query.h, for the sources of core/tracer alone.
#pragma once

#include "core/tracer/embree_query.h"

#include <algorithm>
#include <vector>

namespace hybray::embree {

#if HYBRAY_EMBREE_MAJOR >= 4
inline void query(const int* valid, RTCScene scene, Query& q, RTCRay4& r) {
  rtcOccluded4(valid, scene, &r, &q.occluded);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRay8& r) {
  rtcOccluded8(valid, scene, &r, &q.occluded);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRay16& r) {
  rtcOccluded16(valid, scene, &r, &q.occluded);
}
#else
inline void query(const int* valid, RTCScene scene, Query& q, RTCRay4& r) {
  rtcOccluded4(valid, scene, &q.context, &r);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRay8& r) {
  rtcOccluded8(valid, scene, &q.context, &r);
}
inline void query(const int* valid, RTCScene scene, Query& q, RTCRay16& r) {
  rtcOccluded16(valid, scene, &q.context, &r);
}
#endif

template <int N>
struct ShadowPacket;
template <>
struct ShadowPacket<4> {
  using type = RTCRay4;
};
template <>
struct ShadowPacket<8> {
  using type = RTCRay8;
};
template <>
struct ShadowPacket<16> {
  using type = RTCRay16;
};

// Some rays of a stream, or all of them where `which` is null.
struct OcclusionList {
  const RayStream& rays;
  std::span<const float> lengths;  // of all rays; empty: no end
  const uint32_t* which;
  std::vector<uint8_t>& occluded;

  size_t index(size_t j) const { return which ? which[j] : j; }
  float length(size_t i) const { return lengths.empty() ? kInfinity : lengths[i]; }
};

// Rays [begin, end) of the list, N neighbours at a time. Embree marks a ray that is occluded by tfar =
// -infinity.
template <int N>
void occlude_packets(RTCScene scene, bool coherent, size_t begin, size_t end, const OcclusionList& list) {
  Query q(coherent);
  typename ShadowPacket<N>::type p{};
  for (int lane = 0; lane < N; ++lane) p.mask[lane] = kAllMask;
  alignas(64) int valid[N];
  for (size_t first = begin; first < end; first += N) {
    const size_t count = std::min<size_t>(N, end - first);
    for (size_t lane = 0; lane < N; ++lane) {
      // Lanes without a ray repeat the first, so that no number in the packet is left to chance.
      const size_t i = list.index(first + (lane < count ? lane : 0));
      valid[lane] = lane < count ? -1 : 0;
      p.org_x[lane] = list.rays.ox[i], p.org_y[lane] = list.rays.oy[i], p.org_z[lane] = list.rays.oz[i];
      p.dir_x[lane] = list.rays.dx[i], p.dir_y[lane] = list.rays.dy[i], p.dir_z[lane] = list.rays.dz[i];
      p.tfar[lane] = list.length(i);
    }
    query(valid, scene, q, p);
    for (size_t lane = 0; lane < count; ++lane) list.occluded[list.index(first + lane)] = p.tfar[lane] < 0.0f;
  }
}

inline void occlude_one_by_one(RTCScene scene, size_t begin, size_t end, const OcclusionList& list) {
  Query q(false);
  RTCRayHit r = make_ray_hit(0.0f);
  for (size_t j = begin; j < end; ++j) {
    const size_t i = list.index(j);
    set_ray(r, list.rays.origin(i), list.rays.direction(i), list.length(i));
    query(scene, q, r.ray);
    list.occluded[i] = r.ray.tfar < 0.0f;
  }
}

inline void occlude_rays(RTCScene scene, TraceMode mode, size_t begin, size_t end,
                         const OcclusionList& list) {
  const bool coherent = mode >= TraceMode::packet4_coherent;
  switch (mode) {
    case TraceMode::single:
      return occlude_one_by_one(scene, begin, end, list);
    case TraceMode::packet4:
    case TraceMode::packet4_coherent:
      return occlude_packets<4>(scene, coherent, begin, end, list);
    case TraceMode::packet8:
    case TraceMode::packet8_coherent:
      return occlude_packets<8>(scene, coherent, begin, end, list);
    case TraceMode::packet16:
    case TraceMode::packet16_coherent:
      return occlude_packets<16>(scene, coherent, begin, end, list);
  }
}

}  // namespace hybray::embree
