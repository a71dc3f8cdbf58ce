// The only file that knows Embree. Written for its versions 3 and 4, whose query calls differ in shape alone;
// masks and query flags are always set explicitly, because their defaults differ between the two.
#include "core/tracer/tracer.h"

#include <atomic>
#if HYBRAY_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/parallel.h"

#include <fmt/format.h>

namespace hybray {
namespace {

constexpr size_t kBlock = 1024;  // rays a task: long enough to hide scheduling, short enough to balance
constexpr unsigned kAllMask = 0xffffffffu;

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
void query(RTCScene scene, Query& q, RTCRayHit& r) {
  rtcIntersect1(scene, &r, &q.intersect);
}
void query(RTCScene scene, Query& q, RTCRay& r) {
  rtcOccluded1(scene, &r, &q.occluded);
}
void query(const int* valid, RTCScene scene, Query& q, RTCRayHit4& r) {
  rtcIntersect4(valid, scene, &r, &q.intersect);
}
void query(const int* valid, RTCScene scene, Query& q, RTCRayHit8& r) {
  rtcIntersect8(valid, scene, &r, &q.intersect);
}
void query(const int* valid, RTCScene scene, Query& q, RTCRayHit16& r) {
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
void query(RTCScene scene, Query& q, RTCRayHit& r) {
  rtcIntersect1(scene, &q.context, &r);
}
void query(RTCScene scene, Query& q, RTCRay& r) {
  rtcOccluded1(scene, &q.context, &r);
}
void query(const int* valid, RTCScene scene, Query& q, RTCRayHit4& r) {
  rtcIntersect4(valid, scene, &q.context, &r);
}
void query(const int* valid, RTCScene scene, Query& q, RTCRayHit8& r) {
  rtcIntersect8(valid, scene, &q.context, &r);
}
void query(const int* valid, RTCScene scene, Query& q, RTCRayHit16& r) {
  rtcIntersect16(valid, scene, &q.context, &r);
}
#endif

RTCRay make_ray(const vec3& origin, const vec3& direction, float t_near, float t_far) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = t_near, ray.tfar = t_far;
  ray.mask = kAllMask;
  return ray;
}

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

template <class Packet>
void set_lane(Packet& p, int lane, const vec3& o, const vec3& d) {
  p.ray.org_x[lane] = o.x, p.ray.org_y[lane] = o.y, p.ray.org_z[lane] = o.z;
  p.ray.dir_x[lane] = d.x, p.ray.dir_y[lane] = d.y, p.ray.dir_z[lane] = d.z;
  p.ray.tnear[lane] = 0.0f, p.ray.tfar[lane] = std::numeric_limits<float>::infinity();
  p.ray.time[lane] = 0.0f, p.ray.mask[lane] = kAllMask, p.ray.flags[lane] = 0, p.ray.id[lane] = 0;
  p.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  p.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

// Rays [begin, end) of the list `which` (of all rays in order, where it is empty), N at a time.
template <int N>
void trace_packets(RTCScene scene, const RayStream& rays, std::span<const uint32_t> which, bool coherent,
                   size_t begin, size_t end, HitStream& hits) {
  Query q(coherent);
  typename PacketType<N>::type packet{};
  alignas(64) int valid[N];
  for (size_t first = begin; first < end; first += N) {
    const int count = static_cast<int>(std::min<size_t>(N, end - first));
    const auto ray_of = [&](int lane) { return which.empty() ? first + lane : which[first + lane]; };
    for (int lane = 0; lane < N; ++lane) {
      valid[lane] = lane < count ? -1 : 0;
      const size_t i = ray_of(lane < count ? lane : 0);
      set_lane(packet, lane, rays.origin(i), rays.direction(i));
    }
    query(valid, scene, q, packet);
    for (int lane = 0; lane < count; ++lane) {
      const size_t i = ray_of(lane);
      const bool hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
      hits.t[i] = hit ? packet.ray.tfar[lane] : std::numeric_limits<float>::infinity();
      hits.primitive[i] = hit ? packet.hit.primID[lane] : kNoPrimitive;
    }
  }
}

}  // namespace

const char* label(TraceMode mode) {
  switch (mode) {
    case TraceMode::single:
      return "single";
    case TraceMode::packet4:
      return "packet4";
    case TraceMode::packet8:
      return "packet8";
    case TraceMode::packet16:
      return "packet16";
    case TraceMode::packet4_coherent:
      return "packet4_coherent";
    case TraceMode::packet8_coherent:
      return "packet8_coherent";
    case TraceMode::packet16_coherent:
      return "packet16_coherent";
  }
  return "unknown";
}

struct Tracer::Impl {
  const Scene* scene = nullptr;
  RTCDevice device = nullptr;
  RTCScene rtc = nullptr;
  std::atomic<ptrdiff_t> bytes{0};

