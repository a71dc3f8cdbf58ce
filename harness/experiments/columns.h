// Shorthand for the columns that experiments declare.
#pragma once

#include "harness/experiments/experiment.h"

#include <initializer_list>

namespace hybray::column {

inline Column key(const char* name, const char* text, const char* unit = "") {
  return {name, unit, ColumnKind::key, Better::none, text};
}
inline Column fraction(const char* name, Better better, const char* text) {
  return {name, "1", ColumnKind::metric, better, text};
}
// A text or flag that a run measures: it does not say which point a row is of.
inline Column finding(const char* name, const char* text, Comparison comparison) {
  return {name, "", ColumnKind::key, Better::none, text, comparison};
}
inline Column counted(const char* name, const char* text, const char* unit = "") {
  return {name, unit, ColumnKind::count, Better::none, text};
}

inline void add(std::vector<Column>& columns, std::initializer_list<Column> more) {
  columns.insert(columns.end(), more);
}

// `threads` and `repeats`, as the command line and the config set them.
inline void add_threads(std::vector<Column>& columns) {
  columns.push_back({"threads", "", ColumnKind::count, Better::none, "threads in use", Comparison::none});
}
inline void add_repeats(std::vector<Column>& columns) {
  columns.push_back({"repeats", "", ColumnKind::count, Better::none, "timed rounds", Comparison::none});
}

// A time and, beside it, the spread of its repeats.
inline void add_time(std::vector<Column>& columns, const std::string& stem, const std::string& text) {
  columns.push_back(
      {stem + "_ms", "ms", ColumnKind::time, Better::lower, text + "; median over the repeats"});
  columns.push_back(
      {stem + "_spread_ms", "ms", ColumnKind::time, Better::none, "interquartile range of " + stem + "_ms"});
}

// The column, with the tolerance within which it is as accepted.
inline Column within(const Tolerance& tolerance, Column column) {
  column.tolerance = tolerance;
  return column;
}

// A number of unit 1 and the ends of its 95 % interval.
inline void add_interval(std::vector<Column>& columns, const std::string& name, ColumnKind kind,
                         Better better, const std::string& text, const Tolerance& tolerance = {}) {
  const auto add = [&](const std::string& end, Better which, const std::string& meaning) {
    columns.push_back(within(tolerance, {name + end, "1", kind, which, meaning}));
  };
  add("", better, text);
  add("_low", Better::none, "lower end of the 95 % interval of " + name);
  add("_high", Better::none, "upper end of the 95 % interval of " + name);
}

// A ratio of times with its bootstrap interval.
inline void add_ratio(std::vector<Column>& columns, const std::string& name, const std::string& text,
                      Better better = Better::higher) {
  add_interval(columns, name, ColumnKind::time, better, text + "; median of the paired ratios");
}

}  // namespace hybray::column
