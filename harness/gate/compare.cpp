#include "harness/gate/compare.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hybray {
namespace {

std::string shown(const std::string& cell) {
  return cell.empty() ? "(empty)" : cell;
}

void compare_cell(const Column& column, const std::string& where, const std::string& was,
                  const std::string& is, Comparisons& result) {
  ++result.cells;
  const auto a = finite_number(was), b = finite_number(is);
  const bool text = column.kind == ColumnKind::key || is.empty();
  if (was == is && (text || b)) return;
  if (!a || !b) {
    auto& found = column.kind == ColumnKind::key ? result.differences : result.missing;
    found.push_back(fmt::format("{}: {} was {}, is {}", where, column.name, shown(was), shown(is)));
    return;
  }
  const double allowed =
      column.tolerance.absolute + column.tolerance.relative * std::max(std::abs(*a), std::abs(*b));
  const double difference = std::abs(*b - *a);
  if (difference > allowed) {
    result.differences.push_back(fmt::format("{}: {} was {}, is {} ({:+.3g}; tolerance {:.3g})", where,
                                             column.name, was, is, *b - *a, allowed));
    return;
  }
  if (difference == 0.0) return;  // written otherwise
  ++result.moved;
  const double left = 1.0 - difference / allowed;
  if (left < result.least_left) {
    result.least_left = left;
    result.tightest = where + " " + column.name;
  }
}

}  // namespace

std::vector<const Column*> compared_columns(const Experiment& experiment) {
  std::vector<const Column*> columns;
  for (const Column& column : experiment.columns) {
    if (comparison_of(column) == Comparison::value) columns.push_back(&column);
  }
  return columns;
}

Comparisons compare(const GatedTable& table, const GatedTable& accepted,
                    std::span<const Column* const> columns, const std::vector<GateFilter>& where) {
  Comparisons result;
  for (const Column* column : columns) table.require(column->name);
  for (const size_t row : table.matching(where)) {
    const auto counterpart = accepted.find(table.identity(row));
    if (!counterpart) {
      result.missing.push_back(table.label(row) + ": the accepted table has no such row");
      continue;
    }
    for (const Column* column : columns) {
      compare_cell(*column, table.label(row), accepted.cell(*counterpart, column->name),
                   table.cell(row, column->name), result);
    }
  }
  for (const size_t row : accepted.matching(where)) {
    if (!table.find(accepted.identity(row)))
      result.missing.push_back(accepted.label(row) + ": the row is accepted, but missing");
  }
  return result;
}

}  // namespace hybray
