#include "core/ssrm/march.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/ssrm/march_paper.h"
#include "core/ssrm/march_paper_lanes.h"
#include "core/ssrm/march_plane.h"
#include "core/ssrm/march_plane_lanes.h"

#include <atomic>

namespace hybray::ssrm {

void march_chosen(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                  const RayChoice& choice, const MarchOptions& options, MarchResults& results) {
  HYBRAY_CHECK_EQ(rays.size(), pixels.size());
  HYBRAY_CHECK_EQ(rays.size(), results.size());
  HYBRAY_CHECK(options.marcher != Marcher::plane || view.slanted != nullptr);
  if (options.code == MarchCode::lanes) {
    const auto in_lanes = options.marcher == Marcher::plane ? march_plane_lanes : march_paper_lanes;
    results.steps = in_lanes(view, rays, pixels, choice, options, results);
    return;
  }
  std::atomic<uint64_t> steps{0};
  const size_t block = 1024 / choice.rays_a_part();
  parallel_blocks(choice.parts(rays.size()), block, [&](size_t begin, size_t end) {
    uint64_t mine = 0;
    choice.visit(begin, end, rays.size(), [&](size_t i) {
      const Correction c = march_ray(view, rays.get<float>(i), pixels[i], options, mine);
      results.verdict[i] = c.verdict;
      results.pixel[i] = c.pixel;
      if (!results.proved.empty()) results.proved[i] = c.l;
    });
    steps += mine;
  });
  results.steps = steps;
}

void march(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
           const MarchOptions& options, MarchResults& results) {
  march_chosen(view, rays, pixels, {}, options, results);
}

void march_some(const DepthView& view, const ScreenRays& rays, const std::vector<uint32_t>& pixels,
                std::span<const uint32_t> which, const MarchOptions& options, MarchResults& results) {
  march_chosen(view, rays, pixels, {RayChoice::Of::listed, which}, options, results);
}

Correction march_ray(const DepthView& view, const ScreenRay<float>& ray, uint32_t pixel,
                     const MarchOptions& options, uint64_t& steps) {
  return options.marcher == Marcher::plane ? march_plane_ray(view, ray, pixel, options, steps)
                                           : march_paper_ray(view, ray, pixel, options, steps);
}

}  // namespace hybray::ssrm
