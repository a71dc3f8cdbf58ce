// Filling a row's cells from measurements.
#pragma once

#include "core/metrics/statistics.h"
#include "harness/experiments/experiment.h"

namespace hybray {

// A fraction, or an empty cell where there is nothing to take it of.
inline Value share(uint64_t part, uint64_t whole) {
  if (whole == 0) return std::monostate{};
  return static_cast<double>(part) / static_cast<double>(whole);
}

inline void put_time(Row& row, const std::string& stem, std::span<const double> ms) {
  row[stem + "_ms"] = metrics::median(ms);
  row[stem + "_spread_ms"] = metrics::spread(ms);
}

inline void put_interval(Row& row, const std::string& name, const metrics::Interval& interval) {
  row[name] = interval.value;
  row[name + "_low"] = interval.low;
  row[name + "_high"] = interval.high;
}

inline void put_ratio(Row& row, const std::string& name, std::span<const double> numerator,
                      std::span<const double> denominator, uint64_t seed) {
  put_interval(row, name, metrics::median_ratio(numerator, denominator, seed));
}

}  // namespace hybray
