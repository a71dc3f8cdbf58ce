#include "core/metrics/occlusion_verdicts.h"

#include "core/base/check.h"

namespace hybray::metrics {

using ssrm::Verdict;

VerdictTable judge_occlusion(const ssrm::MarchResults& results, const truth::RayTruth& truth,
                             std::vector<HitClass>* classes) {
  HYBRAY_CHECK_EQ(results.size(), truth.size());
  VerdictTable table;
  table.rays = results.size();
  if (classes) classes->assign(results.size(), HitClass::none);
  for (size_t i = 0; i < results.size(); ++i) {
    const Verdict verdict = results.verdict[i];
    ++table.verdicts[static_cast<size_t>(verdict)];
    const bool occluded = truth.hits.primitive[i] != kNoPrimitive;
    if (verdict == Verdict::hit) {
      ++(occluded ? table.right : table.phantom);
      if (classes) (*classes)[i] = occluded ? HitClass::right : HitClass::phantom;
    }
    if (verdict == Verdict::miss && occluded) ++table.false_misses;
  }
  return table;
}

VerdictTable sum(const VerdictTable& a, const VerdictTable& b) {
  VerdictTable s = a;
  s.rays += b.rays;
  for (size_t v = 0; v < s.verdicts.size(); ++v) s.verdicts[v] += b.verdicts[v];
  s.right += b.right, s.phantom += b.phantom, s.early += b.early, s.through += b.through;
  s.right_loose += b.right_loose;
  s.visible_true_hits += b.visible_true_hits;
  s.false_misses += b.false_misses;
  return s;
}

}  // namespace hybray::metrics
