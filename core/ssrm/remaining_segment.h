// What a march has proved to be empty, for the general tracer to skip: an unresolved ray starts there.
#pragma once

#include "core/gbuffer/conservative_depth.h"
#include "core/ssrm/march.h"
#include "core/ssrm/slanted_bounds.h"

#include <span>
#include <vector>

namespace hybray::ssrm {

// Distance, metres, at which ray `i` may start when L up to `proved` is empty: rounded toward the origin by
// more than the general tracer's own rounding. 0 where L has no finite distance.
float start_distance(const RayStream& rays, size_t i, const View& view, float proved, float bounds_scale);

// Start distances of the listed rays from MarchResults::proved, each at its ray's own place. What the march
// proved at pixel centres is taken for the truth: a surface between two centres can be skipped.
void centre_segments(const RayStream& rays, const View& view, const Bounds3& bounds,
                     const std::vector<float>& proved, std::span<const uint32_t> which,
                     std::vector<float>& t_near);

// Whether two distances of one ray, traced from its origin and from its start distance, are of different
// points: by more than 2^-20 of them. A packet orders boxes for all of its rays, so that start distances can
// decide which of two triangles answers at an edge that they share, and these round differently.
bool answers_differ(float from_origin, float from_start);

// What exact_segments() needs besides its input, kept between runs.
struct ExactSegments {
  ConservativeDepth depth;
  SlantedBounds bounds;         // the same for the march
  std::vector<uint32_t> clear;  // rays whose own pixel is clear
  MarchResults results;         // of those
  std::vector<float> t_near;    // of the listed rays; 0 where nothing is proved
  std::vector<uint8_t> misses;  // of the listed rays: 1 where nothing lies on the whole ray

  ExactSegments(const View& view, size_t rays) : bounds(view.width(), view.height()) {
    results.resize(rays);
    results.ask_proved();
    t_near.resize(rays);
    misses.resize(rays);
  }
};

// Builds the conservative depth of a view.
void build_conservative(const GBuffer& gbuffer, const Scene& scene, ExactSegments& segments);

// Marches the listed rays against the conservative depth: no ray is proved past a point where anything could
// be hit. A ray that leaves the scene's bounds that way is a certified miss.
void exact_segments(const GBuffer& gbuffer, const Scene& scene, const RayStream& rays,
                    const ScreenRays& screen_rays, std::span<const uint32_t> which, MarchCode code,
                    ExactSegments& segments);

}  // namespace hybray::ssrm
