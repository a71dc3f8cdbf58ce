#include "core/ssrm/march_paper.h"

#include "core/ssrm/cell_walk.h"

namespace hybray::ssrm {
namespace {

ScreenRay<double> promoted(const ScreenRay<float>& r) {
  return {r.ox, r.oy, r.oz, r.dx, r.dy, r.dz, r.l_end, r.end};
}

}  // namespace

Correction march_paper_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                           const MarchOptions& options, uint64_t& steps) {
  // Stage 1: initialisation, up to the exit of the origin pixel.
  const ivec2 origin(static_cast<int>(pixel % static_cast<uint32_t>(view.width())),
                     static_cast<int>(pixel / static_cast<uint32_t>(view.width())));
  CellWalk<float> walk(ray, view.width(), view.height(), origin.x, origin.y);
  const auto first_exit = walk.exit(0);
  if (ray.l_end <= first_exit.l()) return {ray.end, kNoPixel, ray.l_end};
  if (!walk.advance(first_exit)) return {Verdict::offscreen, kNoPixel, walk.l};
  if (walk.beyond_screen()) return {ray.l_end <= 0.0f ? ray.end : Verdict::offscreen, kNoPixel, 0.0f};

  // Stage 2: march. A level up after an iteration without intersection, a level down to redo the cell where
  // there was one.
  const int top = view.pyramid.levels() - 1;
  const uint64_t last_step = options.step_budget ? steps + options.step_budget : ~uint64_t{0};
  for (int level = 0;;) {
    bool intersects = false;
    for (int sample = 0; sample < kSamplesPerIteration; ++sample) {
      if (steps == last_step) return {Verdict::budget, kNoPixel, walk.l};
      ++steps;
      const auto exit = walk.exit(level);
      const bool ends = ray.l_end <= exit.l();
      const float leave = ends ? ray.l_end : exit.l();
      const float farthest = std::max(ray.rise(walk.l), ray.rise(leave));
      if (farthest > view.pyramid.at(level, walk.px >> level, walk.py >> level) - ray.oz) {
        intersects = true;
        break;
      }
      if (ends) return {ray.end, kNoPixel, ray.l_end};
      if (!walk.advance(exit)) return {Verdict::offscreen, kNoPixel, walk.l};
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
  Correction c{Verdict::correction, static_cast<uint32_t>(walk.py * view.width() + walk.px)};
  if (options.correct) c = correct(view, promoted(ray), {walk.px, walk.py}, walk.previous(), origin);
  c.l = walk.l;
  return c;
}

}  // namespace hybray::ssrm
