#include "core/ssrm/march_paper.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/ssrm/cell_walk.h"
#include "core/ssrm/march_lanes.h"

#include <atomic>

namespace hybray::ssrm {
namespace {

ScreenRay<double> promoted(const ScreenRay<float>& r) {
  return {r.ox, r.oy, r.oz, r.dx, r.dy, r.dz, r.l_end, r.end};
}

// Whether the ray is in front of the slanted bound of the walk's pixel, from the walk's L up to `leave`.
bool in_front_of_slant(const DepthView& view, const ScreenRay<float>& ray, const CellWalk<float>& walk,
                       float leave) {
  const vec2 d = view.derivatives(walk.px, walk.py);
  const float sign = static_cast<float>(view.depth_sign), gx = sign * d.x, gy = sign * d.y;
  // From the inverses, as the lanes have them.
  const float dx = 1.0f / walk.x.inverse, dy = 1.0f / walk.y.inverse;
  const float across_x = gx * (ray.ox - (static_cast<float>(walk.px) + 0.5f));
  const float across_y = gy * (ray.oy - (static_cast<float>(walk.py) + 0.5f));
  const float offset = ray.oz - (*view.intercept)(walk.px, walk.py) - across_x - across_y;
  const float slope = ray.dz - gx * dx - gy * dy;
  return offset + walk.l * slope <= 0.0f && offset + leave * slope <= 0.0f;
}

}  // namespace

Correction march_paper_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                           const MarchOptions& options, uint64_t& steps, float* proved) {
  // Stage 1: initialisation, up to the exit of the origin pixel.
  const ivec2 origin(static_cast<int>(pixel % static_cast<uint32_t>(view.width())),
                     static_cast<int>(pixel / static_cast<uint32_t>(view.width())));
  CellWalk<float> walk(ray, view.width(), view.height(), origin.x, origin.y);
  const auto ended = [&](Verdict verdict, float l) -> Correction {
    if (proved) *proved = l;
    return {verdict, kNoPixel};
  };
  const auto first_exit = walk.exit(0);
  if (ray.l_end <= first_exit.l()) return ended(ray.end, ray.l_end);
  if (!walk.advance(first_exit)) return ended(Verdict::offscreen, walk.l);

  // Stage 2: march. A level up after an iteration without intersection, a level down to redo the cell where
  // there was one.
  const int top = view.pyramid.levels() - 1;
  const uint64_t last_step = options.step_budget ? steps + options.step_budget : ~uint64_t{0};
  for (int level = 0;;) {
    bool intersects = false;
    for (int sample = 0; sample < kSamplesPerIteration; ++sample) {
      if (steps == last_step) return ended(Verdict::budget, walk.l);
      ++steps;
      const auto exit = walk.exit(level);
      const bool ends = ray.l_end <= exit.l();
      const float leave = ends ? ray.l_end : exit.l();
      const float farthest = std::max(ray.rise(walk.l), ray.rise(leave));
      if (farthest > view.pyramid.at(level, walk.px >> level, walk.py >> level) - ray.oz &&
          !(level == 0 && view.intercept && in_front_of_slant(view, ray, walk, leave))) {
        intersects = true;
        break;
      }
      if (ends) return ended(ray.end, ray.l_end);
      if (!walk.advance(exit)) return ended(Verdict::offscreen, walk.l);
    }
    if (!intersects) {
      level = std::min(level + 1, top);
    } else if (level > 0) {
      walk.descend(level--);
    } else {
      break;
    }
  }

  // Stage 3: correction with slanted planes.
  if (proved) *proved = walk.l;
  if (!options.correct) return {Verdict::correction, kNoPixel};
  return correct(view, promoted(ray), {walk.px, walk.py}, walk.previous(), origin);
}

namespace {

// Marches rays ray_at(0) to ray_at(count - 1).
template <class RayAt>
void march_scalar(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                  size_t count, const RayAt& ray_at, const MarchOptions& options, MarchResults& results) {
  HYBRAY_CHECK_EQ(rays.size(), pixels.size());
  HYBRAY_CHECK_EQ(rays.size(), results.size());
  std::atomic<uint64_t> steps{0};
  parallel_blocks(count, 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t j = begin; j < end; ++j) {
      const size_t i = ray_at(j);
      const Correction c = march_paper_ray(view, rays.get<float>(i), pixels[i], options, mine,
                                           results.proved.empty() ? nullptr : &results.proved[i]);
      results.verdict[i] = c.verdict;
      results.pixel[i] = c.pixel;
    }
    steps += mine;
  });
  results.steps = steps;
}

}  // namespace

void march_paper(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                 const MarchOptions& options, MarchResults& results) {
  if (options.code == MarchCode::lanes) return march_paper_lanes(view, rays, pixels, options, results);
  march_scalar(
      view, rays, pixels, rays.size(), [](size_t j) { return j; }, options, results);
}

void march_paper_some(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                      std::span<const uint32_t> which, const MarchOptions& options, MarchResults& results) {
  if (options.code == MarchCode::lanes)
    return march_paper_lanes_some(view, rays, pixels, which, options, results);
  march_scalar(
      view, rays, pixels, which.size(), [&](size_t j) { return size_t{which[j]}; }, options, results);
}

}  // namespace hybray::ssrm
