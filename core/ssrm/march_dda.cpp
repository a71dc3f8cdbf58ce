#include "core/ssrm/march_dda.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace hybray::ssrm {
namespace {

// 1 / view depth of a march depth. It is affine along the ray on the screen, as the homogeneous 1/w of the
// paper is.
struct InverseDepth {
  double a, per_b, sign;
  explicit InverseDepth(const View& v) : a(v.depth_a()), per_b(1.0 / v.depth_b()), sign(v.depth_sign()) {}
  double at(double march_depth) const { return (sign * march_depth - a) * per_b; }
};

struct Found {
  Verdict verdict;
  uint32_t pixel = kNoPixel;
  double l = 0.0;
};

Found march(const DepthView& view, const InverseDepth& inverse, const ScreenRay<double>& ray, uint32_t origin,
            const DdaOptions& options, uint64_t& steps) {
  const int width = view.width(), height = view.height();
  const double longer = std::max(std::abs(ray.dx), std::abs(ray.dy));
  const double stride = options.stride / longer;  // in L
  // 1/w of the ray: exact at the origin, affine in L.
  const double start = inverse.at(ray.oz), rate = inverse.at(ray.oz + ray.dz) - start;
  const auto view_depth = [&](double l) { return 1.0 / std::max(start + l * rate, 1e-300); };
  double before = view_depth(0.0);
  const uint64_t most = options.max_steps ? options.max_steps : std::numeric_limits<uint64_t>::max();
  for (uint64_t n = 1;; ++n) {
    const double l = static_cast<double>(n) * stride;
    const double l_before = n == 1 ? 0.0 : l - 0.5 * stride;
    const double l_after = std::min(l + 0.5 * stride, ray.l_end);
    if (ray.l_end < l) return {ray.end};
    const double px = std::floor(ray.ox + l * ray.dx), py = std::floor(ray.oy + l * ray.dy);
    if (!(px >= 0.0 && py >= 0.0 && px < width && py < height)) return {Verdict::offscreen};
    if (n > most) return {Verdict::budget};
    ++steps;
    const int x = static_cast<int>(px), y = static_cast<int>(py);
    const double after = view_depth(l_after);
    const double nearest = std::min(before, after), farthest = std::max(before, after);
    before = after;
    const double stored = view.pyramid.at(0, x, y);
    if (std::isinf(stored)) continue;
    const auto pixel = static_cast<uint32_t>(y) * static_cast<uint32_t>(width) + static_cast<uint32_t>(x);
    const double surface = 1.0 / inverse.at(stored);
    if (farthest < surface || nearest > surface + options.thickness || pixel == origin) continue;
    // Where the stretch passes the stored depth, else the end that is nearer to it.
    const double crossing = (1.0 / surface - start) / rate;
    const double at = std::isfinite(crossing) ? std::clamp(crossing, l_before, l_after) : l_before;
    return {Verdict::hit, pixel, at};
  }
}

}  // namespace

void march_dda(const DepthView& view, const View& camera, const RayStream& world, const ScreenRays& rays,
               const DdaOptions& options, MarchResults& results) {
  HYBRAY_CHECK_EQ(rays.size(), world.size());
  HYBRAY_CHECK_EQ(rays.size(), results.size());
  HYBRAY_CHECK(options.thickness > 0.0 && options.stride >= 1.0);
  results.distance.resize(rays.size());
  const InverseDepth inverse(camera);
  std::atomic<uint64_t> steps{0};
  parallel_blocks(rays.size(), 1024, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    for (size_t i = begin; i < end; ++i) {
      const Found found = march(view, inverse, rays.get<double>(i), world.pixel[i], options, mine);
      results.verdict[i] = found.verdict;
      results.pixel[i] = found.pixel;
      results.distance[i] = found.verdict == Verdict::hit
                                ? static_cast<float>(distance_of(world, i, camera, found.l))
                                : kNoDistance;
    }
    steps += mine;
  });
  results.steps = steps;
}

}  // namespace hybray::ssrm
