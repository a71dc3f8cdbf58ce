// Verdicts of rays that ask only whether something is in the way. A HIT says that something is; it is right
// where traced truth finds anything within the ray's length, wherever on it.
#pragma once

#include "core/metrics/verdict_table.h"

namespace hybray::metrics {

// `truth` was traced to the rays' ends. Of the table, `rays`, `verdicts`, `right`, `phantom` and
// `false_misses` are set: the others ask where a hit lies.
// If `classes` is not null it receives one entry a ray.
VerdictTable judge_occlusion(const ssrm::MarchResults& results, const truth::RayTruth& truth,
                             std::vector<HitClass>* classes = nullptr);

// Counts of both, as of one list of rays.
VerdictTable sum(const VerdictTable& a, const VerdictTable& b);

}  // namespace hybray::metrics
