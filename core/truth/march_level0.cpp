#include "core/truth/march_level0.h"

#include "core/base/parallel.h"
#include "core/ssrm/cell_walk.h"
#include "core/ssrm/march_plane.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace hybray::truth {
namespace {

template <class Real>
int record(std::vector<Decision>* log, Real a, Real b, Real magnitude) {
  const int outcome = (a > b) - (a < b);
  if (log) log->push_back({outcome, double(a), double(b), double(magnitude)});
  return outcome;
}

double float_ulp(double magnitude) {
  const float m = static_cast<float>(std::abs(magnitude));
  return static_cast<double>(std::nextafter(m, std::numeric_limits<float>::infinity())) -
         static_cast<double>(m);
}

// How far a ray is behind a pixel's plane where it enters and leaves the pixel, and what rounding of the
// buffers forgives (march_plane.h).
struct PixelPassage {
  double enter, leave, tolerance, magnitude;
};
PixelPassage pass_pixel(const ssrm::DepthView& view, const ssrm::ScreenRay<double>& ray, int x, int y) {
  const double x_in = ray.dx > 0.0 ? x : x + 1, y_in = ray.dy > 0.0 ? y : y + 1;
  const double x_out = 2 * x + 1 - x_in, y_out = 2 * y + 1 - y_in;
  // As the marcher has it, by the reciprocal.
  const double ix = 1.0 / ray.dx, iy = 1.0 / ray.dy;
  const double enter = std::max((x_in - ray.ox) * ix, (y_in - ray.oy) * iy);
  const double leave = std::min({(x_out - ray.ox) * ix, (y_out - ray.oy) * iy, ray.l_end});
  const ssrm::PlaneGap gap = ssrm::plane_gap(view, ray, x, y);
  const vec2 slope = view.derivatives(x, y);
  const double magnitude =
      std::abs(double(view.pyramid.at(0, x, y))) + std::abs(double(slope.x)) + std::abs(double(slope.y));
  return {gap.at(enter), gap.at(leave), ssrm::kBufferRounding * magnitude, magnitude};
}

}  // namespace

template <class Real>
ssrm::Correction march_level0_ray(const ssrm::DepthView& view, const ssrm::ScreenRay<Real>& ray,
                                  uint32_t pixel, uint64_t& steps, std::vector<Decision>* log,
                                  ssrm::Marcher marcher) {
  const ssrm::ScreenRay<double> exact{ray.ox, ray.oy, ray.oz, ray.dx, ray.dy, ray.dz, ray.l_end, ray.end};
  const int width = view.width();
  const ivec2 origin(static_cast<int>(pixel) % width, static_cast<int>(pixel) / width);
  ssrm::CellWalk<Real> walk(ray, width, view.height(), origin.x, origin.y);
  for (bool at_origin = true;; at_origin = false) {
    const auto exit = walk.exit(0);
    if (log) record(log, exit.lx, exit.ly, std::max(std::abs(exit.lx), std::abs(exit.ly)));
    const bool ends =
        record(log, ray.l_end, exit.l(), std::max(std::abs(ray.l_end), std::abs(exit.l()))) <= 0;
    if (!at_origin) ++steps;
    if (!at_origin && marcher == ssrm::Marcher::plane) {
      const PixelPassage p = pass_pixel(view, exact, walk.px, walk.py);
      if (record(log, p.enter, p.tolerance, p.magnitude) > 0) return {ssrm::Verdict::behind, ssrm::kNoPixel};
      if (record(log, p.leave, p.tolerance, p.magnitude) > 0) {
        if (record(log, p.enter, 0.0, p.magnitude) > 0) return {ssrm::Verdict::behind, ssrm::kNoPixel};
        return {ssrm::Verdict::hit, static_cast<uint32_t>(walk.py * width + walk.px)};
      }
    } else if (!at_origin) {
      const Real leave = ends ? ray.l_end : exit.l();
      const Real farthest = std::max(ray.rise(walk.l), ray.rise(leave));
      const Real stored = static_cast<Real>(view.pyramid.at(0, walk.px, walk.py)) - ray.oz;
      const Real magnitude = std::max(std::abs(farthest), std::isinf(stored) ? Real(0) : std::abs(stored));
      if (record(log, farthest, stored, magnitude) > 0) break;
    }
    if (ends) return {ray.end, ssrm::kNoPixel};
    if (!walk.advance(exit)) return {ssrm::Verdict::offscreen, ssrm::kNoPixel};
  }
  return ssrm::correct(view, exact, {walk.px, walk.py}, walk.previous(), origin);
}

template <class Real>
ssrm::MarchResults march_level0(const ssrm::DepthView& view, const ssrm::ScreenRays& rays,
                                const std::vector<uint32_t>& pixels, size_t stride, ssrm::Marcher marcher) {
  ssrm::MarchResults results;
  results.resize((rays.size() + stride - 1) / stride);
  std::atomic<uint64_t> steps{0};
  parallel_blocks(results.size(), 512, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t j = begin; j < end; ++j) {
      const ssrm::Correction c =
          march_level0_ray(view, rays.get<Real>(j * stride), pixels[j * stride], mine, nullptr, marcher);
      results.verdict[j] = c.verdict;
      results.pixel[j] = c.pixel;
    }
    steps += mine;
  });
  results.steps = steps;
  return results;
}

double first_difference_margin(const ssrm::DepthView& view, const ssrm::ScreenRays& rays, size_t ray,
                               uint32_t pixel, ssrm::Marcher marcher) {
  std::vector<Decision> in_float, in_double;
  uint64_t steps = 0;
  march_level0_ray(view, rays.get<float>(ray), pixel, steps, &in_float, marcher);
  march_level0_ray(view, rays.get<double>(ray), pixel, steps, &in_double, marcher);
  for (size_t i = 0; i < std::min(in_float.size(), in_double.size()); ++i)
    if (in_float[i].outcome != in_double[i].outcome)
      return std::abs(in_double[i].a - in_double[i].b) / float_ulp(in_double[i].magnitude);
  return std::numeric_limits<double>::infinity();
}

template ssrm::Correction march_level0_ray(const ssrm::DepthView&, const ssrm::ScreenRay<float>&, uint32_t,
                                           uint64_t&, std::vector<Decision>*, ssrm::Marcher);
template ssrm::Correction march_level0_ray(const ssrm::DepthView&, const ssrm::ScreenRay<double>&, uint32_t,
                                           uint64_t&, std::vector<Decision>*, ssrm::Marcher);
template ssrm::MarchResults march_level0<float>(const ssrm::DepthView&, const ssrm::ScreenRays&,
                                                const std::vector<uint32_t>&, size_t, ssrm::Marcher);
template ssrm::MarchResults march_level0<double>(const ssrm::DepthView&, const ssrm::ScreenRays&,
                                                 const std::vector<uint32_t>&, size_t, ssrm::Marcher);

}  // namespace hybray::truth
