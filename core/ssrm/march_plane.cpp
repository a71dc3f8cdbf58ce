#include "core/ssrm/march_plane.h"

#include "core/ssrm/cell_walk.h"

namespace hybray::ssrm {
namespace {

ScreenRay<double> promoted(const ScreenRay<float>& r) {
  return {r.ox, r.oy, r.oz, r.dx, r.dy, r.dz, r.l_end, r.end};
}

bool crosses_border_above(int border, int level) {
  return ((border >> level) & 1) == 0;
}

}  // namespace

PixelCrossing pixel_crossing(const DepthView& view, const ScreenRay<double>& ray, int x, int y) {
  const auto [enter, leave] = pixel_span(view, ray, x, y);
  const PlaneGap gap = plane_gap(view, ray, x, y);
  const vec2 slope = view.derivatives(x, y);
  const double magnitude = std::abs(static_cast<double>(view.pyramid.at(0, x, y))) +
                           std::abs(static_cast<double>(slope.x)) + std::abs(static_cast<double>(slope.y));
  const double tolerance = kBufferRounding * magnitude;
  if (gap.at(enter) > tolerance) return PixelCrossing::behind;
  if (gap.at(leave) <= tolerance) return PixelCrossing::in_front;
  return gap.at(enter) > 0.0 ? PixelCrossing::behind : PixelCrossing::hit;
}

Correction continue_plane_ray(const DepthView& view, const ScreenRay<float>& ray, const PlaneMarch& from,
                              const MarchOptions& options, uint64_t& steps) {
  const SlantedPyramid& bounds = *view.slanted;
  const int top = bounds.levels() - 1;
  const uint64_t last_step = options.step_budget ? steps + options.step_budget - from.taken : ~uint64_t{0};
  CellWalk<float> walk(ray, view.width(), view.height(), from.x, from.y);
  walk.l = from.l;
  int level = 0, samples = from.samples;
  for (bool clear = from.clear;; clear = false) {
    if (!clear) {
      if (steps == last_step) return {Verdict::budget, kNoPixel, walk.l};
      ++steps;
    }
    const auto exit = walk.exit(level);
    const bool ends = ray.l_end <= exit.l();
    if (!clear && may_be_behind(bounds, level, walk.px, walk.py, ray, walk.l, ends ? ray.l_end : exit.l())) {
      if (level > 0) {
        walk.descend(level--);
        samples = 0;
        continue;
      }
      const auto here = static_cast<uint32_t>(walk.py * view.width() + walk.px);
      if (!options.correct) return {Verdict::correction, here, walk.l};
      const PixelCrossing crossing = pixel_crossing(view, promoted(ray), walk.px, walk.py);
      if (crossing == PixelCrossing::behind) return {Verdict::behind, kNoPixel, walk.l};
      if (crossing == PixelCrossing::hit) return {Verdict::hit, here, walk.l};
    }
    if (ends) return {ray.end, kNoPixel, ray.l_end};
    if (!walk.advance(exit)) return {Verdict::offscreen, kNoPixel, walk.l};
    bool up = false;
    if (options.ascent == Ascent::parent) {
      up = (exit.lx <= walk.l && crosses_border_above(exit.border_x, level)) ||
           (exit.ly <= walk.l && crosses_border_above(exit.border_y, level));
    } else if (++samples == kSamplesPerIteration) {
      up = true;
      samples = 0;
    }
    if (up) level = std::min(level + 1, top);
  }
}

Correction march_plane_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                           const MarchOptions& options, uint64_t& steps) {
  const int width = view.width();
  CellWalk<float> walk(ray, width, view.height(), static_cast<int>(pixel) % width,
                       static_cast<int>(pixel) / width);
  const auto first_exit = walk.exit(0);
  if (ray.l_end <= first_exit.l()) return {ray.end, kNoPixel, ray.l_end};
  if (!walk.advance(first_exit)) return {Verdict::offscreen, kNoPixel, walk.l};
  if (walk.beyond_screen()) return {ray.l_end <= 0.0f ? ray.end : Verdict::offscreen, kNoPixel, 0.0f};
  return continue_plane_ray(view, ray, {.x = walk.px, .y = walk.py, .l = walk.l}, options, steps);
}

}  // namespace hybray::ssrm
