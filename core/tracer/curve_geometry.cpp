#include "core/tracer/curve_geometry.h"

#include <algorithm>

namespace hybray::embree {

void attach_curves(RTCDevice device, RTCScene rtc, const Scene& scene) {
  const size_t vertices = 4 * scene.curves.size(), first = scene.first_curve();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE);
  auto* controls = static_cast<vec4*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                              RTC_FORMAT_FLOAT4, sizeof(vec4), vertices));
  // Entries for the primitives before the first curve, so that ids need no translation: Embree leaves out a
  // curve whose control points do not exist.
  auto* starts = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), first + scene.curves.size()));
  if (controls && starts) {
    std::fill_n(starts, first, static_cast<unsigned>(vertices));
    for (size_t i = 0; i < scene.curves.size(); ++i) {
      starts[first + i] = static_cast<unsigned>(4 * i);
      std::copy_n(scene.curves[i].control.data(), 4, controls + 4 * i);
    }
    rtcSetGeometryMask(geometry, kAllMask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(rtc, geometry);
  }
  rtcReleaseGeometry(geometry);
}

}  // namespace hybray::embree
