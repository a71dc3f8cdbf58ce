#include "core/ssrm/march_hiz.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/ssrm/cell_walk.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hybray::ssrm {
namespace {

constexpr double kScreenBorder = 0.05;  // share of the screen's height over which confidence fades
constexpr int kNearOrigin = 2;          // pixels, both axes together, within which nothing is a hit

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double vignette(double x, double y, int width, int height) {
  const double u = x / width, v = y / height;
  const double border_u = std::min(kScreenBorder * height / width, 0.5), border_v = kScreenBorder;
  const auto fade = [](double border, double at) {
    return smoothstep(0.0, border, at) * (1.0 - smoothstep(1.0 - border, 1.0, at));
  };
  return fade(border_u, u) * fade(border_v, v);
}

}  // namespace

HizCandidate hiz_traverse(const DepthView& view, const ScreenRay<float>& ray, uint32_t origin,
                          const HizOptions& options, uint64_t& steps) {
  const auto width = static_cast<uint32_t>(view.width());
  CellWalk<float> walk(ray, view.width(), view.height(), static_cast<int>(origin % width),
                       static_cast<int>(origin / width));
  const auto first_exit = walk.exit(0);
  if (ray.l_end <= first_exit.l()) return {ray.end, kNoPixel, 0.0};
  if (!walk.advance(first_exit)) return {Verdict::offscreen, kNoPixel, 0.0};
  const int top = view.pyramid.levels() - 1;
  const uint64_t last_step = options.max_steps ? steps + options.max_steps : ~uint64_t{0};
  for (int level = 0;;) {
    if (steps == last_step) return {Verdict::budget, kNoPixel, 0.0};
    ++steps;
    const auto exit = walk.exit(level);
    const bool ends = ray.l_end <= exit.l();
    const float leave = ends ? ray.l_end : exit.l();
    const float surface = view.pyramid.at(level, walk.px >> level, walk.py >> level) - ray.oz;
    if (std::max(ray.rise(walk.l), ray.rise(leave)) <= surface) {
      if (ends) return {ray.end, kNoPixel, 0.0};
      if (!walk.advance(exit)) return {Verdict::offscreen, kNoPixel, 0.0};
      level = std::min(level + 1, top);
      continue;
    }
    // In front where it enters: on to the depth that the cell starts at.
    if (ray.rise(walk.l) < surface) walk.l = std::clamp(surface / ray.dz, walk.l, leave);
    if (level == 0)
      return {Verdict::hit, static_cast<uint32_t>(walk.py) * width + static_cast<uint32_t>(walk.px), walk.l};
    walk.descend(level--);
  }
}

double hiz_confidence(const GBuffer& gbuffer, const RayStream& world, size_t i, const ScreenRay<float>& ray,
                      const HizCandidate& candidate, double thickness) {
  const View& camera = gbuffer.view;
  const auto width = static_cast<uint32_t>(camera.width());
  const auto apart = [](uint32_t a, uint32_t b) { return a > b ? a - b : b - a; };
  const uint32_t own = world.pixel[i], pixel = candidate.pixel;
  if (apart(own % width, pixel % width) + apart(own / width, pixel / width) <= kNearOrigin) return 0.0;
  if (glm::dot(dvec3(gbuffer.geometric_normal[pixel]), dvec3(world.direction(i))) > 0.0) return 0.0;
  const double x = ray.ox + candidate.l * ray.dx, y = ray.oy + candidate.l * ray.dy;
  const double t = distance_of(world, i, camera, candidate.l);
  const dvec3 hit = dvec3(world.origin(i)) + t * dvec3(world.direction(i));
  const dvec3 surface =
      camera.eye() + camera.view_depth_of(gbuffer.depth[pixel]) * camera.ray_direction(x, y);
  const double within = 1.0 - smoothstep(0.0, thickness, glm::length(surface - hit));
  return vignette(x, y, camera.width(), camera.height()) * within * within;
}

void march_hiz(const DepthView& view, const GBuffer& gbuffer, const RayStream& world, const ScreenRays& rays,
               const HizOptions& options, MarchResults& results) {
  HYBRAY_CHECK_EQ(rays.size(), world.size());
  HYBRAY_CHECK_EQ(rays.size(), results.size());
  HYBRAY_CHECK(options.thickness > 0.0 && !gbuffer.geometric_normal.empty());
  results.distance.assign(rays.size(), kNoDistance);
  std::atomic<uint64_t> steps{0};
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i) {
      const auto ray = rays.get<float>(i);
      HizCandidate found = hiz_traverse(view, ray, world.pixel[i], options, mine);
      if (found.verdict == Verdict::hit &&
          hiz_confidence(gbuffer, world, i, ray, found, options.thickness) < options.confidence)
        found = {Verdict::rejected, kNoPixel, 0.0};
      results.verdict[i] = found.verdict;
      results.pixel[i] = found.pixel;
      if (found.verdict == Verdict::hit)
        results.distance[i] = static_cast<float>(distance_of(world, i, gbuffer.view, found.l));
    }
    steps += mine;
  });
  results.steps = steps;
}

}  // namespace hybray::ssrm
