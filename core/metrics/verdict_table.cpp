#include "core/metrics/verdict_table.h"

#include "core/base/check.h"
#include "core/base/parallel.h"
#include "core/scene/surface_point.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace hybray::metrics {
namespace {

using ssrm::Verdict;

void add(VerdictTable& sum, const VerdictTable& part) {
  for (size_t v = 0; v < sum.verdicts.size(); ++v) sum.verdicts[v] += part.verdicts[v];
  sum.right += part.right, sum.phantom += part.phantom, sum.early += part.early, sum.through += part.through;
  sum.right_loose += part.right_loose;
  sum.visible_true_hits += part.visible_true_hits;
  sum.false_misses += part.false_misses;
}

double footprint(const View& view, const dvec3& point) {
  return view.view_depth(point) / view.focal();
}

}  // namespace

HitClass classify_hit(const View& view, const Scene& scene, const dvec3& origin, const dvec3& direction,
                      uint32_t primitive, double claimed, double true_t, const Tolerance& tolerance) {
  if (std::isinf(true_t)) return HitClass::phantom;
  const dvec3 point = origin + claimed * direction;
  const double cosine =
      std::max(0.1, std::abs(glm::dot(geometric_normal(scene, primitive, point), direction)));
  if (std::abs(claimed - true_t) <= tolerance.footprint_factor * footprint(view, point) / cosine)
    return HitClass::right;
  return claimed < true_t ? HitClass::early : HitClass::through;
}

VerdictTable judge(const ssrm::MarchResults& results, const ssrm::DepthView& depth,
                   const ssrm::ScreenRays& screen_rays, const RayStream& rays, const truth::RayTruth& truth,
                   const GBuffer& gbuffer, const Scene& scene, const Tolerance& tolerance,
                   std::vector<HitClass>* classes) {
  const auto surface_of = [&](size_t i) {
    const int pixel = static_cast<int>(results.pixel[i]), width = depth.width();
    return ClaimedSurface{ssrm::pixel_plane(depth, pixel % width, pixel / width),
                          gbuffer.primitive[results.pixel[i]]};
  };
  return judge(results, surface_of, depth, screen_rays, rays, truth, gbuffer.view, scene, tolerance, classes);
}

VerdictTable judge(const ssrm::MarchResults& results,
                   const std::function<ClaimedSurface(size_t ray)>& surface_of, const ssrm::DepthView& depth,
                   const ssrm::ScreenRays& screen_rays, const RayStream& rays, const truth::RayTruth& truth,
                   const View& view, const Scene& scene, const Tolerance& tolerance,
                   std::vector<HitClass>* classes) {
  HYBRAY_CHECK_EQ(results.size(), rays.size());
  HYBRAY_CHECK_EQ(truth.size(), rays.size());
  if (classes) classes->assign(rays.size(), HitClass::none);
  VerdictTable table;
  std::mutex merging;
  parallel_blocks(rays.size(), 8192, [&](size_t begin, size_t end) {
    VerdictTable mine;
    for (size_t i = begin; i < end; ++i) {
      const Verdict verdict = results.verdict[i];
      ++mine.verdicts[static_cast<size_t>(verdict)];
      mine.visible_true_hits += truth.visible[i];
      const bool truly_hits = truth.hits.primitive[i] != kNoPrimitive;
      if (verdict == Verdict::miss && truly_hits) ++mine.false_misses;
      if (verdict != Verdict::hit) continue;

      HitClass kind = HitClass::phantom;
      if (truly_hits) {
        const ClaimedSurface surface = surface_of(i);
        const double claimed =
            !results.distance.empty() && std::isfinite(results.distance[i])
                ? results.distance[i]
                : ssrm::plane_distance(surface.plane, depth, screen_rays, rays, view, i, results.pixel[i]);
        const double true_t = truth.hits.t[i];
        const dvec3 origin(rays.origin(i)), direction(rays.direction(i));
        kind = classify_hit(view, scene, origin, direction, surface.primitive, claimed, true_t, tolerance);
        const double loose = std::max(0.01 * true_t, 1.5 * footprint(view, origin + claimed * direction));
        if (std::abs(claimed - true_t) <= loose) ++mine.right_loose;
      }
      mine.right += kind == HitClass::right;
      mine.phantom += kind == HitClass::phantom;
      mine.early += kind == HitClass::early;
      mine.through += kind == HitClass::through;
      if (classes) (*classes)[i] = kind;
    }
    const std::lock_guard lock(merging);
    add(table, mine);  // integers: the order of merging does not matter
  });
  table.rays = rays.size();
  return table;
}

}  // namespace hybray::metrics
