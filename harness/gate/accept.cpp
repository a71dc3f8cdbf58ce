#include "harness/gate/accept.h"

#include "core/base/error.h"
#include "harness/gate/compare.h"

#include <algorithm>

#include <fmt/format.h>

namespace hybray {
namespace {

bool is_gated_against_baseline(const Column& column, const std::vector<Gate>& gates) {
  return std::any_of(gates.begin(), gates.end(),
                     [&](const Gate& gate) { return gate.baseline && gate.column == &column; });
}

bool is_empty(const GatedTable& table, const Column& column) {
  for (size_t row = 0; row < table.row_count(); ++row) {
    if (!table.cell(row, column.name).empty()) return false;
  }
  return true;
}

void refuse_what_is_no_number(const GatedTable& table, const Column& column) {
  if (column.kind == ColumnKind::key) return;
  for (size_t row = 0; row < table.row_count(); ++row) {
    const std::string& cell = table.cell(row, column.name);
    if (!cell.empty() && !finite_number(cell)) {
      throw InputError(table.place(row),
                       fmt::format("found {} in the column \"{}\"; expected a finite number, or "
                                   "nothing",
                                   cell, column.name));
    }
  }
}

}  // namespace

Acceptance prepare_acceptance(const GatedTable& table, const std::vector<Gate>& gates,
                              const Baseline& before) {
  if (table.row_count() == 0) throw InputError(table.file(), "the table has no rows to accept");
  std::vector<const Column*> compared;
  std::vector<std::string> names;
  for (const Column& column : table.experiment().columns) {
    const Comparison comparison = comparison_of(column);
    if (comparison == Comparison::none && !is_gated_against_baseline(column, gates)) continue;
    table.require(column.name);
    refuse_what_is_no_number(table, column);
    if (comparison != Comparison::identity) compared.push_back(&column);
    if (!is_empty(table, column)) names.push_back(column.name);
  }
  Acceptance acceptance;
  acceptance.csv = csv_line(names);
  for (size_t row = 0; row < table.row_count(); ++row) {
    std::vector<std::string> cells;
    for (const std::string& name : names) cells.push_back(table.cell(row, name));
    acceptance.csv += csv_line(cells);
  }
  if (!before.table) return acceptance;
  const Comparisons found = compare(table, *before.table, compared, {});
  acceptance.changes = found.missing;
  acceptance.changes.insert(acceptance.changes.end(), found.differences.begin(), found.differences.end());
  acceptance.moved = found.moved;
  return acceptance;
}

}  // namespace hybray
