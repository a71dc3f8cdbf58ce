#include "core/truth/layer_visibility.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

namespace hybray::truth {
namespace {

constexpr int kPacket = 16;

// True hits that lie inside the view and have not met their surface yet, as seen from the eye.
struct Sights {
  size_t ray[kPacket];
  double depth[kPacket];  // of the true hit
  vec3 direction[kPacket];
  float t_near[kPacket];
  PassedPrimitives passed[kPacket];
  int count = 0;
};

void follow(const Tracer& tracer, const View& view, const HitStream& hits, int layers, Sights& sights,
            std::vector<uint8_t>& result) {
  for (int layer = 0; layer < layers && sights.count > 0; ++layer) {
    Hit met[kPacket];
    tracer.next_hits16(vec3(view.eye()), sights.direction, sights.count, sights.t_near,
                       std::numeric_limits<float>::infinity(), sights.passed, met);
    Sights next;
    for (int i = 0; i < sights.count; ++i) {
      const size_t ray = sights.ray[i];
      const bool same = met[i].primitive == hits.primitive[ray];
      if (!met[i].valid() || (same && tracer.scene().is_triangle(met[i].primitive)) ||
          met[i].t >= sights.depth[i] * (1.0 - kVisibilityTolerance)) {
        result[ray] = static_cast<uint8_t>(layer);
        continue;
      }
      if (tracer.scene().is_analytic(met[i].primitive)) continue;  // no layer lies behind it
      if (same) continue;  // the far side of a curve, which no layer holds
      const int n = next.count++;
      next.ray[n] = ray, next.depth[n] = sights.depth[i], next.direction[n] = sights.direction[i];
      next.t_near[n] = met[i].t * (1.0f - 0x1p-18f);
      next.passed[n] = sights.passed[i];
      if (layer + 1 < layers) next.passed[n].primitive[next.passed[n].count++] = met[i].primitive;
    }
    sights = next;
  }
}

}  // namespace

std::vector<uint8_t> layers_of_hits(const Tracer& tracer, const RayStream& rays, const HitStream& hits,
                                    const View& view, int layers) {
  HYBRAY_CHECK_LT(layers, PassedPrimitives::kMost + 1);
  std::vector<uint8_t> result(rays.size(), kNotSeen);
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    Sights sights;
    for (size_t i = begin; i < end; ++i) {
      if (hits.primitive[i] != kNoPrimitive) {
        const dvec3 point = dvec3(rays.origin(i)) + static_cast<double>(hits.t[i]) * dvec3(rays.direction(i));
        const double w = view.view_depth(point);
        if (w >= view.near() && w <= view.far()) {
          const dvec2 p = view.project(point);
          if (p.x >= 0.0 && p.x < view.width() && p.y >= 0.0 && p.y < view.height()) {
            const int n = sights.count++;
            sights.ray[n] = i, sights.depth[n] = w;
            sights.direction[n] = vec3((point - view.eye()) / w);
            sights.t_near[n] = static_cast<float>(view.near());
            sights.passed[n].count = 0;
          }
        }
      }
      if (sights.count == kPacket || (i + 1 == end && sights.count > 0)) {
        follow(tracer, view, hits, layers, sights, result);
        sights.count = 0;
      }
    }
  });
  return result;
}

}  // namespace hybray::truth
