#include "core/ssrm/remaining_segment.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybray::ssrm {
namespace {

float scale_of(const Bounds3& b) {
  float scale = 0.0f;
  for (int axis = 0; axis < 3; ++axis)
    scale = std::max({scale, std::abs(b.lower[axis]), std::abs(b.upper[axis])});
  return scale;
}

}  // namespace

float start_distance(const RayStream& rays, size_t i, const View& view, float proved, float bounds_scale) {
  const double t = distance_of(rays, i, view, proved);
  // Beyond 1 / k, where t turns negative, and at infinity nothing is said.
  if (!(t > 0.0) || !(t < 1e30)) return 0.0f;
  const double start = t * (1.0 - 0x1p-12) - 0x1p-17 * static_cast<double>(bounds_scale);
  return start > 0.0 ? std::nextafter(static_cast<float>(start), 0.0f) : 0.0f;
}

void centre_segments(const RayStream& rays, const View& view, const Bounds3& bounds,
                     const std::vector<float>& proved, std::span<const uint32_t> which,
                     std::vector<float>& t_near) {
  const float scale = scale_of(bounds);
  parallel_blocks(which.size(), 4096, [&](size_t begin, size_t end) {
    for (size_t j = begin; j < end; ++j)
      t_near[which[j]] = start_distance(rays, which[j], view, proved[which[j]], scale);
  });
}

bool answers_differ(float from_origin, float from_start) {
  return from_origin != from_start &&
         !(std::abs(from_origin - from_start) <= 0x1p-20f * std::min(from_origin, from_start));
}

void build_conservative(const GBuffer& gbuffer, const Scene& scene, ExactSegments& segments) {
  make_conservative_depth(gbuffer, scene, segments.depth);
  const float to_march = static_cast<float>(gbuffer.view.depth_sign());
  const float background = gbuffer.view.background_depth();
  const ConservativeDepth& depth = segments.depth;
  parallel_blocks(depth.nearest.size(), 65536, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const float flat = depth.nearest[i] != background ? to_march * depth.nearest[i]
                                                        : std::numeric_limits<float>::infinity();
      segments.bounds.set(i, flat, depth.intercept[i], to_march * gbuffer.depth_derivatives[i]);
    }
  });
  segments.bounds.build();
}

void exact_segments(const GBuffer& gbuffer, const Scene& scene, const RayStream& rays,
                    const ScreenRays& screen_rays, std::span<const uint32_t> which, MarchCode code,
                    ExactSegments& s) {
  s.clear.clear();
  for (const uint32_t i : which) {
    s.t_near[i] = 0.0f;
    s.misses[i] = 0;
    if (s.depth.origin_clear[rays.pixel[i]]) s.clear.push_back(i);
  }
  march_some(s.bounds.view(), screen_rays, rays.pixel, s.clear,
             {.code = code, .marcher = Marcher::plane, .correct = false}, s.results);
  centre_segments(rays, gbuffer.view, scene.bounds, s.results.proved, s.clear, s.t_near);
  for (const uint32_t i : s.clear) s.misses[i] = s.results.verdict[i] == Verdict::miss;
}

}  // namespace hybray::ssrm
