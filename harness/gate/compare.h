// A table held against the accepted one, cell by cell.
#pragma once

#include "harness/gate/gated_table.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hybray {

struct Comparisons {
  size_t cells = 0;                      // that were compared
  size_t moved = 0;                      // of them, not the same, but within tolerance
  double least_left = 1.0;               // least share of a tolerance that is left
  std::string tightest;                  // where that is
  std::vector<std::string> differences;  // what is not as accepted, each with its row
  std::vector<std::string> missing;      // what only one of the two has, or is no finite number
};

// The columns that an accepted table is compared in, by their declarations.
std::vector<const Column*> compared_columns(const Experiment& experiment);

// `columns` of the rows of `table` that the filters let through, and of their counterparts in `accepted`. A
// cell that is empty in both is as accepted.
Comparisons compare(const GatedTable& table, const GatedTable& accepted,
                    std::span<const Column* const> columns, const std::vector<GateFilter>& where);

}  // namespace hybray
