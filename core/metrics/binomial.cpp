#include "core/metrics/binomial.h"

#include "core/base/error.h"

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

namespace hybray::metrics {

Interval clopper_pearson(int64_t successes, int64_t trials, double confidence) {
  if (trials < 1 || successes < 0 || successes > trials)
    throw InputError("proportion", fmt::format("{} of {} is none", successes, trials));
  if (!(confidence > 0.0 && confidence < 1.0))
    throw InputError("confidence", fmt::format("{} is not in (0, 1)", confidence));
  using Binomial = boost::math::binomial_distribution<double>;
  const double n = static_cast<double>(trials), k = static_cast<double>(successes);
  const double tail = 0.5 * (1.0 - confidence);
  return {k / n, successes == 0 ? 0.0 : Binomial::find_lower_bound_on_p(n, k, tail),
          successes == trials ? 1.0 : Binomial::find_upper_bound_on_p(n, k, tail)};
}

}  // namespace hybray::metrics
