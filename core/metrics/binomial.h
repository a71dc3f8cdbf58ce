// How sure a proportion is that was counted in independent trials.
#pragma once

#include "core/metrics/statistics.h"

#include <cstdint>

namespace hybray::metrics {

// successes / trials with the interval of Clopper and Pearson (1934): it covers the true proportion with at
// least the probability `confidence`, also for few trials and for none or all successes. Only for trials that
// are independent, which neighbouring pixels are not (docs/metrics.md). Throws InputError for trials < 1,
// successes outside [0, trials] and a confidence outside (0, 1).
Interval clopper_pearson(int64_t successes, int64_t trials, double confidence = 0.95);

}  // namespace hybray::metrics
