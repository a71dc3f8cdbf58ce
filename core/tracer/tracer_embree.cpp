#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/tracer/curve_geometry.h"
#include "core/tracer/cut_out_filter.h"
#include "core/tracer/embree_filter.h"
#include "core/tracer/embree_query.h"
#include "core/tracer/occlusion_query.h"
#include "core/tracer/tracer.h"
#include "core/tracer/user_geometry.h"

#include <atomic>

#include <fmt/format.h>

namespace hybray {

using embree::kAllMask;
using embree::Query;

namespace {

constexpr size_t kBlock = 1024;  // rays a task: long enough to hide scheduling, short enough to balance

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
  // All geometries of triangles read the same vertices. Embree reads each as 16 bytes: a shared buffer of
  // 12-byte vertices would be read past its end, so it gets a copy.
  void attach_triangles() {
    RTCGeometry whole = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(whole, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                std::max<size_t>(1, scene->positions.size())));
    uvec3* indices = new_indices(whole);
    check("allocate the geometry");
    std::copy_n(&scene->positions.data()->x, 3 * scene->positions.size(), vertices);
    std::copy_n(scene->triangles.data(), scene->triangles.size(), indices);

    // Triangles with cut-outs are a geometry of their own, so that the others meet no filter. Each keeps its
    // place in the list, and so its id: Embree leaves out a triangle whose vertices do not exist.
    size_t cut_outs = 0;
    for (uint32_t t = 0; t < scene->triangles.size(); ++t) cut_outs += scene->is_cut_out(t);
    if (cut_outs > 0) {
      RTCGeometry cut = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetSharedGeometryBuffer(cut, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0, sizeof(vec3),
                                 scene->positions.size());
      uvec3* cut_indices = new_indices(cut);
      check("allocate the geometry of cut-outs");
      constexpr uvec3 kNoTriangle(0xffffffffu);
      for (uint32_t t = 0; t < scene->triangles.size(); ++t) {
        cut_indices[t] = kNoTriangle;
        if (scene->is_cut_out(t)) std::swap(cut_indices[t], indices[t]);
      }
      embree::filter_cut_outs(cut, *scene);
      attach(cut);
    }
    attach(whole);
  }
  uvec3* new_indices(RTCGeometry geometry) const {
    return static_cast<uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       sizeof(uvec3), scene->triangles.size()));
  }
  void attach(RTCGeometry geometry) const {
    rtcSetGeometryMask(geometry, kAllMask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(rtc, geometry);
    rtcReleaseGeometry(geometry);
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
  rtcSetSceneFlags(impl_->rtc, static_cast<RTCSceneFlags>(
                                   (config.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                                   (config.layers ? embree::kQueryFilterFlag : RTC_SCENE_FLAG_NONE)));
  rtcSetSceneBuildQuality(impl_->rtc,
                          config.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);

  if (!scene.triangles.empty()) impl_->attach_triangles();
  if (!scene.analytic.empty()) embree::attach_analytic_surfaces(impl_->device, impl_->rtc, scene);
  if (!scene.curves.empty()) {
    embree::attach_curves(impl_->device, impl_->rtc, scene);
    impl_->check("allocate the curves");
  }
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
  RTCRayHit r = embree::make_ray_hit(t_near);
  embree::set_ray(r, origin, direction, t_far);
  embree::query(impl_->rtc, q, r);
  return embree::ray_hit(r);
}

bool Tracer::occluded(const vec3& origin, const vec3& direction, float t_near, float t_far) const {
  Query q(false);
  RTCRayHit r = embree::make_ray_hit(t_near);
  embree::set_ray(r, origin, direction, t_far);
  embree::query(impl_->rtc, q, r.ray);
  return r.ray.tfar < 0.0f;
}

void Tracer::intersect_batch(const RayLanes& rays, size_t count, const HitLanes& hits, TraceMode mode) const {
  embree::trace_rays(impl_->rtc, mode, 0, count, embree::Neighbours{rays, hits});
}

void Tracer::trace(const RayStream& rays, HitStream& hits, TraceMode mode) const {
  HYBRAY_CHECK_EQ(rays.size(), hits.size());
  const RayLanes all{rays.ox.data(), rays.oy.data(), rays.oz.data(),
                     rays.dx.data(), rays.dy.data(), rays.dz.data()};
  const HitLanes to{hits.t.data(), hits.primitive.data(), nullptr, nullptr};
  parallel_blocks(rays.size(), kBlock, [&](size_t begin, size_t end) {
    embree::trace_rays(impl_->rtc, mode, begin, end, embree::Neighbours{all, to});
  });
}

void Tracer::trace_some(const RayStream& rays, std::span<const uint32_t> which, HitStream& hits,
                        TraceMode mode, std::span<const float> t_near) const {
  HYBRAY_CHECK_EQ(rays.size(), hits.size());
  if (!t_near.empty()) HYBRAY_CHECK_EQ(rays.size(), t_near.size());
  parallel_blocks(which.size(), kBlock, [&](size_t begin, size_t end) {
    if (t_near.empty())
      embree::trace_rays(impl_->rtc, mode, begin, end, embree::Listed{rays, which, hits});
    else
      embree::trace_rays(impl_->rtc, mode, begin, end, embree::ListedFrom{{rays, which, hits}, t_near});
  });
}

void Tracer::occlude(const RayStream& rays, std::span<const float> lengths, std::vector<uint8_t>& occluded,
                     TraceMode mode) const {
  HYBRAY_CHECK_EQ(rays.size(), occluded.size());
  parallel_blocks(rays.size(), kBlock, [&](size_t begin, size_t end) {
    embree::occlude_rays(impl_->rtc, mode, begin, end, {rays, lengths, nullptr, occluded});
  });
}

void Tracer::occlude_some(const RayStream& rays, std::span<const float> lengths,
                          std::span<const uint32_t> which, std::vector<uint8_t>& occluded,
                          TraceMode mode) const {
  HYBRAY_CHECK_EQ(rays.size(), occluded.size());
  parallel_blocks(which.size(), kBlock, [&](size_t begin, size_t end) {
    embree::occlude_rays(impl_->rtc, mode, begin, end, {rays, lengths, which.data(), occluded});
  });
}

void Tracer::intersect_packet16(const vec3& origin, const vec3* directions, int count, float t_near,
                                float t_far, Hit* hits) const {
  Query q(true);
  RTCRayHit16 packet{};
  embree::prepare_packet<16>(packet, t_near);
  alignas(64) int valid[16];
  for (int lane = 0; lane < 16; ++lane) {
    valid[lane] = lane < count ? -1 : 0;
    embree::set_lane(packet, lane, {origin, directions[lane < count ? lane : 0]});
  }
  embree::clear_hits<16>(packet, t_far);
  embree::query(valid, impl_->rtc, q, packet);
  for (int lane = 0; lane < count; ++lane) hits[lane] = embree::lane_hit(packet, lane);
}

void Tracer::next_hits16(const vec3& origin, const vec3* directions, int count, const float* t_near,
                         float t_far, const PassedPrimitives* passed, Hit* hits) const {
  RTCRayHit16 packet{};
  embree::prepare_packet<16>(packet, 0.0f);
  alignas(64) int valid[16];
  for (int lane = 0; lane < 16; ++lane) {
    const int from = lane < count ? lane : 0;
    valid[lane] = lane < count ? -1 : 0;
    embree::set_lane(packet, lane, {origin, directions[from]});
    packet.ray.tnear[lane] = t_near[from];
    packet.ray.id[lane] = static_cast<unsigned>(from);
  }
  embree::clear_hits<16>(packet, t_far);
  embree::query_beyond(valid, impl_->rtc, passed, packet);
  for (int lane = 0; lane < count; ++lane) hits[lane] = embree::lane_hit(packet, lane);
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
