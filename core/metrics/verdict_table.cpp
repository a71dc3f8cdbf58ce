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

}  // namespace

VerdictTable judge(const ssrm::MarchResults& results, const ssrm::DepthView& depth,
                   const ssrm::ScreenRays& screen_rays, const RayStream& rays, const truth::RayTruth& truth,
                   const GBuffer& gbuffer, const Scene& scene, const Tolerance& tolerance,
                   std::vector<HitClass>* classes) {
  HYBRAY_CHECK_EQ(results.size(), rays.size());
  HYBRAY_CHECK_EQ(truth.size(), rays.size());
  if (classes) classes->assign(rays.size(), HitClass::none);
  const View& view = gbuffer.view;
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
        const double claimed = claimed_distance(depth, screen_rays, rays, view, i, results.pixel[i]);
        const double true_t = truth.hits.t[i], error = std::abs(claimed - true_t);
        const dvec3 direction(rays.direction(i));
        const double footprint = view.view_depth(dvec3(rays.origin(i)) + claimed * direction) / view.focal();
        const dvec3 normal = geometric_normal(scene, gbuffer.primitive[results.pixel[i]],
                                              dvec3(rays.origin(i)) + claimed * direction);
        const double cosine = std::max(0.1, std::abs(glm::dot(normal, direction)));
        kind = error <= tolerance.footprint_factor * footprint / cosine ? HitClass::right
               : claimed < true_t                                       ? HitClass::early
                                                                        : HitClass::through;
        if (error <= std::max(0.01 * true_t, 1.5 * footprint)) ++mine.right_loose;
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
