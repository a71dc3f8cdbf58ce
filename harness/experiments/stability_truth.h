// What is right at a point of `stability`: verdicts, places and true hits of a sample of mirror rays, in
// double from the scene where it was made.
#pragma once

#include "core/metrics/verdict_table.h"
#include "core/truth/exact_frame.h"
#include "harness/experiments/stability_view.h"

#include <vector>

namespace hybray::stability_parts {

struct StableRays {
  truth::ExactFrame frame;
  std::vector<truth::ExactFrame::Ray> rays;  // of evenly spread pixels that see something
  std::vector<double> true_t;                // metres; infinity: nothing is hit
  std::vector<uint32_t> true_primitive;

  // `robust`: of the scene where it was made. At most `judged` rays.
  StableRays(const Tracer& robust, const View& view, size_t judged);

  size_t size() const { return rays.size(); }
  // Of one ray.
  metrics::HitClass classify(size_t i, uint32_t primitive, double claimed,
                             const metrics::Tolerance& tolerance) const;
};

}  // namespace hybray::stability_parts