  void check(const char* what) const {
    const RTCError code = rtcGetDeviceError(device);
    if (code != RTC_ERROR_NONE)
      throw RuntimeError(fmt::format("Embree could not {}: error {}{}", what, static_cast<int>(code),
                                     code == RTC_ERROR_OUT_OF_MEMORY ? " (out of memory)" : ""));
  }
  ~Impl() {
    if (rtc) rtcReleaseScene(rtc);
    if (device) rtcReleaseDevice(device);
  }
};

Tracer::Tracer(const Scene& scene, const Config& config) : impl_(std::make_unique<Impl>()) {
  impl_->scene = &scene;
  impl_->device = rtcNewDevice(nullptr);
  if (!impl_->device) impl_->check("create a device");
  rtcSetDeviceMemoryMonitorFunction(
      impl_->device,
      [](void* bytes, ssize_t change, bool) {
        static_cast<std::atomic<ptrdiff_t>*>(bytes)->fetch_add(change);
        return true;
      },
      &impl_->bytes);

  impl_->rtc = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->rtc, config.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(impl_->rtc,
                          config.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);

  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads each vertex as 16 bytes: a shared buffer of 12-byte vertices would be read past its end, so
  // it gets a copy.
  auto* vertices =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  sizeof(vec3), std::max<size_t>(1, scene.positions.size())));
  auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(uvec3), scene.triangles.size()));
  impl_->check("allocate the geometry");
  std::copy_n(&scene.positions.data()->x, 3 * scene.positions.size(), vertices);
  std::copy_n(&scene.triangles.data()->x, 3 * scene.triangles.size(), indices);
  rtcSetGeometryMask(geometry, kAllMask);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->rtc, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(impl_->rtc);
  impl_->check("build the acceleration structure");
}

Tracer::~Tracer() = default;

const Scene& Tracer::scene() const {
  return *impl_->scene;
}

size_t Tracer::memory_bytes() const {
  return static_cast<size_t>(std::max<ptrdiff_t>(0, impl_->bytes.load()));
}

Hit Tracer::intersect(const vec3& origin, const vec3& direction, float t_near, float t_far) const {
  Query q(false);
  RTCRayHit r{};
  r.ray = make_ray(origin, direction, t_near, t_far);
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  query(impl_->rtc, q, r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {r.ray.tfar, r.hit.primID, r.hit.u, r.hit.v};
}

bool Tracer::occluded(const vec3& origin, const vec3& direction, float t_near, float t_far) const {
  Query q(false);
  RTCRay ray = make_ray(origin, direction, t_near, t_far);
  query(impl_->rtc, q, ray);
  return ray.tfar < 0.0f;
}

void Tracer::trace(const RayStream& rays, HitStream& hits, TraceMode mode) const {
  HYBRAY_CHECK_EQ(rays.size(), hits.size());
  trace_blocks(rays, {}, rays.size(), hits, mode);
}

void Tracer::trace_some(const RayStream& rays, std::span<const uint32_t> which, HitStream& hits,
                        TraceMode mode) const {
  HYBRAY_CHECK_EQ(rays.size(), hits.size());
  trace_blocks(rays, which, which.size(), hits, mode);
}

void Tracer::trace_blocks(const RayStream& rays, std::span<const uint32_t> which, size_t count,
                          HitStream& hits, TraceMode mode) const {
  const bool coherent = mode >= TraceMode::packet4_coherent;
  parallel_blocks(count, kBlock, [&](size_t begin, size_t end) {
    switch (mode) {
      case TraceMode::single:
        for (size_t j = begin; j < end; ++j) {
          const size_t i = which.empty() ? j : which[j];
          const Hit hit = intersect(rays.origin(i), rays.direction(i));
          hits.t[i] = hit.t;
          hits.primitive[i] = hit.primitive;
        }
        break;
      case TraceMode::packet4:
      case TraceMode::packet4_coherent:
        trace_packets<4>(impl_->rtc, rays, which, coherent, begin, end, hits);
        break;
      case TraceMode::packet8:
      case TraceMode::packet8_coherent:
        trace_packets<8>(impl_->rtc, rays, which, coherent, begin, end, hits);
        break;
      case TraceMode::packet16:
      case TraceMode::packet16_coherent:
        trace_packets<16>(impl_->rtc, rays, which, coherent, begin, end, hits);
        break;
    }
  });
}

void Tracer::intersect_packet16(const vec3& origin, const vec3* directions, int count, float t_near,
                                float t_far, Hit* hits) const {
  Query q(true);
  RTCRayHit16 packet{};
  alignas(64) int valid[16];
  for (int lane = 0; lane < 16; ++lane) {
    valid[lane] = lane < count ? -1 : 0;
    set_lane(packet, lane, origin, directions[lane < count ? lane : 0]);
    packet.ray.tnear[lane] = t_near, packet.ray.tfar[lane] = t_far;
  }
  query(valid, impl_->rtc, q, packet);
  for (int lane = 0; lane < count; ++lane) {
    if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID)
      hits[lane] = {};
    else
      hits[lane] = {packet.ray.tfar[lane], packet.hit.primID[lane], packet.hit.u[lane], packet.hit.v[lane]};
  }
}

std::string embree_version() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (!device) return "unavailable";
  const auto part = [&](RTCDeviceProperty p) { return rtcGetDeviceProperty(device, p); };
  const bool native16 = part(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  const bool native8 = part(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
  std::string text =
      fmt::format("{}.{}.{} ({})", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                  part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH),
                  native16  ? "16-wide packets native"
                  : native8 ? "8-wide packets native"
                            : "4-wide packets native");
  rtcReleaseDevice(device);
  return text;
}

}  // namespace hybray
