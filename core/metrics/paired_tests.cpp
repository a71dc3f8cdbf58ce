#include "core/metrics/paired_tests.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

namespace hybray::metrics {
namespace {

constexpr size_t kMostExactPairs = 200;

std::vector<double> differences(std::span<const double> a, std::span<const double> b, size_t least) {
  if (a.size() != b.size())
    throw InputError("pairs", fmt::format("the series have {} and {} values", a.size(), b.size()));
  if (a.size() < least)
    throw InputError("pairs", fmt::format("at least {} are needed, there are {}", least, a.size()));
  std::vector<double> apart;
  for (size_t i = 0; i < a.size(); ++i) {
    apart.push_back(a[i] - b[i]);
    if (!std::isfinite(apart.back()))
      throw InputError("pairs", fmt::format("the difference of pair {} is {}", i, apart.back()));
  }
  return apart;
}

// Twice the rank of each |value|, the mean one where some are the same: whole numbers.
std::vector<size_t> doubled_ranks(const std::vector<double>& values) {
  std::vector<size_t> order(values.size()), ranks(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto size_of = [&](size_t i) { return std::abs(values[i]); };
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return size_of(i) < size_of(j); });
  for (size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && size_of(order[end]) == size_of(order[begin])) ++end;
    for (size_t k = begin; k < end; ++k) ranks[order[k]] = begin + 1 + end;
  }
  return ranks;
}

// Probability that the sum of the ranks, each in it or not with 1/2, is at most `most`.
double probability_at_most(const std::vector<size_t>& ranks, size_t most) {
  std::vector<double> chance(std::accumulate(ranks.begin(), ranks.end(), size_t{1}), 0.0);
  chance[0] = 1.0;
  size_t reach = 0;  // the greatest sum so far
  for (const size_t rank : ranks) {
    reach += rank;
    for (size_t sum = reach + 1; sum-- > 0;)
      chance[sum] = 0.5 * (chance[sum] + (sum >= rank ? chance[sum - rank] : 0.0));
  }
  return std::accumulate(chance.begin(), chance.begin() + static_cast<ptrdiff_t>(most) + 1, 0.0);
}

}  // namespace

TestResult paired_t(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> apart = differences(a, b, 2);
  const double n = static_cast<double>(apart.size());
  const double mean = std::accumulate(apart.begin(), apart.end(), 0.0) / n;
  double square = 0.0;
  for (const double d : apart) square += (d - mean) * (d - mean);
  if (square == 0.0) {
    if (mean == 0.0) return {};
    return {std::copysign(std::numeric_limits<double>::infinity(), mean), 0.0};
  }
  const double t = mean / std::sqrt(square / (n * (n - 1.0)));
  const boost::math::students_t distribution(n - 1.0);
  return {t, 2.0 * boost::math::cdf(complement(distribution, std::abs(t)))};
}

TestResult wilcoxon_signed_rank(std::span<const double> a, std::span<const double> b) {
  std::vector<double> apart = differences(a, b, 1);
  std::erase(apart, 0.0);
  const std::vector<size_t> ranks = doubled_ranks(apart);
  size_t positive = 0, all = 0;
  for (size_t i = 0; i < ranks.size(); ++i) {
    all += ranks[i];
    if (apart[i] > 0.0) positive += ranks[i];
  }
  const double statistic = 0.5 * static_cast<double>(positive);
  const size_t less = std::min(positive, all - positive);
  if (ranks.size() <= kMostExactPairs)
    return {statistic, std::min(1.0, 2.0 * probability_at_most(ranks, less))};
  double square = 0.0;
  for (const size_t rank : ranks) square += static_cast<double>(rank) * static_cast<double>(rank);
  const double z = (0.5 * static_cast<double>(all) - static_cast<double>(less)) / std::sqrt(0.25 * square);
  return {statistic, 2.0 * boost::math::cdf(complement(boost::math::normal(), z))};
}

}  // namespace hybray::metrics
